"""From catalogue rows to the model's actuators: the one place where datasheet units become SI."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from actuator_select.database import Catalogue
from actuator_select.errors import NoCandidates, UnknownName, did_you_mean
from actuator_select.model.actuation import Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.evaluation import missing_figures, needed_figures
from actuator_select.model.tension import TensionModel
from actuator_select.selection.assumptions import Assumed, why_no_voltage, with_assumptions
from actuator_select.selection.electrical import Row, back_emf_constant
from actuator_select.selection.inertias import MotorInertia, drum_needs_transmission, motor_inertia
from actuator_select.study import Study
from actuator_select.study.schema import AssumptionsTable
from actuator_select.units import fraction, kg_m2, metres, rad_per_s


def _as_printed(value: float) -> float:
    return value


# Figure of the model, column of the catalogue, conversion; the back-EMF constant has two columns.
FIGURE_COLUMNS: tuple[tuple[str, str, Callable[[float], float]], ...] = (
    ("motor_speed", "motor.rated_speed_rpm", rad_per_s),
    ("motor_torque", "motor.rated_torque_nm", _as_printed),
    ("voltage", "motor.nominal_voltage_v", _as_printed),
    ("torque_constant", "motor.torque_constant_nm_per_a", _as_printed),
    ("resistance", "motor.terminal_resistance_ohm", _as_printed),
    ("friction", "motor.viscous_friction_nm_s_per_rad", _as_printed),
    ("rotor_inertia", "motor.rotor_inertia_g_cm2", kg_m2),
    ("drum_radius", "winch.drum_radius_mm", metres),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidates:
    """Actuators to choose among.

    Attributes
    ----------
    rows : tuple of mapping
        Catalogue rows with the joined columns, units as in the column names.
    actuators : ActuatorSet
        The same in SI units, NaN where unknown. `rotor_inertia` is that of rotor, gearbox and drum at the motor.
    assumed : tuple of tuple of Assumed
        For every actuator, the figures that the catalogue does not state and that were taken all the same.
    left_out : tuple of tuple of str
        For every actuator, what its inertia leaves out, because neither catalogue nor study states it.
    inertia_lacks : tuple of tuple of str
        For every actuator, figures for want of which a drum's inertia cannot be seen from the motor.
    """

    rows: tuple[Row, ...]
    actuators: ActuatorSet
    assumed: tuple[tuple[Assumed, ...], ...]
    left_out: tuple[tuple[str, ...], ...]
    inertia_lacks: tuple[tuple[str, ...], ...]

    @property
    def ids(self) -> list[str]:
        """Catalogue ids."""
        return [str(row["id"]) for row in self.rows]

    @property
    def names(self) -> list[str]:
        """Names for people."""
        return [str(row["name"]) for row in self.rows]

    def missing(self, check: Check, model: TensionModel) -> list[tuple[str, ...]]:
        """As `missing_figures`; an inertia that is unknown because of the drum's is called by what that takes."""
        return [
            tuple(
                dict.fromkeys(
                    name for one in lacking for name in (lacks if one == "rotor_inertia" and lacks else (one,))
                )
            )
            for lacking, lacks in zip(missing_figures(self.actuators, check, model), self.inertia_lacks, strict=True)
        ]


def from_rows(
    rows: Sequence[Row],
    assumptions: AssumptionsTable | None = None,
    needed: Mapping[Check, Sequence[str]] | None = None,
) -> Candidates:
    """Convert catalogue rows.

    Parameters
    ----------
    rows : sequence of mapping
        Rows of ``actuators`` with their joined columns.
    assumptions : AssumptionsTable, optional
        What stands for figures that the rows do not state; nothing by default.
    needed : mapping of Check to sequence of str, optional
        Figures of the model that each check needs; of others nothing is assumed. All by default.

    Returns
    -------
    Candidates
        In the order given.
    """
    stated = AssumptionsTable() if assumptions is None else assumptions
    complete = [_complete(row, stated, None if needed is None else _needed(row, stated, needed)) for row in rows]
    return Candidates(
        rows=tuple(rows),
        actuators=ActuatorSet.from_figures([figures for figures, _, _ in complete]),
        assumed=tuple(taken for _, taken, _ in complete),
        left_out=tuple(inertia.left_out for _, _, inertia in complete),
        inertia_lacks=tuple(inertia.lacks for _, _, inertia in complete),
    )


def find_candidates(study: Study, catalogue: Catalogue, where: str = "") -> Candidates:
    """Candidates of a study: catalogue rows that meet its own condition and a further one.

    Parameters
    ----------
    study : Study
        Its ``candidates.where`` and its ``[assumptions]`` apply.
    catalogue : Catalogue
        Where the actuators are.
    where : str, optional
        A further condition.

    Returns
    -------
    Candidates
        By id.

    Raises
    ------
    NoCandidates
        If no row is left.
    InvalidExpression
        If a condition cannot be read.
    """
    if study.table.candidates.kind == "none":
        raise NoCandidates(
            f"study {study.name!r} asks for no actuators (candidates.kind); "
            f"`actuator-select workspace {study.place}` finds where its robot can work"
        )
    own = study.table.candidates.where
    rows = catalogue.rows("actuators", where=own)
    if where:
        wanted = {row["id"] for row in catalogue.rows("actuators", where=where)}
        rows = [row for row in rows if row["id"] in wanted]
    if not rows:
        conditions = " and ".join(f"({condition})" for condition in (own, where) if condition)
        raise NoCandidates(
            f"no actuator in the catalogue meets {conditions}; relax the condition, "
            "`actuator-select catalog list actuators` shows what there is"
            if conditions
            else "the catalogue holds no actuator; `actuator-select catalog add actuators` adds one"
        )
    return study_candidates(study, rows)


def study_candidates(study: Study, rows: Sequence[Row]) -> Candidates:
    """Convert rows as a study asks for them: with its assumptions, as far as its checks need them."""
    needed = {check: needed_figures(check, study.tension_model) for check in study.checks}
    return from_rows(rows, study.table.assumptions, needed)


def find_actuator(catalogue: Catalogue, actuator: str, assumptions: AssumptionsTable | None = None) -> Candidates:
    """One actuator by its id or its name.

    Parameters
    ----------
    catalogue : Catalogue
        Where to look.
    actuator : str
        Id, or name in any case.
    assumptions : AssumptionsTable, optional
        As for `from_rows`.

    Returns
    -------
    Candidates
        With a single row.

    Raises
    ------
    UnknownName
        If there is none.
    """
    rows = catalogue.rows("actuators")
    by_id = [row for row in rows if actuator == row["id"]]
    for row in by_id or [row for row in rows if actuator.casefold() == str(row["name"]).casefold()]:
        return from_rows([row], assumptions)
    known = [str(row[key]) for row in rows for key in ("name", "id")]
    raise UnknownName(
        f"no actuator {actuator!r} in the catalogue; {did_you_mean(actuator, known)} "
        "(`actuator-select catalog list actuators` shows all)"
    )


def _complete(
    row: Row, assumptions: AssumptionsTable, needed: set[str] | None
) -> tuple[dict[str, float], tuple[Assumed, ...], MotorInertia]:
    """Figures of one row in SI units, what was taken beyond it, and the inertia at its motor's shaft."""
    figures, taken = with_assumptions(row, _figures(row), assumptions, needed)
    inertia = motor_inertia(row, figures, assumptions, needed=needed is None or "rotor_inertia" in needed)
    figures.pop("rotor_inertia", None)
    if inertia.value is not None:
        figures["rotor_inertia"] = inertia.value
    return figures, (*taken, *inertia.assumed), inertia


def _needed(row: Row, assumptions: AssumptionsTable, needed: Mapping[Check, Sequence[str]]) -> set[str]:
    """Figures that the checks need that apply to a row's motor, and what it takes to see its drum from there."""
    figures = {
        figure
        for check, names in needed.items()
        if check is not Check.VOLTAGE or not why_no_voltage(row)
        for figure in names
    }
    if "rotor_inertia" in figures and drum_needs_transmission(row, assumptions):
        figures |= {"ratio", "efficiency"}
    return figures


def _figures(row: Row) -> dict[str, float]:
    figures = {
        figure: convert(float(row[column])) for figure, column, convert in FIGURE_COLUMNS if row.get(column) is not None
    }
    back_emf = back_emf_constant(row, "motor.")
    if back_emf is not None:
        figures["back_emf_constant"] = back_emf
    return figures | _transmission(row)


def _transmission(row: Row) -> dict[str, float]:
    """Ratio and efficiency of gearbox and winch; the assembly's own efficiency goes before the gearbox's.

    A drum on the motor's shaft has no gear to lose torque in. Of a winch with a gear of its own only the assembly can
    state the losses.
    """
    stated, inside = row.get("efficiency_percent"), row.get("winch.gear_ratio")
    direct = row.get("gearbox_id") is None
    ratio = 1.0 if direct else row.get("gearbox.ratio")
    lossless_or_gearbox = 100.0 if direct else row.get("gearbox.efficiency_percent")
    efficiency = stated if stated is not None or inside is not None else lossless_or_gearbox
    figures = {}
    if ratio is not None:
        figures["ratio"] = float(ratio) * (1.0 if inside is None else float(inside))
    if efficiency is not None:
        figures["efficiency"] = fraction(float(efficiency))
    return figures
