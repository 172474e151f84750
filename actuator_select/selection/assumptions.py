"""What the catalogue does not state: assumptions that the study names, and what the electrical figures hold for."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from actuator_select.selection.electrical import MOTOR_TERMINALS, NO_TERMINAL_VOLTAGE, Row
from actuator_select.study.schema import AssumptionsTable
from actuator_select.units import fraction, kg_m2

SERVOS = ("pmsm_servo", "pmsm_direct_drive")  # whose convention has to be stated
PHASES = ("bldc", "bldc_torque")

INERTIA_KEY = "assumptions.rotor_inertia_g_cm2"
FRICTION_KEY = "assumptions.viscous_friction_nm_s_per_rad"
SHARE_KEY = "assumptions.gearbox_efficiency_of_maximum"
EFFICIENCY_KEY = "assumptions.gearbox_efficiency_percent"


@dataclass(frozen=True, slots=True, kw_only=True)
class Assumed:
    """One figure of one actuator that the catalogue does not state.

    Attributes
    ----------
    figure : str
        Of the model's actuators.
    column : str
        Of the catalogue, in which nothing stands.
    value : float or str
        What was taken, in `unit`.
    unit : str
        Of the column; empty where the value is a word.
    key : str
        Of the study, which names the assumption; empty where it is the program's own reading.
    text : str
        For people: what was assumed, the same for every actuator to which it happened for the same reason.
    """

    figure: str
    column: str
    value: float | str
    unit: str
    key: str
    text: str


def with_assumptions(
    row: Row, figures: Mapping[str, float], assumptions: AssumptionsTable, needed: Collection[str] | None = None
) -> tuple[dict[str, float], tuple[Assumed, ...]]:
    """Complete one actuator's figures by what may be assumed of them.

    Parameters
    ----------
    row : mapping
        Catalogue row with its joined columns.
    figures : mapping of str to float
        What it states, SI units. A figure that stands here stays as it is.
    assumptions : AssumptionsTable
        Of the study.
    needed : collection of str, optional
        Figures that some check needs; of others nothing is assumed. All by default.

    Returns
    -------
    tuple of dict and tuple of Assumed
        The figures, `direct_current` among them, and what was taken beyond the row.
    """
    complete = dict(figures)
    taken: list[Assumed] = []
    complete["direct_current"], reading = _direct_current(row)
    if reading and needed is not None and "direct_current" not in needed:
        complete["direct_current"], reading = np.nan, ()
    damped = complete["direct_current"] != 0.0  # friction enters eq. 21 alone
    for figure, found in (
        ("rotor_inertia", _inertia(assumptions)),
        ("friction", _friction(assumptions) if damped else None),
        ("efficiency", _efficiency(row, assumptions)),
    ):
        if figure not in complete and found is not None and (needed is None or figure in needed):
            complete[figure], assumed = found
            taken.append(assumed)
    return complete, (*taken, *reading)


def assumption_keys(row: Row) -> dict[str, str]:
    """Figures of the model that a study may assume of an actuator where they are unknown, with the key that does so.

    Of a gearbox that states its greatest efficiency a share can be taken, of any other a figure be given.
    """
    stated = row.get("gearbox.max_efficiency_percent") is not None
    return {
        "rotor_inertia": INERTIA_KEY,
        "friction": FRICTION_KEY,
        "efficiency": SHARE_KEY if stated else EFFICIENCY_KEY,
    }


def why_no_voltage(row: Row) -> str:
    """Why eq. 34 says nothing about the motor of a row: what its electrical figures are; empty where it does."""
    return NO_TERMINAL_VOLTAGE.get(str(row.get("motor.electrical_convention")), "")


def _inertia(assumptions: AssumptionsTable) -> tuple[float, Assumed] | None:
    value = assumptions.rotor_inertia_g_cm2
    if value is None:
        return None
    return kg_m2(value), Assumed(
        figure="rotor_inertia",
        column="motor.rotor_inertia_g_cm2",
        value=value,
        unit="g cm²",
        key=INERTIA_KEY,
        text=f"rotor inertia {value:g} g cm²",
    )


def _friction(assumptions: AssumptionsTable) -> tuple[float, Assumed] | None:
    value = assumptions.viscous_friction_nm_s_per_rad
    if value is None:
        return None
    return value, Assumed(
        figure="friction",
        column="motor.viscous_friction_nm_s_per_rad",
        value=value,
        unit="N m s/rad",
        key=FRICTION_KEY,
        text=f"viscous friction {value:g} N m s/rad",
    )


def _efficiency(row: Row, assumptions: AssumptionsTable) -> tuple[float, Assumed] | None:
    """Of a gearbox that states none: a share of the greatest, which is never taken as it stands; else a given one."""
    greatest = row.get("gearbox.max_efficiency_percent")
    share, given = assumptions.gearbox_efficiency_of_maximum, assumptions.gearbox_efficiency_percent
    if row.get("gearbox_id") is None or row.get("winch.gear_ratio") is not None:
        return None  # no gear, or one in the winch whose losses the gearbox's figures do not tell
    if greatest is not None and share is not None:
        value, key = share * float(greatest), SHARE_KEY
        text = f"gearbox efficiency {share:g} × the greatest that is stated"
    elif greatest is None and given is not None:
        value, key = given, EFFICIENCY_KEY
        text = f"gearbox efficiency {given:g} %"
    else:
        return None
    return fraction(value), Assumed(
        figure="efficiency", column="gearbox.efficiency_percent", value=value, unit="%", key=key, text=text
    )


def _direct_current(row: Row) -> tuple[float, tuple[Assumed, ...]]:
    """Whether the motor's electrical figures are DC, 1 or 0, NaN unknown; and whether that was taken for granted."""
    convention, construction = row.get("motor.electrical_convention"), row.get("motor.motor_type")
    if convention is not None:
        return float(convention in MOTOR_TERMINALS), ()
    if construction in SERVOS:
        return np.nan, ()
    if construction == "dc_brushed":
        return 1.0, ()
    return 1.0, (
        Assumed(
            figure="direct_current",
            column="motor.electrical_convention",
            value="dc_phase_to_phase" if construction in PHASES else "dc_terminal",
            unit="",
            key="",
            text="voltage, resistance and constants as DC values between two terminals",
        ),
    )
