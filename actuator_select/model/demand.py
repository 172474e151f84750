"""The demand: what each pose asks of each cable, whatever drives it. Computed once for all actuators."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from actuator_select.model.arrays import BoolArray, FloatArray, IntArray
from actuator_select.model.cable_motion import CableMotion, cable_motion
from actuator_select.model.dynamics import RequiredWrench, wrench_scale, wrench_sets
from actuator_select.model.feasibility import hold_wrenches, structure_rank
from actuator_select.model.hyperplanes import ColumnBounds, WrenchSets
from actuator_select.model.kinematics import cable_geometry
from actuator_select.model.motion import MotionKind, MotionSet, extent
from actuator_select.model.robot import CableRobot
from actuator_select.model.supports import Support, support_wrenches
from actuator_select.model.tension import TensionModel, balanced_rows, leaves_unbalanced, pseudo_inverse

NEGATIVE_TENSION_TOLERANCE = 1e-9  # relative to the largest static tension of the pose
BOUND_TOLERANCE = 1e-9  # relative; a tension or a length that exceeds its bound by less is rounding
CELLS_AT_ONCE = 1 << 22  # (pose, cable, velocity sample) cells in one chunk: 32 MiB of scratch
LEAST_CELLS = 128  # of a pose and cable; its geometry and factorisation need about as much

Progress = Callable[[int, int], None]
Wrenches = Sequence[Sequence[RequiredWrench]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LinearTensions:
    """Tensions of the pseudo-inverse at Q poses: affine in the acceleration.

    Attributes
    ----------
    static : (Q, m) array
        At rest. [N]
    per_acceleration : (Q, m, 3) array
        Per unit of the platform's acceleration. [kg]
    middle : (Q, m) array
        At the middle of the required wrenches. [N]
    other_reach : (Q, m) array
        What external loads and turning add to the worst case, at most. [N]
    """

    static: FloatArray
    per_acceleration: FloatArray
    middle: FloatArray
    other_reach: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Demand:
    """Demand of P positions on m cables, in E cases each: every orientation, load and listed motion; Q = P·E poses.

    The cases of a position stand together, listed motions varying fastest, then loads, then orientations.
    Winding in is positive: cable speed u·v, cable acceleration u·a - (‖v‖² - (u·v)²)/l where nothing turns.

    Attributes
    ----------
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        Angles ψ, θ, φ. [rad]
    motion : MotionSet
        What every pose has to do.
    tension_model : TensionModel
        How the cables share the load.
    free_axes : tuple of int
        Axes along which the platform translates.
    lengths : (Q, m) array
        [m]
    directions : (Q, m, 3) array
        Unit vectors u from platform to frame.
    tensions : LinearTensions or None
        Under the pseudo-inverse.
    speed_in, speed_out : (Q, m) array
        Greatest cable speed winding in and winding out over the motion set. [m/s]
    speed : (Q, m) array
        The greater of the two. [m/s]
    force : (Q, m) array
        What every cable has to be able to pull: under the pseudo-inverse the worst magnitude of its tension, else the
        minimax tension of the pose. Infinite where no cable force would do. [N]
    acceleration_middle, acceleration_reach : (Q, m) array
        Middle and half of the range of the cable's acceleration, without the swing term. [m/s²]
    swing_min, swing_max : (Q, m) array
        Range of the swing term, which winds out. [m/s²]
    acceleration_in, acceleration_out, acceleration : (Q, m) array
        Greatest cable acceleration winding in, winding out, and the greater of the two. [m/s²]
    margin : (Q,) array
        Distance of the required wrenches from what tensions within their bounds exert; NaN under the pseudo-inverse.
        Moments are divided by the robot's characteristic length. [N]
    rank : (Q,) array
        Rank of the structure matrix.
    attainable : (Q,) array of bool
        Poses that a drive without limits could hold.
    rank_deficient, negative_at_rest, negative_in_motion, unbalanced, unreachable : (Q,) array of bool
        A structure matrix short of rank; under the pseudo-inverse a cable that has to push at rest or somewhere in the
        motion set, and a required wrench that the tensions do not balance; a cable beyond its greatest length.
    tension_min : (m,) array
        Least tension of every cable. [N]
    """

    positions: FloatArray
    orientations: FloatArray
    motion: MotionSet
    tension_model: TensionModel
    free_axes: tuple[int, ...]
    lengths: FloatArray
    directions: FloatArray
    tensions: LinearTensions | None
    speed_in: FloatArray
    speed_out: FloatArray
    speed: FloatArray
    force: FloatArray
    acceleration_middle: FloatArray
    acceleration_reach: FloatArray
    swing_min: FloatArray
    swing_max: FloatArray
    acceleration_in: FloatArray
    acceleration_out: FloatArray
    acceleration: FloatArray
    margin: FloatArray
    rank: IntArray
    attainable: BoolArray
    rank_deficient: BoolArray
    negative_at_rest: BoolArray
    negative_in_motion: BoolArray
    unbalanced: BoolArray
    unreachable: BoolArray
    tension_min: FloatArray

    @property
    def free_directions(self) -> FloatArray:
        """Directions less what points along axes on which the platform does not move, (Q, m, 3)."""
        return self.directions * np.isin(np.arange(3), self.free_axes)

    def by_position(self, values: FloatArray) -> FloatArray:
        """Rearrange (Q, m, ...) to (P, E·m, ...): all that one position asks, over its cases."""
        return values.reshape(len(self.positions), -1, *values.shape[2:])

    def positions_with(self, poses: BoolArray) -> int:
        """Count the positions where `poses`, (Q,), holds in one case or more."""
        return int(poses.reshape(len(self.positions), -1).any(axis=1).sum())

    @property
    def attainable_positions(self) -> BoolArray:
        """Positions that a drive without limits could hold in every case, (P,)."""
        return np.asarray(self.attainable.reshape(len(self.positions), -1).all(axis=1), dtype=np.bool_)


def compute_demand(
    robot: CableRobot,
    positions: FloatArray,
    orientations: FloatArray,
    wrenches: Wrenches,
    motion: MotionSet,
    *,
    tension_model: TensionModel = TensionModel.PSEUDO_INVERSE,
    progress: Progress | None = None,
) -> Demand:
    """Work out the demand.

    Parameters
    ----------
    robot : CableRobot
        With m cables.
    positions : (P, 3) array
        [m]
    orientations : (O, 3) array
        Every position is taken at every orientation. [rad]
    wrenches : sequence of sequence of RequiredWrench
        What the cables must supply together: for every orientation, of every load.
    motion : MotionSet
        Velocities and accelerations.
    tension_model : TensionModel
        How the cables share the load.
    progress : callable, optional
        Called with (poses done, poses).

    Returns
    -------
    Demand
        Over all poses.

    References
    ----------
    Eqs. 1-29 in Filipović & Kevac 2018, doi:10.22190/FUACR1802071F, their worst cases in closed form.
    """
    rows = balanced_rows(robot, tension_model)
    poses = len(positions) * len(orientations)
    work = _Work(robot=robot, rows=rows, motion=motion, model=tension_model, wrenches=wrenches, poses=poses)
    each_position = np.repeat(positions, len(orientations), axis=0)
    which = np.tile(np.arange(len(orientations)), len(positions))
    parts: list[dict[str, np.ndarray]] = []
    samples = max(LEAST_CELLS, len(motion.velocities), len(wrenches[0]) * motion.cases)
    step = max(1, CELLS_AT_ONCE // (robot.cables * samples))
    for start in range(0, len(which), step):
        chunk = slice(start, start + step)
        parts.append(work.chunk(each_position[chunk], orientations, which[chunk]))
        if progress is not None:
            progress(min(start + step, len(which)), len(which))
    arrays = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    tensions = None
    if tension_model is TensionModel.PSEUDO_INVERSE:
        tensions = LinearTensions(
            static=arrays.pop("static"),
            per_acceleration=arrays.pop("per_acceleration"),
            middle=arrays.pop("middle"),
            other_reach=arrays.pop("other_reach"),
        )
    return Demand(
        positions=positions,
        orientations=orientations,
        motion=motion,
        tension_model=tension_model,
        free_axes=robot.free_axes,
        tensions=tensions,
        speed=np.maximum(arrays["speed_in"], arrays["speed_out"]),
        acceleration=np.maximum(arrays["acceleration_in"], arrays["acceleration_out"]),
        tension_min=robot.bounds.tension_min,
        **arrays,
    )


class _Work:
    """What is the same for every chunk of poses."""

    def __init__(
        self,
        *,
        robot: CableRobot,
        rows: tuple[int, ...],
        motion: MotionSet,
        model: TensionModel,
        wrenches: Wrenches,
        poses: int,
    ) -> None:
        self._robot, self._rows, self._motion, self._model, self._wrenches = robot, rows, motion, model, wrenches
        self._poses = poses
        self._scale = wrench_scale(robot, rows)
        scaled = wrench_sets(robot, rows, wrenches, motion)
        self._scaled = scaled
        # The pseudo-inverse is taken as published, with N and N m alike.
        self._sets = WrenchSets(
            centre=scaled.centre / self._scale,
            segments=scaled.segments / self._scale,
            balls=scaled.balls / self._scale[:, None],
        )
        self._cases = scaled.centre.shape[1]

    def chunk(self, positions: FloatArray, orientations: FloatArray, which: IntArray) -> dict[str, np.ndarray]:
        """Everything at q poses, as (q·E, ...) arrays."""
        robot = self._robot
        geometry = cable_geometry(robot, positions, orientations[which])
        structure = geometry.structure_matrix[:, self._rows]
        support = support_wrenches(robot, positions, orientations[which], self._rows)
        # A cable of no length has no direction: nothing can be said of it, and no actuator passes there.
        undefined = np.where(geometry.lengths > 0.0, 0.0, np.inf)
        unreachable = (geometry.lengths > robot.bounds.length_max * (1.0 + BOUND_TOLERANCE)).any(axis=1)
        if self._model is TensionModel.PSEUDO_INVERSE:
            arrays = self._pseudo_inverse(structure, which, support)
        else:
            arrays = self._minimax(structure, which, support)
        arrays |= self._winding(cable_motion(robot, geometry, self._motion), undefined)
        arrays["lengths"] = np.repeat(geometry.lengths, self._cases, axis=0)
        arrays["directions"] = np.repeat(geometry.directions, self._cases, axis=0)
        arrays["unreachable"] = np.repeat(unreachable, self._cases)
        arrays["force"] = arrays["force"] + np.repeat(undefined, self._cases, axis=0)
        arrays["force"][arrays["unreachable"]] = np.inf
        arrays["attainable"] = np.isfinite(arrays["force"]).all(axis=1)
        arrays["rank_deficient"] = arrays["rank"] < len(self._rows)
        return arrays

    def _winding(self, winding: CableMotion, undefined: FloatArray) -> dict[str, np.ndarray]:
        beyond = undefined[:, None]
        fields = {
            "speed_in": winding.speed_in + beyond,
            "speed_out": winding.speed_out + beyond,
            "acceleration_in": winding.acceleration_in + beyond,
            "acceleration_out": winding.acceleration_out + beyond,
            "acceleration_middle": winding.middle,
            "acceleration_reach": winding.reach,
            "swing_min": winding.least_swing,
            "swing_max": winding.most_swing,
        }
        poses, listed, cables = winding.middle.shape
        shape = (poses, self._cases // listed, listed, cables)
        return {
            name: np.broadcast_to(values[:, None], shape).reshape(-1, cables).copy() for name, values in fields.items()
        }

    def _minimax(self, structure: FloatArray, which: IntArray, support: Support) -> dict[str, np.ndarray]:
        bounds, cables = self._robot.bounds, self._robot.cables
        controlled = len(support.lower)
        columns = np.concatenate([structure, support.controlled], axis=2) * self._scale[:, None]
        holding = hold_wrenches(
            columns,
            self._scaled,
            which,
            support.constant * self._scale,
            ColumnBounds(
                lower=np.concatenate([bounds.tension_min, support.lower]),
                upper=np.concatenate([bounds.tension_max, support.upper]),
                shared=np.arange(cables + controlled) < cables,
            ),
            poses_in_all=self._poses,
        )
        rank = holding.rank if not controlled else structure_rank(columns[:, :, :cables])[0]
        poses = len(which) * self._cases
        never = np.zeros(poses, dtype=np.bool_)
        return {
            "force": np.repeat(holding.minimax_tension.reshape(poses, 1), cables, axis=1),
            "margin": holding.margin.reshape(poses),
            "rank": np.repeat(rank, self._cases),
            "negative_at_rest": never,
            "negative_in_motion": never,
            "unbalanced": never,
        }

    def _pseudo_inverse(self, structure: FloatArray, which: IntArray, support: Support) -> dict[str, np.ndarray]:
        inverse = pseudo_inverse(structure)
        cables, poses = self._robot.cables, len(which) * self._cases
        static, per_acceleration = self._linear(inverse.matrix, which, support)
        centre = self._sets.centre[which] - support.constant[:, None]
        middle = np.einsum("qmn,qgn->qgm", inverse.matrix, centre)
        reach = np.stack([self._sets.reach(inverse.matrix[:, cable], which) for cable in range(cables)], axis=-1)
        coupled = self._coupled(per_acceleration.reshape(*middle.shape, 3))
        middle, reach, static = (values.reshape(poses, cables) for values in (middle, reach, static))
        tolerance = NEGATIVE_TENSION_TOLERANCE * np.abs(static).max(axis=1, keepdims=True)
        return {
            "static": static,
            "per_acceleration": per_acceleration.reshape(poses, cables, 3),
            "middle": middle,
            "other_reach": np.maximum(0.0, reach - coupled.reshape(poses, cables)),
            "force": np.abs(middle) + reach,
            "margin": np.full(poses, np.nan),
            "rank": np.repeat(inverse.rank, self._cases),
            "negative_at_rest": (static < -tolerance).any(axis=1),
            "negative_in_motion": (middle - reach < -tolerance).any(axis=1),
            "unbalanced": leaves_unbalanced(inverse, self._sets, which, support.constant).reshape(poses),
        }

    def _linear(self, matrix: FloatArray, which: IntArray, support: Support) -> tuple[FloatArray, FloatArray]:
        """Tensions at rest, (q, G, m), and per unit of acceleration, (q, G, m, 3)."""
        rows = list(self._rows)
        columns = np.array(
            [[np.column_stack([w.static, w.per_acceleration])[rows] for w in loads] for loads in self._wrenches]
        )
        tensions = np.einsum("qmn,qkna->qkma", matrix, columns[which])
        tensions[..., 0] -= np.einsum("qmn,qn->qm", matrix, support.constant)[:, None]
        tensions = np.repeat(tensions, self._motion.cases, axis=1)
        return tensions[..., 0], tensions[..., 1:]

    def _coupled(self, per_acceleration: FloatArray) -> FloatArray:
        """The part of the tension's reach that the platform's acceleration gives, (q, G, m)."""
        motion = self._motion
        if motion.kind is MotionKind.LISTED:
            return np.zeros(per_acceleration.shape[:-1])
        return extent(per_acceleration, motion.acceleration_reach, motion.acceleration_shape)
