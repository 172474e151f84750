"""A robot in a picture: frame, cables, platform, workspace; 3-D, or flat where the robot is."""

from itertools import combinations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon, Rectangle
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D
from scipy.spatial import ConvexHull, QhullError

from actuator_select.model.arrays import FloatArray, IntArray
from actuator_select.model.kinematics import rotation_matrix
from actuator_select.model.robot import Freedom
from actuator_select.report.style import BLUE, GREEN, ORANGE, RED, house_style, new_figure
from actuator_select.study import Study

DARK = "#555555"  # the frame
WIDTH = 6.4  # inches
FLAT_HEIGHTS = (2.6, 6.4)  # least and greatest height of a flat picture, inches
MARGIN = 0.07  # of the largest extent, around a flat robot
LABEL_DISTANCE = 0.035  # of the largest extent, from an anchor to its cables' numbers
NEIGHBOURS = 0.15  # of the largest extent; cables from anchors nearer than this are numbered at different places
FIRST_LABEL, NEXT_LABEL = 0.2, 0.16  # of a cable's length from the frame to its number, and to the next neighbour's
SAME_POINT = 1e-3  # of the largest extent; anchors nearer than this share a label
END_OF_AXIS = 0.04  # of its length
ELEVATION, AZIMUTH = 20.0, -62.0  # degrees


@house_style
def robot_figure(study: Study) -> Figure:
    """Draw a robot at its home position, or at the middle of its region.

    Parameters
    ----------
    study : Study
        Robot, region, first orientation.

    Returns
    -------
    Figure
        In 3-D for spatial robots, in their plane for planar ones; lengths in m, to scale.
    """
    home = study.table.workspace.home_m
    position = np.array(home, dtype=np.float64) if home is not None else study.region.mean(axis=1)
    planar = study.robot.freedom in (Freedom.POINT_IN_PLANE, Freedom.PLANAR)
    return _flat(study, position) if planar else _spatial(study, position)


def _platform(study: Study, position: FloatArray, anchors: FloatArray) -> FloatArray:
    placed: FloatArray = position + anchors @ rotation_matrix(study.orientations[0]).T
    return placed


def _extent(study: Study, ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower and upper corner of all that is drawn."""
    ropes = [one.frame_anchors for one in study.robot.counterbalances]
    every = np.vstack([study.robot.frame_anchors, ends, study.region.T, *ropes])
    return every.min(axis=0), every.max(axis=0)


def _numbers(points: FloatArray, scale: float) -> list[tuple[FloatArray, str]]:
    """Frame anchors with the numbers of the cables that end there."""
    labels: list[tuple[FloatArray, list[str]]] = []
    for number, point in enumerate(points, start=1):
        near = [names for at, names in labels if np.linalg.norm(at - point) < SAME_POINT * scale]
        if near:
            near[0].append(str(number))
        else:
            labels.append((point, [str(number)]))
    return [(point, ", ".join(names)) for point, names in labels]


def _legend(figure: Figure, study: Study) -> None:
    handles = [
        Line2D([], [], color=BLUE, linewidth=1.2, label="cable"),
        Line2D([], [], color="black", marker="^", linestyle="none", markersize=5, label="frame anchor"),
        Line2D([], [], color=DARK, linewidth=0.9, label="frame"),
        Line2D([], [], color=ORANGE, linewidth=4.0, alpha=0.7, label="platform"),
        Line2D([], [], color=GREEN, linewidth=1.0, label="workspace"),
    ]
    if study.robot.counterbalances:
        handles.append(Line2D([], [], color=RED, linestyle="--", linewidth=1.3, label="counterbalance"))
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1.3)


def _title(study: Study, position: FloatArray) -> str:
    where = ", ".join(f"{axis} = {one:.3g}" for axis, one in zip("xyz", position, strict=True))
    return f"{study.name}: {study.robot.cables} cables, platform at {where} m"


def _spatial(study: Study, position: FloatArray) -> Figure:
    robot = study.robot
    ends = _platform(study, position, robot.platform_anchors)
    low, high = _extent(study, ends)
    scale = float((high - low).max())
    figure = new_figure(WIDTH, 5.1)
    axes = figure.add_subplot(projection="3d")
    if not isinstance(axes, Axes3D):  # pragma: no cover - matplotlib returns what was asked for
        raise TypeError(type(axes))
    _box(axes, np.column_stack([robot.frame_anchors.min(axis=0), robot.frame_anchors.max(axis=0)]), DARK, 0.9)
    _box(axes, study.region, GREEN, 1.0)
    for start, stop in zip(robot.frame_anchors, ends, strict=True):
        axes.plot(*np.vstack([start, stop]).T, color=BLUE, linewidth=1.2)
    for rope in robot.counterbalances:
        for start, stop in zip(rope.frame_anchors, _platform(study, position, rope.platform_anchors), strict=True):
            axes.plot(*np.vstack([start, stop]).T, color=RED, linestyle="--", linewidth=1.3)
    _body(axes, ends, scale)
    axes.scatter(*robot.frame_anchors.T, marker="^", s=22, color="black", depthshade=False)
    _number_cables(axes, robot.frame_anchors, ends, scale)
    _dress(axes, low, high, scale)
    for artist in (*axes.lines, *axes.collections):  # a wide robot reaches beyond the square that matplotlib gives it
        artist.set_clip_on(False)
        artist.set_in_layout(False)
    axes.set_title(_title(study, position))
    _legend(figure, study)
    return figure


def _number_cables(axes: Axes3D, frame: FloatArray, ends: FloatArray, scale: float) -> None:
    """Write every cable's number on it; those of neighbouring cables stand at different places along them."""
    for cable, (start, stop) in enumerate(zip(frame, ends, strict=True)):
        earlier = int((np.linalg.norm(frame[:cable] - start, axis=1) < NEIGHBOURS * scale).sum())
        place = start + (FIRST_LABEL + NEXT_LABEL * earlier) * (stop - start)
        axes.text(
            *place,
            str(cable + 1),
            fontsize=8.0,
            color=BLUE,
            ha="center",
            va="center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
            zorder=20,
        )


def _dress(axes: Axes3D, low: FloatArray, high: FloatArray, scale: float) -> None:
    """Equal scales, few ticks, and no axis so thin that its labels touch."""
    thin = np.maximum(high - low, 0.12 * scale)
    middle = (low + high) / 2.0
    low, high = middle - thin / 2.0, middle + thin / 2.0
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=0.96)
    axes.view_init(elev=ELEVATION, azim=AZIMUTH)
    for axis, start, stop in zip((axes.xaxis, axes.yaxis, axes.zaxis), low, high, strict=True):
        length = float(stop - start)
        ticks = MaxNLocator(nbins=max(5, round(7 * length / scale)), steps=[1, 2, 5, 10]).tick_values(
            float(start), float(stop)
        )
        # Labels at the very ends would touch those of the next axis.
        axis.set_ticks(ticks[(ticks > start + END_OF_AXIS * length) & (ticks < stop - END_OF_AXIS * length)])
        axis.pane.set_facecolor("white")
    axes.grid(visible=False)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_zlabel("z [m]", labelpad=0)
    axes.tick_params(labelsize=7.0, pad=0)


def _box(axes: Axes3D, region: FloatArray, colour: str, width: float) -> None:
    corners = np.array(np.meshgrid(*region, indexing="ij")).reshape(3, -1).T
    for first, second in combinations(range(8), 2):
        if (first ^ second).bit_count() == 1:
            axes.plot(*corners[[first, second]].T, color=colour, linewidth=width)


def _body(axes: Axes3D, ends: FloatArray, scale: float) -> None:
    """Outline of the platform: the hull of its anchors, flat or a point where they are."""
    corners = np.unique(np.round(ends / scale, 9), axis=0) * scale
    try:
        faces = [corners[one] for one in ConvexHull(corners).simplices]
    except (QhullError, ValueError):
        faces = [corners[_around(corners)]] if len(corners) > 2 else []  # noqa: PLR2004 - a polygon has three corners
    axes.add_collection3d(Poly3DCollection(faces, facecolor=ORANGE, edgecolor="none", alpha=0.45))
    axes.scatter(*corners.T, s=26 if len(corners) == 1 else 7, color=ORANGE, depthshade=False)


def _around(corners: FloatArray) -> IntArray:
    """Order of the corners of a flat outline around its middle."""
    flat = corners - corners.mean(axis=0)
    plane = np.linalg.svd(flat)[2][:2]
    across = flat @ plane.T
    order: IntArray = np.argsort(np.arctan2(across[:, 1], across[:, 0]))
    return order


def _flat(study: Study, position: FloatArray) -> Figure:
    robot = study.robot
    plane = list(robot.free_axes)
    ends = _platform(study, position, robot.platform_anchors)[:, plane]
    frame = robot.frame_anchors[:, plane]
    low, high = (corner[plane] for corner in _extent(study, _platform(study, position, robot.platform_anchors)))
    scale = float((high - low).max())
    pad = MARGIN * scale
    ratio = float((high[1] - low[1] + 2 * pad) / (high[0] - low[0] + 2 * pad))
    figure = new_figure(WIDTH, float(np.clip(WIDTH * ratio + 1.0, *FLAT_HEIGHTS)))
    axes = figure.add_subplot()
    for (x, z), (width, height), colour, line in (
        (frame.min(axis=0), np.ptp(frame, axis=0), DARK, 0.9),
        (study.region[plane, 0], np.ptp(study.region[plane], axis=1), GREEN, 1.0),
    ):
        axes.add_patch(Rectangle((x, z), width, height, fill=False, edgecolor=colour, linewidth=line))
    for start, stop in zip(frame, ends, strict=True):
        axes.plot(*np.vstack([start, stop]).T, color=BLUE, linewidth=1.2)
    for rope in robot.counterbalances:
        ropes = _platform(study, position, rope.platform_anchors)
        for start, stop in zip(rope.frame_anchors[:, plane], ropes[:, plane], strict=True):
            axes.plot(*np.vstack([start, stop]).T, color=RED, linestyle="--", linewidth=1.3)
        axes.plot(*rope.frame_anchors[:, plane].T, color=RED, marker="o", markersize=3.5, linestyle="none")
    _flat_body(axes, ends, scale)
    axes.plot(*frame.T, color="black", marker="^", markersize=5, linestyle="none")
    middle = (low + high) / 2.0
    for point, names in _numbers(frame, scale):
        outwards = np.sign(point - middle) * LABEL_DISTANCE * scale
        x, y = point + outwards
        axes.text(float(x), float(y), names, fontsize=8.0, ha="center", va="center")
    axes.set_xlim(low[0] - pad, high[0] + pad)
    axes.set_ylim(low[1] - pad, high[1] + pad)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{'xyz'[plane[0]]} [m]")
    axes.set_ylabel(f"{'xyz'[plane[1]]} [m]")
    axes.set_title(_title(study, position))
    _legend(figure, study)
    return figure


def _flat_body(axes: Axes, ends: FloatArray, scale: float) -> None:
    corners = np.unique(np.round(ends / scale, 9), axis=0) * scale
    if len(corners) > 2:  # noqa: PLR2004 - a polygon has three corners
        axes.add_patch(Polygon(corners[_around(corners)], facecolor=ORANGE, edgecolor="none", alpha=0.45))
    axes.plot(*corners.T, color=ORANGE, marker="o", markersize=6 if len(corners) == 1 else 3, linestyle="none")
