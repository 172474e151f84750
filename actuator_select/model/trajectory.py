"""Straight-line moves with a trapezoidal speed profile, and what they ask of every cable, instant by instant."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from actuator_select.model.actuation import (
    Check,
    cable_acceleration_limit,
    cable_force_limit,
    cable_speed_limit,
    shaft_characteristics,
    voltage_limit,
)
from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.components import ActuatorSet
from actuator_select.model.distribution import distribute
from actuator_select.model.dynamics import RequiredWrench
from actuator_select.model.kinematics import LENGTH_TOLERANCE
from actuator_select.model.robot import CableRobot
from actuator_select.model.tension import TensionModel


@dataclass(frozen=True, slots=True, kw_only=True)
class TrapezoidalProfile:
    """Speed profile of a move from rest to rest: ramp up, cruise, ramp down; a triangle where the way is too short.

    Attributes
    ----------
    distance : float
        Length of the move. [m]
    speed : float
        Greatest speed reached. [m/s]
    acceleration, deceleration : float
        Of the ramps, both positive. [m/s²]
    """

    distance: float
    speed: float
    acceleration: float
    deceleration: float

    @property
    def corners(self) -> FloatArray:
        """Start, end of the ramp, start of braking, end, (4,). [s]"""
        ramp, brake = self.speed / self.acceleration, self.speed / self.deceleration
        cruise = max(0.0, self.distance / self.speed - (ramp + brake) / 2.0)
        return np.cumsum([0.0, ramp, cruise, brake])

    def motion(self, times: FloatArray, phase: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Path covered, speed and acceleration along the line as the given phase has them.

        Parameters
        ----------
        times : (S,) array
            Within the phase, its ends included. [s]
        phase : int
            0 ramp up, 1 cruise, 2 ramp down.

        Returns
        -------
        tuple of (S,) arrays
            [m, m/s, m/s²]
        """
        start = self.corners
        if phase == 0:
            acceleration = np.full_like(times, self.acceleration)
            return self.acceleration * times**2 / 2.0, self.acceleration * times, acceleration
        if phase == 1:
            path = self.speed**2 / (2.0 * self.acceleration) + self.speed * (times - start[1])
            return path, np.full_like(times, self.speed), np.zeros_like(times)
        left = start[3] - times
        acceleration = np.full_like(times, -self.deceleration)
        return self.distance - self.deceleration * left**2 / 2.0, self.deceleration * left, acceleration


def trapezoidal_profile(
    distance: float, speed: float, acceleration_time: float, deceleration_time: float
) -> TrapezoidalProfile:
    """Profile of a move over `distance` that reaches `speed` where the way allows.

    Parameters
    ----------
    distance : float
        Greater than 0. [m]
    speed : float
        Cruising speed. [m/s]
    acceleration_time, deceleration_time : float
        From rest to the cruising speed and back. A shorter move keeps the accelerations, not the times. [s]

    Returns
    -------
    TrapezoidalProfile
        A triangle if the ramps alone are longer than the way.
    """
    acceleration, deceleration = speed / acceleration_time, speed / deceleration_time
    peak = np.sqrt(2.0 * distance * acceleration * deceleration / (acceleration + deceleration))
    return TrapezoidalProfile(
        distance=distance, speed=min(speed, float(peak)), acceleration=acceleration, deceleration=deceleration
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class LineMove:
    """A straight move at constant orientation.

    Attributes
    ----------
    start, stop : (3,) array
        [m]
    orientation : (3,) array
        Angles ψ, θ, φ. [rad]
    profile : TrapezoidalProfile
        Speed along the line.
    centripetal : bool
        Whether the cable's acceleration has its term (‖v‖² - (u·v)²)/l.
    """

    start: FloatArray
    stop: FloatArray
    orientation: FloatArray
    profile: TrapezoidalProfile
    centripetal: bool


class TorqueTest(Enum):
    """Which torque of a move is held against the motor's."""

    LOAD = "load"
    """The load's alone, eq. 32; the rotor's stands apart in eq. 33, as published."""
    LOAD_AND_ROTOR = "load and rotor"
    """M + J_r φ̈, all that the motor has to make."""


def torque_test(model: TensionModel) -> TorqueTest:
    """Torque that a tension model holds against the motor's: the sum unless it lets cables push, as in rankings."""
    return TorqueTest.LOAD if model.lets_cables_push else TorqueTest.LOAD_AND_ROTOR


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveHistory:
    """One actuator type on m cables over S instants; the instants at a corner of the profile stand twice.

    Attributes
    ----------
    times : (S,) array
        Not decreasing. [s]
    phases : (S,) array
        Phase of the profile from whose side the instant is taken.
    tension : (S, m) array
        [N]
    speed, acceleration : (S, m) array
        Of the shaft behind the gearbox, winding in positive. [rad/s, rad/s²]
    torque : (S, m) array
        Load torque on that shaft. [N m]
    total_torque : (S, m) array
        With what accelerates the rotor, M + J_r φ̈, the inertia as eq. 22 has it. [N m]
    torque_test : TorqueTest
        Which of the two the torque limit holds.
    voltage : (S, m) array
        At the motor's terminals. [V]
    rank_deficient, unbalanced, infeasible : (S,) array of bool
        Where the structure matrix is short of rank, where the tensions do not balance the required wrench, and where
        no tensions within their bounds would, or a cable is beyond its greatest length; there tension, torque and
        voltage are NaN.
    """

    times: FloatArray
    phases: IntArray
    tension: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    torque: FloatArray
    total_torque: FloatArray
    torque_test: TorqueTest
    voltage: FloatArray
    rank_deficient: BoolArray
    unbalanced: BoolArray
    infeasible: BoolArray

    def of(self, check: Check) -> FloatArray:
        """History of the quantity that `check` limits, (S, m)."""
        return {
            Check.SPEED: self.speed,
            Check.TORQUE: self.torque if self.torque_test is TorqueTest.LOAD else self.total_torque,
            Check.ACCELERATION: self.acceleration,
            Check.VOLTAGE: self.voltage,
        }[check]


def shaft_limits(actuator: ActuatorSet) -> dict[Check, float]:
    """Limits of one actuator at the shaft behind the gearbox, eqs. 30, 32, 33, 34; NaN where unknown.

    Parameters
    ----------
    actuator : ActuatorSet
        A single one.

    Returns
    -------
    dict of Check to float
        [rad/s, N m, rad/s², V]
    """
    radius = actuator.drum_radius
    return {
        Check.SPEED: float((cable_speed_limit(actuator) / radius)[0]),
        Check.TORQUE: float((cable_force_limit(actuator) * radius)[0]),
        Check.ACCELERATION: float((cable_acceleration_limit(actuator) / radius)[0]),
        Check.VOLTAGE: float(voltage_limit(actuator)[0]),
    }


@dataclass(frozen=True, slots=True, kw_only=True)
class DrivenMove:
    """A move of a robot whose every cable has the same actuator.

    Attributes
    ----------
    robot : CableRobot
        With m cables.
    wrench : RequiredWrench
        What the cables must supply together, at the move's orientation.
    tension_model : TensionModel
        How they share it: see `distribution`.
    move : LineMove
        The motion, off the anchors: see `kinematics.least_cable_lengths`.
    actuator : ActuatorSet
        A single one.
    torque_test : TorqueTest
        Which torque its torque limit holds.
    """

    robot: CableRobot
    wrench: RequiredWrench
    tension_model: TensionModel
    move: LineMove
    actuator: ActuatorSet
    torque_test: TorqueTest

    def history(self, times: FloatArray, phases: IntArray) -> DriveHistory:
        """Shaft speed, acceleration, torque and voltage of every actuator, from exact derivatives.

        Parameters
        ----------
        times, phases : (S,) array
            Instants [s], and from which phase's side each is taken.

        Returns
        -------
        DriveHistory
            NaN where a figure is unknown; the voltage also where it is not known to be that of a DC motor.

        References
        ----------
        Eqs. 18-22 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
        """
        move, actuator = self.move, self.actuator
        path, speed, acceleration = np.empty_like(times), np.empty_like(times), np.empty_like(times)
        for phase in range(3):
            chosen = phases == phase
            path[chosen], speed[chosen], acceleration[chosen] = move.profile.motion(times[chosen], phase)
        line = (move.stop - move.start) / move.profile.distance
        along_line = acceleration[:, None] * line
        wrenches = self.wrench.static + along_line @ self.wrench.per_acceleration.T
        shared = distribute(
            self.robot, self.tension_model, move.start + path[:, None] * line, move.orientation, wrenches
        )
        geometry = shared.geometry
        longest = self.robot.bounds.length_max * (1.0 + LENGTH_TOLERANCE)
        infeasible = np.isinf(shared.minimax_tension) | (geometry.lengths > longest).any(axis=1)
        tension = np.where(infeasible[:, None], np.nan, shared.tension)
        along = geometry.directions @ line  # cosine between cable and line
        cable_speed = along * speed[:, None]
        cable_acceleration = along * acceleration[:, None]
        if move.centripetal:
            cable_acceleration = cable_acceleration - (speed[:, None] ** 2 - cable_speed**2) / geometry.lengths
        radius = float(actuator.drum_radius[0])
        shaft_speed, shaft_acceleration, torque = cable_speed / radius, cable_acceleration / radius, tension * radius
        shaft = shaft_characteristics(actuator)
        voltage = (  # eq. 21
            shaft.inertia_gain * shaft_acceleration + shaft.damping_gain * shaft_speed + shaft.load_gain * torque
        )
        return DriveHistory(
            times=times,
            phases=phases,
            tension=tension,
            speed=shaft_speed,
            acceleration=shaft_acceleration,
            torque=torque,
            total_torque=torque + shaft.inertia * shaft_acceleration,
            torque_test=self.torque_test,
            rank_deficient=shared.rank_deficient,
            unbalanced=shared.unbalanced,
            infeasible=infeasible,
            voltage=voltage if actuator.direct_current[0] == 1.0 else np.full_like(voltage, np.nan),
        )


def instants(profile: TrapezoidalProfile, per_phase: int) -> tuple[FloatArray, IntArray]:
    """Instants of every phase that lasts, both its ends included.

    Parameters
    ----------
    profile : TrapezoidalProfile
        With up to three phases.
    per_phase : int
        Instants in each.

    Returns
    -------
    tuple of (S,) arrays
        Times [s] and phases.
    """
    corners = profile.corners
    lasting = [phase for phase in range(3) if corners[phase + 1] > corners[phase]]
    times = [np.linspace(corners[phase], corners[phase + 1], per_phase) for phase in lasting]
    return np.concatenate(times), np.repeat(np.array(lasting, dtype=np.int64), per_phase)
