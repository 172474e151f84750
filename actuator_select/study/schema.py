"""What a study file may hold: one pydantic model per table, units in the key names."""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator

LARGE, SMALL = 1e6, 1e-6  # in any unit of a study; beyond them stands a slip, and arithmetic that overflows

Number = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LARGE, le=LARGE)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=SMALL, le=LARGE)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=LARGE)]
Percent = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=100.0)]
Text = Annotated[str, Field(strict=True, min_length=1)]
Count = Annotated[int, Field(strict=True, ge=1)]
Vector = tuple[Number, Number, Number]
Size = tuple[Positive, Positive, Positive]
Interval = tuple[Number, Number]
Matrix = tuple[Vector, Vector, Vector]
Reach = tuple[NotNegative, NotNegative, NotNegative]
Angles = Annotated[tuple[Number, ...], Field(min_length=1)]


def _ordered(interval: tuple[float, float] | None, key: str) -> None:
    if interval is not None and interval[0] > interval[1]:
        raise ValueError(f"{key} with the lower end first, not {list(interval)}")


def _percent_not_fraction(value: float) -> float:
    if not 1.0 < value <= 100.0:  # noqa: PLR2004 - per cent
        slip = f"; a fraction was given, write {100.0 * value:g}" if 0.0 < value <= 1.0 else ""
        raise ValueError(f"more than 1 and at most 100{slip}")
    return value


class Table(BaseModel):
    """A table of a study file; a key that it does not know is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class CableTable(Table):
    """One cable of an explicit robot."""

    frame_anchor_m: Vector
    platform_anchor_m: Vector


class CounterbalanceTable(Table):
    """One rope at one tension over one or more segments between frame and platform."""

    tension_n: NotNegative | None = None
    tension_range_n: tuple[NotNegative, NotNegative] | None = None
    segment: Annotated[tuple[CableTable, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _one_tension(self) -> Self:
        if (self.tension_n is None) == (self.tension_range_n is None):
            raise ValueError("either tension_n of a counterweight, or tension_range_n = [least, greatest]; not both")
        _ordered(self.tension_range_n, "tension_range_n")
        return self


# Lengths and the like that describe a robot of each family.
BUILDER_KEYS: dict[str, tuple[str, ...]] = {
    "cpr8": ("frame_m", "carrier_m"),
    "planar-4": ("w_m", "h_m", "w_b_m", "h_1_m", "h_bu_m", "w_p_m", "h_p_m", "h_bp_m", "w_bp_m", "configuration"),
    "six-six": ("r_base_m", "r_end_m", "gamma_deg"),
    "suspended-8": ("hall_m", "platform_m"),
    "constrained-8": ("hall_m", "platform_m"),
}
REGIONS = ("cpr8", "suspended-8", "constrained-8")  # builders that suggest a box to work in


class RobotTable(Table):
    """A builder with its lengths, or explicit cables; beside them what the platform is."""

    builder: Literal["cpr8", "planar-4", "six-six", "suspended-8", "constrained-8"] | None = None
    frame_m: Size | None = None
    carrier_m: Size | None = None
    hall_m: Size | None = None
    platform_m: Size | None = None
    r_base_m: Positive | None = None
    r_end_m: Positive | None = None
    gamma_deg: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=120.0)] | None = None
    w_m: Positive | None = None
    h_m: Positive | None = None
    w_b_m: Positive | None = None
    h_1_m: NotNegative | None = None
    h_bu_m: Number | None = None
    w_p_m: NotNegative | None = None
    h_p_m: Number | None = None
    h_bp_m: Number | None = None
    w_bp_m: NotNegative | None = None
    configuration: Literal["none", "a", "b", "c", "d"] | None = None
    t5_n: NotNegative | None = None
    t5_range_n: tuple[NotNegative, NotNegative] | None = None
    cable: Annotated[tuple[CableTable, ...], Field(min_length=1)] | None = None
    anchors_csv: Text | None = None
    degrees_of_freedom: Literal["2T", "3T", "1R2T", "3R3T"] | None = None
    plane: Literal["xz", "xy", "yz"] | None = None
    mass_kg: NotNegative = 0.0
    centre_of_gravity_m: Vector = (0.0, 0.0, 0.0)
    inertia_kg_m2: Matrix | None = None
    counterbalance: tuple[CounterbalanceTable, ...] = ()

    @model_validator(mode="after")
    def _one_description(self) -> Self:
        given = [name for name in ("builder", "cable", "anchors_csv") if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(
                "one of: a builder with its lengths, [[robot.cable]] tables, or anchors_csv; "
                f"given are {' and '.join(given) if given else 'none of them'}"
            )
        wanted = BUILDER_KEYS[self.builder] if self.builder else ()
        every = {key for keys in BUILDER_KEYS.values() for key in keys}
        for key in sorted(every - set(wanted)):
            if getattr(self, key) is not None:
                raise ValueError(f"no {key} with {f'the builder {self.builder}' if self.builder else given[0]}")
        missing = [key for key in wanted if getattr(self, key) is None]
        if missing:
            raise ValueError(f"{', '.join(missing)} for the builder {self.builder}")
        return self

    @model_validator(mode="after")
    def _one_rope_tension(self) -> Self:
        stated = [key for key in ("t5_n", "t5_range_n") if getattr(self, key) is not None]
        needed = self.builder == "planar-4" and self.configuration != "none"
        if needed and len(stated) != 1:
            raise ValueError("either t5_n, the tension of the counterbalance rope, or t5_range_n = [least, greatest]")
        if stated and not needed:
            raise ValueError(f"no {stated[0]} without the counterbalance rope of the builder planar-4")
        _ordered(self.t5_range_n, "t5_range_n")
        return self

    @model_validator(mode="after")
    def _a_plane_only_where_planar(self) -> Self:
        planar = self.degrees_of_freedom in ("2T", "1R2T")
        if self.plane is not None and not planar:
            raise ValueError('plane only with degrees_of_freedom = "2T" or "1R2T"')
        if self.builder is not None and self.degrees_of_freedom is not None:
            raise ValueError(f"no degrees_of_freedom with the builder {self.builder}, which knows its own")
        return self


PerCable = NotNegative | tuple[NotNegative, ...]
Stiffness = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0, le=1e12)]


class CablesTable(Table):
    """What every cable may carry, and how long it may be: a number for all, or a list with one per cable."""

    tension_min_n: PerCable | None = None
    tension_max_n: PerCable | None = None
    length_min_m: PerCable | None = None
    length_max_m: PerCable | None = None
    speed_max_m_per_s: PerCable | None = None
    axial_stiffness_n: Stiffness | tuple[Stiffness, ...] | None = None


class PayloadTable(Table):
    """What hangs on the cables beside the platform, and what pushes it."""

    title: Text = "payload"
    mass_kg: NotNegative = 0.0
    centre_of_gravity_m: Vector = (0.0, 0.0, 0.0)
    inertia_kg_m2: Matrix | None = None
    force_n: Vector = (0.0, 0.0, 0.0)
    force_reach_n: Reach = (0.0, 0.0, 0.0)
    moment_n_m: Vector = (0.0, 0.0, 0.0)
    moment_reach_n_m: Reach = (0.0, 0.0, 0.0)


def _as_list(value: object) -> object:
    """A single [payload] table is a list of one."""
    return [value] if isinstance(value, dict) else value


Payloads = Annotated[tuple[PayloadTable, ...], Field(min_length=1), BeforeValidator(_as_list)]


class WorkspaceTable(Table):
    """Where the robot has to work: a grid over a box, and the orientations at every position."""

    region: Literal["builder"] | None = None
    box_m: tuple[Interval, Interval, Interval] | None = None
    points: tuple[Count, Count, Count]
    grid: Literal["nodes", "midpoints"] = "nodes"
    orientations_rad: Annotated[tuple[Vector, ...], Field(min_length=1)] = ((0.0, 0.0, 0.0),)
    orientation_grid_deg: tuple[Angles, Angles, Angles] | None = None
    home_m: Vector | None = None

    @model_validator(mode="after")
    def _one_region(self) -> Self:
        if (self.region is None) == (self.box_m is None):
            raise ValueError('either region = "builder" or box_m = [[x0, x1], [y0, y1], [z0, z1]] in m; not both')
        for axis, interval, points in zip("xyz", self.box_m or (), self.points, strict=False):
            if interval[0] > interval[1]:
                raise ValueError(f"box_m with the lower end first; {axis} runs from {interval[0]} to {interval[1]} m")
            if interval[0] == interval[1] and points > 1:
                raise ValueError(f"a single point along {axis}, where box_m has no extent; points says {points}")
        if self.orientation_grid_deg is not None and "orientations_rad" in self.model_fields_set:
            raise ValueError("either orientations_rad or orientation_grid_deg; not both")
        return self


class MotionCaseTable(Table):
    """One motion that has to be possible at every pose."""

    velocity_m_per_s: Vector = (0.0, 0.0, 0.0)
    acceleration_m_per_s2: Vector = (0.0, 0.0, 0.0)
    angular_velocity_rad_per_s: Vector = (0.0, 0.0, 0.0)
    angular_acceleration_rad_per_s2: Vector = (0.0, 0.0, 0.0)


class MotionTable(Table):
    """What the platform has to do at every pose."""

    set: Literal["independent", "straight", "sampled", "list", "rest"] = "independent"
    speed_max_m_per_s: Positive | None = None
    acceleration_time_s: Positive | None = None
    deceleration_time_s: Positive | None = None
    velocity_set: Literal["ball", "box"] = "ball"
    acceleration_set: Literal["ball", "box"] | None = None
    angular_speed_max_rad_per_s: NotNegative = 0.0
    centripetal: Annotated[bool, Field(strict=True)] = True
    velocity_intervals: Annotated[int, Field(strict=True, ge=2, le=60)] = 6
    acceleration_levels: Annotated[tuple[Annotated[Number, Field(ge=-1.0, le=1.0)], ...], Field(min_length=1)] = (
        -1.0,
        1.0,
    )
    case: tuple[MotionCaseTable, ...] = ()

    @model_validator(mode="after")
    def _what_each_set_needs(self) -> Self:
        if self.set in ("independent", "straight", "sampled"):
            for key in ("speed_max_m_per_s", "acceleration_time_s", "deceleration_time_s"):
                if getattr(self, key) is None:
                    raise ValueError(f'{key}, which set = "{self.set}" needs')
        if self.set == "list" and not self.case:
            raise ValueError('at least one [[motion.case]] where set = "list"')
        if self.set != "sampled":
            for key in ("velocity_intervals", "acceleration_levels"):
                if key in self.model_fields_set:
                    raise ValueError(f'set = "sampled" where {key} is given')
        if self.set in ("sampled", "list") and self.angular_speed_max_rad_per_s > 0.0:
            raise ValueError(f'no angular_speed_max_rad_per_s where set = "{self.set}"')
        if self.set == "straight" and "box" in (self.velocity_set, self.acceleration_set):
            raise ValueError('no "box" where set = "straight"; its velocities and accelerations have any direction')
        return self


class TensionTable(Table):
    """How the cables share the load."""

    model: Literal["wrench_feasible", "force_only", "pseudo_inverse"] = "wrench_feasible"


class ChecksTable(Table):
    """Which limits have to hold."""

    apply: Annotated[
        tuple[Literal["speed", "torque", "acceleration", "voltage"], ...],
        Field(min_length=1),
    ] = ("speed", "torque", "acceleration", "voltage")

    @model_validator(mode="after")
    def _each_once(self) -> Self:
        if len(set(self.apply)) < len(self.apply):
            raise ValueError("every check once in apply")
        return self


class CandidatesTable(Table):
    """Which catalogue rows are considered."""

    kind: Literal["actuators", "none"] = "actuators"
    where: Annotated[str, Field(strict=True)] = ""


class AssumptionsTable(Table):
    """What stands for figures that the catalogue does not state; never for a limit or a constant of the motor."""

    rotor_inertia_g_cm2: NotNegative | None = None
    viscous_friction_nm_s_per_rad: NotNegative | None = None
    gearbox_inertia_g_cm2: NotNegative | None = None
    drum_inertia_kg_m2: NotNegative | None = None
    gearbox_efficiency_percent: Annotated[Number, AfterValidator(_percent_not_fraction)] | None = None
    gearbox_efficiency_of_maximum: Annotated[Positive, Field(le=1.0)] | None = None


class MustServeTable(Table):
    """A box or a position that has to be served whatever the share of the rest."""

    title: str = ""
    box_m: tuple[Interval, Interval, Interval] | None = None
    position_m: Vector | None = None

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        if (self.box_m is None) == (self.position_m is None):
            raise ValueError("either box_m = [[x0, x1], [y0, y1], [z0, z1]] or position_m = [x, y, z], both in m")
        for interval in self.box_m or ():
            _ordered(interval, "box_m")
        return self


class RequirementTable(Table):
    """What counts as good enough."""

    feasible_percent: Percent = 90.0
    must_serve: tuple[MustServeTable, ...] = ()

    @model_validator(mode="after")
    def _titles_differ(self) -> Self:
        titles = [place.title for place in self.must_serve if place.title]
        if len(set(titles)) < len(titles):
            raise ValueError("every title of [[requirement.must_serve]] once, so that results can name the place")
        return self


class MoveTable(Table):
    """A straight move that the report simulates."""

    title: Text
    from_m: Vector
    to_m: Vector
    orientation_rad: Vector = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _goes_somewhere(self) -> Self:
        if self.from_m == self.to_m:
            raise ValueError("to_m away from from_m; the move has no length")
        return self


class VariantTable(Table):
    """The same study with some keys changed, counted beside it in the report."""

    title: Text
    set: dict[str, object]


class PublishedTable(Table):
    """Percentages that a publication gives for catalogue actuators, to be compared in the report."""

    source: Text
    feasible_percent: dict[str, Percent]


class SweepTable(Table):
    """Keys that the report varies, and what it plots."""

    title: Text
    keys: Annotated[tuple[Text, ...], Field(min_length=1, max_length=3)]
    set: dict[str, object] = Field(default_factory=dict)
    note: str = ""


class NoteTable(Table):
    """A paragraph of the report."""

    title: Text
    text: Text


class StudyTable(Table):
    """A whole study file."""

    name: Text
    description: str = ""
    gravity_m_per_s2: NotNegative = 9.81
    robot: RobotTable
    cables: CablesTable = CablesTable()
    payload: Payloads = (PayloadTable(title="nothing"),)
    workspace: WorkspaceTable
    motion: MotionTable
    tension: TensionTable = TensionTable()
    checks: ChecksTable = ChecksTable()
    candidates: CandidatesTable = CandidatesTable()
    assumptions: AssumptionsTable = AssumptionsTable()
    requirement: RequirementTable = RequirementTable()
    move: tuple[MoveTable, ...] = ()
    variant: tuple[VariantTable, ...] = ()
    published: PublishedTable | None = None
    sweep: tuple[SweepTable, ...] = ()
    note: tuple[NoteTable, ...] = ()
