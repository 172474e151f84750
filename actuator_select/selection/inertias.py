"""What turns with a motor: rotor, gearbox and drum, as one inertia at the motor's shaft.

With eq. 22 of [1], J_r = J_M N² ξ behind the gearbox, an inertia J_d at the drum adds J_d/(N² ξ) at the motor.

References
----------
.. [1] Filipović & Kevac 2018, doi:10.22190/FUACR1802071F.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from actuator_select.selection.assumptions import Assumed
from actuator_select.selection.electrical import Row
from actuator_select.study.schema import AssumptionsTable
from actuator_select.units import kg_m2

GEARBOX_KEY = "assumptions.gearbox_inertia_g_cm2"
DRUM_KEY = "assumptions.drum_inertia_kg_m2"
NO_GEARBOX, NO_DRUM = "inertia of the gearbox", "inertia of the drum"
NO_SHAFT = "shaft of the winch's inertia (winch_inertia_at)"


@dataclass(frozen=True, slots=True, kw_only=True)
class MotorInertia:
    """Inertia of one actuator at its motor's shaft.

    Attributes
    ----------
    value : float or None
        Of all that turns; None where it is unknown. [kg m²]
    assumed : tuple of Assumed
        What was taken of gearbox and drum beyond the row.
    left_out : tuple of str
        What is missing in `value`, because neither the row nor the study states it.
    lacks : tuple of str
        Figures of the model for want of which the drum's inertia cannot be seen from the motor.
    """

    value: float | None
    assumed: tuple[Assumed, ...] = ()
    left_out: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Share:
    """What gearbox or drum adds, and how that is known."""

    at_motor: float = 0.0
    at_drum: float = 0.0
    assumed: tuple[Assumed, ...] = ()
    left_out: tuple[str, ...] = ()


def motor_inertia(
    row: Row, figures: Mapping[str, float], assumptions: AssumptionsTable, *, needed: bool = True
) -> MotorInertia:
    """Add what gearbox and drum state, or what the study assumes of them, to the rotor's inertia.

    Parameters
    ----------
    row : mapping
        Catalogue row with its joined columns.
    figures : mapping of str to float
        Its figures in SI units, assumed ones among them; `rotor_inertia` of the rotor alone.
    assumptions : AssumptionsTable
        Of the study.
    needed : bool
        Whether some check needs the inertia; if none does, nothing is assumed and nothing is left out.

    Returns
    -------
    MotorInertia
        Unknown where the rotor's is, or where a drum's inertia is known but ratio or efficiency is not.
    """
    rotor = figures.get("rotor_inertia")
    if rotor is None:
        return MotorInertia(value=None)
    gearbox, drum = _gearbox(row, assumptions, needed=needed), _drum(row, assumptions, needed=needed)
    seen = 0.0
    if drum.at_drum:
        lacks = tuple(name for name in ("ratio", "efficiency") if name not in figures)
        if lacks:
            return MotorInertia(value=None, lacks=lacks)
        seen = drum.at_drum / (figures["ratio"] ** 2 * figures["efficiency"])  # eq. 22, from the drum to the motor
    return MotorInertia(
        value=rotor + gearbox.at_motor + drum.at_motor + seen,
        assumed=gearbox.assumed + drum.assumed,
        left_out=gearbox.left_out + drum.left_out,
    )


def drum_needs_transmission(row: Row, assumptions: AssumptionsTable) -> bool:
    """Whether a drum's inertia is known, so that ratio and efficiency are needed to see it from the motor."""
    return _drum(row, assumptions, needed=True).at_drum > 0.0


def _gearbox(row: Row, assumptions: AssumptionsTable, *, needed: bool) -> _Share:
    if row.get("gearbox_id") is None:
        return _Share()
    stated, given = row.get("gearbox.inertia_input_g_cm2"), assumptions.gearbox_inertia_g_cm2
    if stated is not None:
        return _Share(at_motor=kg_m2(float(stated)))
    if not needed:
        return _Share()
    if given is None:
        return _Share(left_out=(NO_GEARBOX,))
    assumed = Assumed(
        figure="gearbox_inertia",
        column="gearbox.inertia_input_g_cm2",
        value=given,
        unit="g cm²",
        key=GEARBOX_KEY,
        text=f"gearbox inertia {given:g} g cm²",
    )
    return _Share(at_motor=kg_m2(given), assumed=(assumed,))


def _drum(row: Row, assumptions: AssumptionsTable, *, needed: bool) -> _Share:
    """Of the drum alone where that is stated, else of the whole winch where its shaft is."""
    stated, whole = row.get("winch.drum_inertia_kg_m2"), row.get("winch.winch_inertia_kg_m2")
    shaft, given = row.get("winch.winch_inertia_at"), assumptions.drum_inertia_kg_m2
    if stated is not None:
        return _Share(at_drum=float(stated))
    if whole is not None and shaft == "drum_shaft":
        return _Share(at_drum=float(whole))
    if whole is not None and shaft == "motor_shaft":
        return _Share(at_motor=float(whole))
    if not needed:
        return _Share()
    if given is None:
        return _Share(left_out=(NO_DRUM if whole is None else NO_SHAFT,))
    assumed = Assumed(
        figure="drum_inertia",
        column="winch.drum_inertia_kg_m2",
        value=given,
        unit="kg m²",
        key=DRUM_KEY,
        text=f"drum inertia {given:g} kg m²",
    )
    return _Share(at_drum=given, assumed=(assumed,))
