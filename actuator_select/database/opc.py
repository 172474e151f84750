"""Names of OPC 40400-1 (OPC UA for Powertrain, Part 1: Asset Management) for the columns that it knows.

References
----------
OPC 40400-1, release 1.0, 2024: Identification, PtMotorRotaryAttributesType, PtMotorRatedAttributesType,
PtMotorRotaryRatedAttributesType, PtInputInterfaceAttributesType, PtGearAttributesType;
https://reference.opcfoundation.org/specs/OPC-40400-1.
"""

from types import MappingProxyType

from actuator_select.database.fields import Kind

_IDENTIFICATION = {"manufacturer": "Manufacturer", "series": "Model", "part_number": "ProductCode"}

OPC_NAMES = MappingProxyType(
    {
        "motors": MappingProxyType(
            _IDENTIFICATION
            | {
                "rated_power_w": "MotorPowerRated",
                "nominal_voltage_v": "InputVoltageRated",
                "rated_speed_rpm": "MotorSpeedRated",
                "rated_torque_nm": "MotorTorqueRated",
                "rated_current_a": "InputCurrentRated",
                "standstill_torque_nm": "MotorTorqueContinuousStall",
                "standstill_current_a": "MotorCurrentContinuousStall",
                "peak_torque_nm": "MotorTorqueMax",
                "max_speed_rpm": "MotorSpeedMax",
                "torque_constant_nm_per_a": "MotorTorqueConstant",
                "back_emf_constant_v_s_per_rad": "MotorBackEMF",
                "rotor_inertia_g_cm2": "MotorInertia",
                "pole_pairs": "MotorPolePairs",
            }
        ),
        "gearboxes": MappingProxyType(
            _IDENTIFICATION
            | {
                "ratio": "GearRatio",
                "efficiency_percent": "Efficiency",
                "max_continuous_torque_nm": "TorqueRated",
                "backlash_arcmin": "Backlash",
                "inertia_input_g_cm2": "GearInertia",
            }
        ),
    }
)
"""OPC names by kind and column; other kinds and columns keep the catalogue's own names."""


def opc_name(kind: Kind, column: str) -> str:
    """Name of a column in exchange files: OPC's where it has one, else the catalogue's own."""
    return OPC_NAMES.get(kind.name, MappingProxyType({})).get(column, column)
