"""What a study file may hold: one pydantic model per table, units in the key names."""

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

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


class Table(BaseModel):
    """A table of a study file; a key that it does not know is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class CableTable(Table):
    """One cable of an explicit robot."""

    frame_anchor_m: Vector
    platform_anchor_m: Vector


class RobotTable(Table):
    """A builder with its lengths, or explicit cables."""

    builder: Literal["cpr8"] | None = None
    frame_m: Size | None = None
    carrier_m: Size | None = None
    cable: Annotated[tuple[CableTable, ...], Field(min_length=1)] | None = None

    @model_validator(mode="after")
    def _one_description(self) -> Self:
        if (self.builder is None) == (self.cable is None):
            raise ValueError(
                'either builder = "cpr8" with frame_m and carrier_m, or at least one [[robot.cable]]; not both'
            )
        if self.builder is None and (self.frame_m or self.carrier_m):
            raise ValueError("frame_m and carrier_m only together with a builder; explicit cables have their anchors")
        if self.builder is not None and (self.frame_m is None or self.carrier_m is None):
            raise ValueError("frame_m = [length, width, height] and carrier_m = [length, width, height], both in m")
        return self


class PayloadTable(Table):
    """What hangs on the cables."""

    mass_kg: Positive


class WorkspaceTable(Table):
    """Where the robot has to work: a grid over a box, and the orientations at every position."""

    region: Literal["builder"] | None = None
    box_m: tuple[Interval, Interval, Interval] | None = None
    points: tuple[Count, Count, Count]
    orientations_rad: Annotated[tuple[Vector, ...], Field(min_length=1)] = ((0.0, 0.0, 0.0),)

    @model_validator(mode="after")
    def _one_region(self) -> Self:
        if (self.region is None) == (self.box_m is None):
            raise ValueError('either region = "builder" or box_m = [[x0, x1], [y0, y1], [z0, z1]] in m; not both')
        for axis, interval, points in zip("xyz", self.box_m or (), self.points, strict=False):
            if interval[0] > interval[1]:
                raise ValueError(f"box_m with the lower end first; {axis} runs from {interval[0]} to {interval[1]} m")
            if interval[0] == interval[1] and points > 1:
                raise ValueError(f"a single point along {axis}, where box_m has no extent; points says {points}")
        return self


class MotionTable(Table):
    """What the platform has to do at every pose."""

    set: Literal["independent", "sampled"] = "independent"
    speed_max_m_per_s: Positive
    acceleration_time_s: Positive
    deceleration_time_s: Positive
    centripetal: Annotated[bool, Field(strict=True)] = True
    velocity_intervals: Annotated[int, Field(strict=True, ge=2, le=60)] = 6
    acceleration_levels: Annotated[tuple[Annotated[Number, Field(ge=-1.0, le=1.0)], ...], Field(min_length=1)] = (
        -1.0,
        1.0,
    )

    @model_validator(mode="after")
    def _samples_only_where_sampled(self) -> Self:
        if self.set != "sampled":
            for key in ("velocity_intervals", "acceleration_levels"):
                if key in self.model_fields_set:
                    raise ValueError(f'set = "sampled" where {key} is given')
        return self


class TensionTable(Table):
    """How the cables share the load."""

    model: Literal["pseudo_inverse"] = "pseudo_inverse"


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

    kind: Literal["actuators"] = "actuators"
    where: Annotated[str, Field(strict=True)] = ""


class RequirementTable(Table):
    """What counts as good enough."""

    feasible_percent: Percent = 90.0


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


class StudyTable(Table):
    """A whole study file."""

    name: Text
    description: str = ""
    gravity_m_per_s2: NotNegative = 9.81
    robot: RobotTable
    payload: PayloadTable
    workspace: WorkspaceTable
    motion: MotionTable
    tension: TensionTable = TensionTable()
    checks: ChecksTable = ChecksTable()
    candidates: CandidatesTable = CandidatesTable()
    requirement: RequirementTable = RequirementTable()
    move: tuple[MoveTable, ...] = ()
    variant: tuple[VariantTable, ...] = ()
    published: PublishedTable | None = None
