"""Actuators as the model sees them: motor, gearbox and winch in SI units, one array per figure."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from actuator_select.model.arrays import FloatArray, IntArray


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorSet:
    """C actuators. NaN is unknown, infinity is unlimited, zero is zero.

    Attributes
    ----------
    motor_speed : (C,) array
        Greatest motor speed ω_mot. [rad/s]
    motor_torque : (C,) array
        Greatest motor torque M_mot. [N m]
    voltage : (C,) array
        Greatest terminal voltage U_mot. [V]
    back_emf_constant : (C,) array
        C_e. [V s/rad]
    torque_constant : (C,) array
        C_m. [N m/A]
    resistance : (C,) array
        Terminal resistance R_r. [Ω]
    friction : (C,) array
        Viscous friction B_c at the motor. [N m s/rad]
    rotor_inertia : (C,) array
        J_M: of all that turns with the rotor, seen at the motor's shaft. [kg m²]
    ratio : (C,) array
        Gear ratio N_V; 1 without a gearbox.
    efficiency : (C,) array
        Efficiency ξ of the assembly.
    drum_radius : (C,) array
        Winding radius R_w. [m]
    direct_current : (C,) array
        1 where voltage, resistance and constants are DC values between the motor's terminals, so that eq. 21 holds; 0
        where they are not (rms phase values, built-in electronics), so that nothing can be said about a voltage; NaN
        where that is unknown. A single number stands for all; 1 by default.
    """

    motor_speed: FloatArray
    motor_torque: FloatArray
    voltage: FloatArray
    back_emf_constant: FloatArray
    torque_constant: FloatArray
    resistance: FloatArray
    friction: FloatArray
    rotor_inertia: FloatArray
    ratio: FloatArray
    efficiency: FloatArray
    drum_radius: FloatArray
    direct_current: FloatArray = field(default_factory=lambda: np.array(1.0))

    def __post_init__(self) -> None:
        count = np.shape(self.motor_speed)
        if np.ndim(self.direct_current) == 0 and len(count) == 1:
            object.__setattr__(self, "direct_current", np.full(count, self.direct_current))
        for one in fields(self):
            values = np.array(getattr(self, one.name), dtype=np.float64)
            if values.shape != count or values.ndim != 1:
                raise ValueError(f"{one.name} has shape {values.shape} but motor_speed has {count}, expected (C,)")
            values.flags.writeable = False
            object.__setattr__(self, one.name, values)
        if not np.isin(self.direct_current[~np.isnan(self.direct_current)], (0.0, 1.0)).all():
            raise ValueError(f"direct_current is {self.direct_current}, expected 1, 0 or NaN")

    def __len__(self) -> int:
        return len(self.motor_speed)

    @classmethod
    def from_figures(cls, figures: Sequence[Mapping[str, float]]) -> "ActuatorSet":
        """Gather one mapping of figures per actuator; a figure that a mapping lacks is unknown, `direct_current` 1.

        Parameters
        ----------
        figures : sequence of mapping
            Keys are the attributes above, values are in their units.

        Returns
        -------
        ActuatorSet
            In the order given.
        """
        return cls(
            **{
                name: np.array([one.get(name, 1.0 if name == "direct_current" else np.nan) for one in figures])
                for name in (figure.name for figure in fields(cls))
            }
        )

    def take(self, indices: Sequence[int] | IntArray) -> "ActuatorSet":
        """Actuators at `indices`, in that order."""
        chosen = np.asarray(indices, dtype=np.int64)
        return ActuatorSet(**{one.name: getattr(self, one.name)[chosen] for one in fields(self)})
