"""What can be drawn of a part: regions, lines, limits and marks, with what is missing and what to know."""

from dataclasses import dataclass, field
from enum import Enum
from math import isfinite, isinf, nan

from actuator_select.selection.electrical import Row

Point = tuple[float, float]


class Duty(Enum):
    """How long a limit holds."""

    CONTINUOUS = "continuous"
    SHORT = "short"
    PART = "part"
    EMERGENCY = "emergency"


@dataclass(frozen=True, slots=True, kw_only=True)
class Region:
    """An area of the plane, speed × load, in which the part may work.

    Attributes
    ----------
    name : str
        What it is.
    duty : Duty
        How long.
    corners : tuple of (float, float)
        Speed and load, in the units of the characteristics.
    """

    name: str
    duty: Duty
    corners: tuple[Point, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Slope:
    """A straight line from a load at standstill to a speed without load.

    Attributes
    ----------
    name : str
        What it is.
    load, speed : float
        Its ends.
    printed : bool
        Whether an end is a printed figure because a constant is unknown.
    """

    name: str
    load: float
    speed: float
    printed: bool

    def speed_at(self, load: float) -> float:
        """Speed that it leaves at a load; not below zero."""
        return max(0.0, self.speed * (1.0 - load / self.load))


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A limit of one quantity.

    Attributes
    ----------
    name : str
        What it is.
    duty : Duty
        How long it holds.
    of_load : bool
        Whether it limits the load, else the speed.
    value : float
        In the unit of that quantity.
    """

    name: str
    duty: Duty
    of_load: bool
    value: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """A single working point, (speed, load)."""

    name: str
    speed: float
    load: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Characteristics:
    """What to draw of a part.

    Attributes
    ----------
    title : str
        Which part.
    speed_name, speed_unit, load_name, load_unit : str
        The axes.
    regions, slopes, limits, marks : tuple
        What the row states.
    missing : tuple of str
        What it does not state.
    notes : tuple of str
        What a reader has to know.
    """

    title: str
    speed_name: str
    speed_unit: str
    load_name: str
    load_unit: str
    regions: tuple[Region, ...] = ()
    slopes: tuple[Slope, ...] = ()
    limits: tuple[Limit, ...] = ()
    marks: tuple[Mark, ...] = ()
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass(slots=True)
class Sketch:
    """Figures of a row and what comes of them; a figure that is asked for and unknown is noted as missing."""

    row: Row
    missing: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    regions: list[Region] = field(default_factory=list)
    slopes: list[Slope] = field(default_factory=list)
    limits: list[Limit] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)

    def figure(self, column: str, name: str = "") -> float:
        """Figure of a column, NaN where unknown; with a name it is missed, or noted as unlimited."""
        value = self.row.get(column)
        if value is None:
            if name:
                self.missing.append(name)
            return nan
        if name and isinf(value):
            self.notes.append(f"{name}: unlimited")
        return float(value)

    def limit(self, value: float, name: str, duty: Duty, *, of_load: bool) -> None:
        """Keep a limit that is a number."""
        if isfinite(value):
            self.limits.append(Limit(name=name, duty=duty, of_load=of_load, value=value))

    def region(self, name: str, duty: Duty, *corners: Point) -> None:
        """Keep a region whose corners are all known and that is not empty."""
        if all(isfinite(one) for corner in corners for one in corner) and len(set(corners)) > 2:  # noqa: PLR2004
            self.regions.append(Region(name=name, duty=duty, corners=corners))

    def done(self, **names: str) -> Characteristics:
        """What was found."""
        return Characteristics(
            regions=tuple(self.regions),
            slopes=tuple(self.slopes),
            limits=tuple(self.limits),
            marks=tuple(self.marks),
            missing=tuple(self.missing),
            notes=tuple(self.notes),
            **names,
        )
