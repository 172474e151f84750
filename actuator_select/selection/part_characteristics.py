"""What a part's own figures say about torque over speed: regions, lines and limits to draw, and what is not stated.

Nothing is supplied that the row does not state: where a figure is missing, what needs it is left out and named. The
voltage line of a DC motor is kT/R (U - kE ω), without friction; an AC servo has none, because its figures are rms phase
values and its drive's voltage is not the motor's.
"""

from dataclasses import replace
from math import inf, isfinite, nan

from actuator_select.errors import InvalidInput
from actuator_select.model.actuation import speed_at_voltage, stall_torque
from actuator_select.selection.candidates import from_rows
from actuator_select.selection.electrical import ALTERNATING_CURRENT, Row, back_emf_constant
from actuator_select.selection.part_sketch import Characteristics, Duty, Mark, Point, Sketch, Slope
from actuator_select.units import rad_per_s, rpm

BELOW_LINE = 0.95  # of the line's speed at rated torque; a rated speed below is not rounding, and is noted
RATED_SPEED, BOTH_SPEEDS = "rated speed", "maximum and rated speed"


def characteristics(kind: str, row: Row) -> Characteristics:
    """Find what can be drawn of a row.

    Parameters
    ----------
    kind : str
        ``motors``, ``gearboxes`` or ``actuators``.
    row : mapping
        Of the catalogue; of an actuator with its parts' columns.

    Returns
    -------
    Characteristics
        In datasheet units at a motor or gearbox, in m/s and N at an actuator's drum.

    Raises
    ------
    InvalidInput
        If the kind has no speeds and torques.
    """
    if kind == "motors":
        return _motor(row)
    if kind == "gearboxes":
        return _gearbox(row)
    if kind == "actuators":
        return _actuator(row)
    raise InvalidInput(
        f"--plot: {row['id']} is one of {kind}, which state no torque over speed; motors, gearboxes and actuators can "
        "be drawn"
    )


def _title(row: Row) -> str:
    named = [str(row[name]) for name in ("manufacturer", "part_number") if row.get(name) is not None]
    return f"{row['id']} ({' '.join(named)})" if named else str(row["id"])


def _motor(row: Row) -> Characteristics:
    sketch = Sketch(row)
    torque, speed = sketch.figure("rated_torque_nm", "rated torque"), sketch.figure("rated_speed_rpm", "rated speed")
    peak = sketch.figure("peak_torque_nm", "peak torque")
    fastest = sketch.figure("max_speed_rpm", "maximum speed")
    if row.get("electrical_convention") in ALTERNATING_CURRENT:
        _servo_regions(sketch, torque, speed, peak, fastest)
    else:
        _dc_regions(sketch, torque, speed, peak, fastest)
    sketch.limit(torque, "rated torque", Duty.CONTINUOUS, of_load=True)
    sketch.limit(peak, "peak torque", Duty.SHORT, of_load=True)
    same = fastest == speed
    sketch.limit(fastest, BOTH_SPEEDS if same else "maximum speed", Duty.SHORT, of_load=False)
    if isfinite(torque) and isfinite(speed):
        sketch.marks.append(Mark(name="rated point", speed=speed, load=torque))
    elif not same:
        sketch.limit(speed, RATED_SPEED, Duty.CONTINUOUS, of_load=False)
    at = "output shaft" if row.get("figures_at") == "output_shaft" else "motor shaft"
    return sketch.done(
        title=_title(row), speed_name=f"speed of the {at}", speed_unit="rpm", load_name="torque", load_unit="N m"
    )


def _servo_regions(sketch: Sketch, torque: float, speed: float, peak: float, fastest: float) -> None:
    standstill = sketch.figure("standstill_torque_nm", "standstill torque")
    sketch.limit(standstill, "standstill torque, continuous", Duty.CONTINUOUS, of_load=True)
    sketch.region("for short: up to peak torque and maximum speed", Duty.SHORT, *_box(fastest, peak))
    if isfinite(standstill):
        corners = ((0.0, 0.0), (0.0, standstill), (speed, torque), (speed, 0.0))
        sketch.region("continuous: standstill torque to the rated point", Duty.CONTINUOUS, *corners)
        if isfinite(torque) and isfinite(speed):
            sketch.notes.append("straight between standstill and rated point")
    else:
        sketch.region("continuous: rated torque up to rated speed", Duty.CONTINUOUS, *_box(speed, torque))
    if isfinite(peak) and isfinite(fastest):
        sketch.notes.append("the maker's curve may cut the corner of peak torque and maximum speed")
    sketch.notes.append("AC servo: no voltage line, because the figures are rms phase values behind its drive")


def _dc_regions(sketch: Sketch, torque: float, speed: float, peak: float, fastest: float) -> None:
    line = _voltage_line(sketch)
    if line is not None:
        sketch.slopes.append(line)
        if sketch.row.get("electrical_convention") is None:
            sketch.notes.append("electrical convention not stated: the voltage line takes the figures for DC values")
    # Without a line or a limit of speed, the rated point is all that bounds what is continuous.
    bounded = line is not None or isfinite(fastest)
    end = fastest if isfinite(fastest) else inf if bounded else speed
    for name, duty, load in (("for short", Duty.SHORT, peak), ("continuous", Duty.CONTINUOUS, torque)):
        if not isfinite(load) or (duty is Duty.SHORT and not bounded):
            continue
        height = load if line is None else min(load, line.load)
        upper, lower = (end, end) if line is None else (min(end, line.speed_at(height)), min(end, line.speed))
        if line is not None and duty is Duty.CONTINUOUS and height == torque and speed < upper:
            # The maker's point, with a warm winding and the losses, is nearer than the line of the cold motor.
            if speed < BELOW_LINE * line.speed_at(height):
                sketch.notes.append("rated point below the line of the cold motor")
            upper = speed
        corners = [(0.0, 0.0), (0.0, height), (upper, height)]
        if line is not None and upper < lower == end:
            corners.append((end, height * (line.speed - end) / (line.speed - upper)))
        sketch.region(f"{name}: up to {'peak' if duty is Duty.SHORT else 'rated'} torque", duty, *corners, (lower, 0.0))


def _voltage_line(sketch: Sketch) -> Slope | None:
    """From stall torque to no-load speed, kT/R (U - kE ω) = 0; printed ends where constants are unknown."""
    voltage, resistance = sketch.figure("nominal_voltage_v"), sketch.figure("terminal_resistance_ohm")
    torque_constant, known = sketch.figure("torque_constant_nm_per_a"), back_emf_constant(sketch.row)
    back_emf = nan if known is None else known
    stall, no_load = stall_torque(torque_constant, voltage, resistance), rpm(speed_at_voltage(voltage, back_emf))
    printed_stall, printed_speed = not isfinite(stall), not isfinite(no_load)
    stall = sketch.figure("stall_torque_nm") if printed_stall else stall
    no_load = sketch.figure("no_load_speed_rpm") if printed_speed else no_load
    if isfinite(stall) and isfinite(no_load):
        ends = [name for name, used in (("stall torque", printed_stall), ("no-load speed", printed_speed)) if used]
        how = f"{' and '.join(ends)} as printed" if ends else "kT/R (U − kE ω), without friction"
        name = f"voltage line at {voltage:g} V: {how}" if isfinite(voltage) else f"{how}, voltage not stated"
        return Slope(name=name, load=stall, speed=no_load, printed=bool(ends))
    needs = {
        "nominal voltage": voltage,
        "resistance": resistance if printed_stall else 0.0,
        "torque constant": torque_constant if printed_stall else 0.0,
        "back-EMF constant": back_emf if printed_speed else 0.0,
        "stall torque": stall,
        "no-load speed": no_load,
    }
    unknown = [name for name, value in needs.items() if not isfinite(value)]
    sketch.missing.append(f"for a voltage line: {', '.join(unknown)}")
    return None


def _box(speed: float, load: float) -> tuple[Point, ...]:
    return ((0.0, 0.0), (0.0, load), (speed, load), (speed, 0.0))


def _gearbox(row: Row) -> Characteristics:
    sketch = Sketch(row)
    continuous = sketch.figure("max_continuous_torque_nm", "continuous torque")
    short = sketch.figure("max_intermittent_torque_nm", "intermittent torque")
    emergency = sketch.figure("emergency_stop_torque_nm", "emergency stop torque")
    nominal = sketch.figure("nominal_input_speed_rpm", "nominal input speed")
    speed = sketch.figure("max_continuous_input_speed_rpm", "continuous input speed")
    short_speed = sketch.figure("max_intermittent_input_speed_rpm", "intermittent input speed")
    sketch.region("for short", Duty.SHORT, *_box(short_speed, short))
    if isfinite(speed):
        sketch.region("continuous", Duty.CONTINUOUS, *_box(speed, continuous))
    else:
        sketch.region("continuous, up to the nominal input speed", Duty.CONTINUOUS, *_box(nominal, continuous))
    for value, name, duty in (
        (continuous, "continuous torque", Duty.CONTINUOUS),
        (short, "intermittent torque", Duty.SHORT),
        (emergency, "emergency stop torque", Duty.EMERGENCY),
    ):
        sketch.limit(value, name, duty, of_load=True)
    for value, name, duty in (
        (nominal, "nominal input speed", Duty.PART),
        (speed, "continuous input speed", Duty.CONTINUOUS),
        (short_speed, "intermittent input speed", Duty.SHORT),
    ):
        sketch.limit(value, name, duty, of_load=False)
    ratio = sketch.figure("ratio", "ratio")
    if isfinite(ratio):
        sketch.notes.append(f"ratio {ratio:g}: the output turns {ratio:g} times slower than the input")
    return sketch.done(
        title=_title(row), speed_name="input speed", speed_unit="rpm", load_name="output torque", load_unit="N m"
    )


def _actuator(row: Row) -> Characteristics:
    """The motor's characteristics seen at the drum, and the limits of gearbox and winch there."""
    drive = from_rows([row]).actuators
    ratio, efficiency, radius = (float(one[0]) for one in (drive.ratio, drive.efficiency, drive.drum_radius))
    motor = _motor(_part(row, "motor"))
    speed_scale, load_scale = rad_per_s(1.0) * radius / ratio, ratio * efficiency / radius
    transmission = {"ratio": ratio, "efficiency": efficiency, "drum radius": radius}
    without = {"efficiency": " (no cable force of the motor is drawn)"}
    sketch = Sketch(row)
    sketch.missing += [f"{name}{without.get(name, '')}" for name, value in transmission.items() if not isfinite(value)]
    sketch.missing += [f"motor: {', '.join(motor.missing)}"] if motor.missing else []
    sketch.notes += [f"motor: {note}" for note in motor.notes]
    _scale(sketch, motor, speed_scale, load_scale)
    told = {"ratio": f"{ratio:g}", "efficiency": f"{efficiency:.3g}", "drum radius": f"{radius * 1000.0:g} mm"}
    known = [f"{name} {told[name]}" for name, value in transmission.items() if isfinite(value)]
    sketch.notes += [", ".join(known)] if known else []
    if row.get("gearbox_id") is not None:
        gearbox = _gearbox(_part(row, "gearbox"))
        sketch.missing += [f"gearbox: {', '.join(gearbox.missing)}"] if gearbox.missing else []
        for limit in gearbox.limits:
            scale = 1.0 / radius if limit.of_load else speed_scale
            sketch.limit(limit.value * scale, f"gearbox: {limit.name}", Duty.PART, of_load=limit.of_load)
    winch = Sketch(_part(row, "winch"))
    sketch.limit(winch.figure("max_tension_n", "tension"), "winch: greatest tension", Duty.PART, of_load=True)
    sketch.limit(
        winch.figure("max_cable_speed_m_per_s", "cable speed"), "winch: greatest speed", Duty.PART, of_load=False
    )
    sketch.missing += [f"winch: {', '.join(winch.missing)}"] if winch.missing else []
    return sketch.done(
        title=f"{row['id']} ({row['name']})",
        speed_name="cable speed at the drum",
        speed_unit="m/s",
        load_name="cable force",
        load_unit="N",
    )


def _part(row: Row, role: str) -> Row:
    prefix = f"{role}."
    return {name.removeprefix(prefix): value for name, value in row.items() if name.startswith(prefix)}


def _scale(sketch: Sketch, motor: Characteristics, speed_scale: float, load_scale: float) -> None:
    """Take over what the motor states and ratio, efficiency and radius carry to the drum."""
    for region in motor.regions:
        corners = [(speed * speed_scale, load * load_scale) for speed, load in region.corners]
        sketch.region(region.name, region.duty, *corners)
    for slope in motor.slopes:
        if isfinite(speed_scale) and isfinite(load_scale):
            sketch.slopes.append(replace(slope, load=slope.load * load_scale, speed=slope.speed * speed_scale))
    for limit in motor.limits:
        scale = load_scale if limit.of_load else speed_scale
        sketch.limit(limit.value * scale, f"motor: {limit.name}", limit.duty, of_load=limit.of_load)
    for mark in motor.marks:
        if isfinite(speed_scale) and isfinite(load_scale):
            sketch.marks.append(replace(mark, speed=mark.speed * speed_scale, load=mark.load * load_scale))
        elif not any(limit.name == BOTH_SPEEDS for limit in motor.limits):
            sketch.limit(mark.speed * speed_scale, f"motor: {RATED_SPEED}", Duty.CONTINUOUS, of_load=False)
