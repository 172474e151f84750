"""Cable-driven robots: where the cables are fixed, what they may carry, and how the platform may move."""

from dataclasses import dataclass, field, fields
from enum import StrEnum

import numpy as np

from actuator_select.model.arrays import FloatArray


class Freedom(StrEnum):
    """Degrees of freedom of the platform that the cables control: T translations, R rotations."""

    POINT_IN_PLANE = "2T"
    POINT = "3T"
    PLANAR = "1R2T"
    SPATIAL = "3R3T"


class Plane(StrEnum):
    """Plane in which a planar robot moves; gravity acts along -z."""

    XZ = "xz"
    XY = "xy"
    YZ = "yz"


# Rows of the wrench [force, moment] that lie in the plane: two forces, and the moment about the plane's normal.
_PLANE_ROWS = {Plane.XZ: (0, 2, 4), Plane.XY: (0, 1, 5), Plane.YZ: (1, 2, 3)}
_PLANE_AXES = {Plane.XZ: (0, 2), Plane.XY: (0, 1), Plane.YZ: (1, 2)}
_PLANE_NORMAL = {Plane.XZ: 1, Plane.XY: 2, Plane.YZ: 0}


@dataclass(frozen=True, slots=True, kw_only=True)
class RigidBody:
    """Mass that moves with the platform.

    Attributes
    ----------
    mass : float
        [kg]
    centre_of_gravity : (3,) array
        Platform frame. [m]
    inertia : (3, 3) array
        About the centre of gravity, along the platform's axes. [kg m²]
    """

    mass: float
    centre_of_gravity: FloatArray = field(default_factory=lambda: np.zeros(3))
    inertia: FloatArray = field(default_factory=lambda: np.zeros((3, 3)))

    def __post_init__(self) -> None:
        _freeze(self, "centre_of_gravity", "inertia")


@dataclass(frozen=True, slots=True, kw_only=True)
class CableBounds:
    """What each of m cables may carry and how long it may be; infinite where there is no bound.

    Attributes
    ----------
    tension_min, tension_max : (m,) array
        [N]
    length_min, length_max : (m,) array
        Of the straight cable. [m]
    speed_max : (m,) array
        [m/s]
    axial_stiffness : (m,) array
        EA, the force that would stretch the cable to twice its length. [N]
    """

    tension_min: FloatArray
    tension_max: FloatArray
    length_min: FloatArray
    length_max: FloatArray
    speed_max: FloatArray
    axial_stiffness: FloatArray

    def __post_init__(self) -> None:
        _freeze(self, *(one.name for one in fields(self)))
        for lower, upper in (("tension_min", "tension_max"), ("length_min", "length_max")):
            if np.any(getattr(self, lower) > getattr(self, upper)):
                raise ValueError(f"{lower} exceeds {upper}")

    @classmethod
    def of(cls, cables: int, **bounds: float | FloatArray) -> "CableBounds":
        """Bounds of m cables, each a number or one number per cable; what is left out is no bound."""
        default = {
            "tension_min": 0.0,
            "tension_max": np.inf,
            "length_min": 0.0,
            "length_max": np.inf,
            "speed_max": np.inf,
            "axial_stiffness": np.inf,
        }
        values = default | bounds
        return cls(
            **{name: np.broadcast_to(np.asarray(value, np.float64), (cables,)) for name, value in values.items()}
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Counterbalance:
    """One rope over k segments between platform and frame, all at one tension that no winch of the robot sets.

    Attributes
    ----------
    frame_anchors, platform_anchors : (k, 3) array
        Ends of the segments, as of cables. [m]
    tension_min, tension_max : float
        Equal for a counterweight; apart where the tension is controlled within a range. [N]

    References
    ----------
    Qi, Jamshidifar & Khajepour 2020, arXiv:2012.12387, section 2.
    """

    frame_anchors: FloatArray
    platform_anchors: FloatArray
    tension_min: float
    tension_max: float

    def __post_init__(self) -> None:
        _freeze(self, "frame_anchors", "platform_anchors")
        if self.frame_anchors.shape != self.platform_anchors.shape or self.frame_anchors.shape[1:] != (3,):
            raise ValueError(f"{self.platform_anchors.shape=} but {self.frame_anchors.shape=}")
        if not 0.0 <= self.tension_min <= self.tension_max:
            raise ValueError(f"{self.tension_min=} and {self.tension_max=}, expected 0 <= min <= max")

    @property
    def is_controlled(self) -> bool:
        """Whether the tension may take any value of a range."""
        return self.tension_max > self.tension_min


@dataclass(frozen=True, slots=True, kw_only=True)
class CableRobot:
    """A platform on m cables.

    Attributes
    ----------
    frame_anchors : (m, 3) array
        Where each cable leaves the frame, world frame, z up. [m]
    platform_anchors : (m, 3) array
        Where each cable is fixed, platform frame. [m]
    freedom : Freedom
        By default 3T if all platform anchors lie in the platform's origin, else 3R3T.
    plane : Plane
        Of a planar robot.
    platform : RigidBody
        The platform itself, without loads.
    bounds : CableBounds
        By default tensions from 0 and no other bound.
    counterbalances : tuple of Counterbalance
        Beside the cables.
    """

    frame_anchors: FloatArray
    platform_anchors: FloatArray
    freedom: Freedom = None  # type: ignore[assignment]  # set at birth
    plane: Plane = Plane.XZ
    platform: RigidBody = field(default_factory=lambda: RigidBody(mass=0.0))
    bounds: CableBounds = None  # type: ignore[assignment]  # set at birth
    counterbalances: tuple[Counterbalance, ...] = ()

    def __post_init__(self) -> None:
        _freeze(self, "frame_anchors", "platform_anchors")
        if self.frame_anchors.ndim != 2 or self.frame_anchors.shape[1] != 3 or not len(self.frame_anchors):  # noqa: PLR2004 - x, y, z
            raise ValueError(f"{self.frame_anchors.shape=}, expected (cables, 3) with at least one cable")
        if self.platform_anchors.shape != self.frame_anchors.shape:
            raise ValueError(f"{self.platform_anchors.shape=} but {self.frame_anchors.shape=}")
        if not (np.isfinite(self.frame_anchors).all() and np.isfinite(self.platform_anchors).all()):
            raise ValueError("anchors must be finite")
        if self.freedom is None:
            object.__setattr__(self, "freedom", Freedom.SPATIAL if self.platform_anchors.any() else Freedom.POINT)
        if self.bounds is None:
            object.__setattr__(self, "bounds", CableBounds.of(self.cables))
        if self.bounds.tension_min.shape != (self.cables,):
            raise ValueError(f"{self.bounds.tension_min.shape=}, expected one bound per cable ({self.cables})")

    @property
    def cables(self) -> int:
        """Number of cables m."""
        return len(self.frame_anchors)

    @property
    def wrench_rows(self) -> tuple[int, ...]:
        """Rows of the wrench [force, moment] that the cables have to balance; n of them."""
        in_plane = _PLANE_ROWS[self.plane]
        return {
            Freedom.POINT_IN_PLANE: in_plane[:2],
            Freedom.POINT: (0, 1, 2),
            Freedom.PLANAR: in_plane,
            Freedom.SPATIAL: (0, 1, 2, 3, 4, 5),
        }[self.freedom]

    @property
    def translation_rows(self) -> tuple[int, ...]:
        """The rows of `wrench_rows` that are forces."""
        return tuple(row for row in self.wrench_rows if row < 3)  # noqa: PLR2004 - forces first

    @property
    def plane_normal(self) -> int:
        """Axis about which a planar robot turns: 0 x, 1 y, 2 z."""
        return _PLANE_NORMAL[self.plane]

    @property
    def free_axes(self) -> tuple[int, ...]:
        """Axes along which the platform translates."""
        planar = self.freedom in (Freedom.POINT_IN_PLANE, Freedom.PLANAR)
        return _PLANE_AXES[self.plane] if planar else (0, 1, 2)

    @property
    def turning_axes(self) -> tuple[int, ...]:
        """Axes about which the platform turns."""
        return {Freedom.SPATIAL: (0, 1, 2), Freedom.PLANAR: (self.plane_normal,)}.get(self.freedom, ())

    @property
    def leaves_out_moments(self) -> bool:
        """Whether the platform counts as a point although its cables do not meet in one."""
        point = self.freedom in (Freedom.POINT_IN_PLANE, Freedom.POINT)
        return point and bool(self.platform_anchors.any())

    @property
    def degrees_of_freedom(self) -> int:
        """Number n of equations that the cables have to balance."""
        return len(self.wrench_rows)

    @property
    def redundancy(self) -> int:
        """Cables beyond the degrees of freedom, m - n; negative where there are too few."""
        return self.cables - self.degrees_of_freedom

    @property
    def characteristic_length(self) -> float:
        """Root mean square distance of the platform anchors from the origin, by which moments are divided. [m]

        1 m where all of them lie in the origin, and no moment arises.
        """
        arm = float(np.sqrt((self.platform_anchors**2).sum(axis=1).mean()))
        return arm if arm > 0.0 else 1.0


def _freeze(instance: object, *names: str) -> None:
    """Replace array attributes by float copies that cannot be written to."""
    for name in names:
        values = np.array(getattr(instance, name), dtype=np.float64)
        values.flags.writeable = False
        object.__setattr__(instance, name, values)
