"""What the words mean that state a convention: between what a figure is measured, and for which shaft it holds."""

from types import MappingProxyType

CONVENTIONS = MappingProxyType(
    {
        "electrical_convention": MappingProxyType(
            {
                "dc_terminal": "DC values between the two terminals (brushed motor)",
                "dc_phase_to_phase": "DC equivalent, phase to phase (block commutation): current is the DC line's",
                "dc_controller": "DC values at the input of the motor's own controller",
                "ac_rms_phase": "rms phase values (AC servo): torque constant per ampere rms, back-EMF line to line in "
                "volts rms; the DC voltage line does not apply",
            }
        ),
        "figures_at": MappingProxyType(
            {
                "motor_shaft": "figures hold at the motor's own shaft",
                "output_shaft": "figures hold at the output shaft of the built-in gear",
            }
        ),
        "winch_inertia_at": MappingProxyType(
            {
                "drum_shaft": "winch_inertia_kg_m2 is seen from the drum's shaft",
                "motor_shaft": "winch_inertia_kg_m2 is seen from the motor's shaft",
            }
        ),
        "check_status": MappingProxyType(
            {
                "pass": "the figures agreed with each other when they were read",
                "flag": "usable, but check_notes says what is off",
                "not_checkable": "too few figures to hold against each other",
            }
        ),
    }
)
"""Words by column and choice."""


def explained(column: str, choice: object) -> str:
    """What a choice means; empty where the word speaks for itself."""
    return CONVENTIONS.get(column, MappingProxyType({})).get(str(choice), "")
