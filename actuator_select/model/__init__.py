"""Mechanics and electromechanics: arrays in, arrays out, SI units and radians throughout."""
