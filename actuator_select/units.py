"""Datasheet units to SI, at the boundary and nowhere else. Every function takes numbers and arrays alike."""

from math import pi
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Quantity = TypeVar("Quantity", float, NDArray[np.float64])


def rad_per_s(rpm: Quantity) -> Quantity:
    """Angular speed in rad/s from revolutions per minute."""
    return rpm * (pi / 30.0)


def rpm(rad_per_s: Quantity) -> Quantity:
    """Revolutions per minute from an angular speed in rad/s."""
    return rad_per_s * (30.0 / pi)


def v_s_per_rad(rpm_per_v: Quantity) -> Quantity:
    """Back-EMF constant in V s/rad from a speed constant in rpm/V, its reciprocal."""
    return 1.0 / rad_per_s(rpm_per_v)


def rpm_per_v(v_s_per_rad: Quantity) -> Quantity:
    """Speed constant in rpm/V from a back-EMF constant in V s/rad, its reciprocal."""
    return rpm(1.0 / v_s_per_rad)


def kg_m2(g_cm2: Quantity) -> Quantity:
    """Moment of inertia in kg m² from g cm²."""
    return g_cm2 * 1e-7


def metres(mm: Quantity) -> Quantity:
    """Length in m from mm."""
    return mm / 1000.0


def fraction(percent: Quantity) -> Quantity:
    """Fraction from per cent."""
    return percent / 100.0
