"""Actuators as the model sees them: motor, gearbox and winch in SI units, one array per figure."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from actuator_select.model.arrays import FloatArray, IntArray


@dataclass(frozen=True, slots=True, kw_only=True)
class ActuatorSet:
    """C actuators. NaN is unknown, infinity is unlimited, zero is zero.

    Attributes
    ----------
    motor_speed : (C,) array
        Greatest motor speed ω_mot. [rad/s]
    motor_torque : (C,) array
        Greatest motor torque M_mot. [N m]
    voltage : (C,) array
        Greatest terminal voltage U_mot. [V]
    back_emf_constant : (C,) array
        C_e. [V s/rad]
    torque_constant : (C,) array
        C_m. [N m/A]
    resistance : (C,) array
        Terminal resistance R_r. [Ω]
    friction : (C,) array
        Viscous friction B_c at the motor. [N m s/rad]
    rotor_inertia : (C,) array
        J_M at the motor. [kg m²]
    ratio : (C,) array
        Gear ratio N_V; 1 without a gearbox.
    efficiency : (C,) array
        Efficiency ξ of the assembly.
    drum_radius : (C,) array
        Winding radius R_w. [m]
    """

    motor_speed: FloatArray
    motor_torque: FloatArray
    voltage: FloatArray
    back_emf_constant: FloatArray
    torque_constant: FloatArray
    resistance: FloatArray
    friction: FloatArray
    rotor_inertia: FloatArray
    ratio: FloatArray
    efficiency: FloatArray
    drum_radius: FloatArray

    def __post_init__(self) -> None:
        count = np.shape(self.motor_speed)
        for field in fields(self):
            values = np.array(getattr(self, field.name), dtype=np.float64)
            if values.shape != count or values.ndim != 1:
                raise ValueError(f"{field.name} has shape {values.shape} but motor_speed has {count}, expected (C,)")
            values.flags.writeable = False
            object.__setattr__(self, field.name, values)

    def __len__(self) -> int:
        return len(self.motor_speed)

    @classmethod
    def from_figures(cls, figures: Sequence[Mapping[str, float]]) -> "ActuatorSet":
        """Gather one mapping of figures per actuator; a figure that a mapping lacks is unknown.

        Parameters
        ----------
        figures : sequence of mapping
            Keys are the attributes above, values are in their units.

        Returns
        -------
        ActuatorSet
            In the order given.
        """
        return cls(
            **{
                field.name: np.array([one.get(field.name, np.nan) for one in figures], dtype=np.float64)
                for field in fields(cls)
            }
        )

    def take(self, indices: Sequence[int] | IntArray) -> "ActuatorSet":
        """Actuators at `indices`, in that order."""
        chosen = np.asarray(indices, dtype=np.int64)
        return ActuatorSet(**{field.name: getattr(self, field.name)[chosen] for field in fields(self)})
