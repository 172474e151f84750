"""Rank motors, gearboxes and winches for cable-driven robots by the share of the workspace that they can serve."""

from actuator_select._version import __version__

__all__ = ["__version__"]
