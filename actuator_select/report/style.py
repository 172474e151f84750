"""How figures look and how they become bytes: one palette that colour-blind readers can tell apart, units in labels."""

import base64
import io
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from actuator_select.model.actuation import Check

IMAGE_FORMATS = ("svg", "png", "pdf")
RASTER_DPI = 130

# Okabe & Ito, "Color universal design", 2008.
BLUE, ORANGE, GREEN, RED, SKY, PURPLE, GREY = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#56B4E9",
    "#CC79A7",
    "#8A8A8A",
)
CABLE_COLOURS = (BLUE, ORANGE, GREEN, PURPLE)  # with four dashes, see `drive_figures`
CHECK_COLOURS = {Check.SPEED: SKY, Check.TORQUE: ORANGE, Check.ACCELERATION: PURPLE, Check.VOLTAGE: RED}

STYLE: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
    "font.size": 9.0,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "svg.fonttype": "none",  # text stays text: smaller, searchable, in a font that the reader has
    "text.parse_math": False,  # a $ in a part's name is a $
    "svg.hashsalt": "actuator-select",
}


house_style = rc_context(STYLE)  # decorates every function that draws


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of the given size in inches."""
    return Figure(figsize=(width, height), layout="constrained")


def image_bytes(figure: Figure, image_format: str) -> bytes:
    """Draw a figure.

    Parameters
    ----------
    figure : Figure
        Any figure.
    image_format : str
        One of `IMAGE_FORMATS`.

    Returns
    -------
    bytes
        The same at every run: no date, no random ids.
    """
    buffer = io.BytesIO()
    metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": None}[image_format]
    with rc_context(STYLE):
        figure.savefig(buffer, format=image_format, dpi=RASTER_DPI, metadata=metadata)
    return buffer.getvalue()


def data_uri(figure: Figure, image_format: str) -> str:
    """Draw a figure into a URI that stands in an HTML file by itself."""
    kind = {"svg": "image/svg+xml", "png": "image/png"}[image_format]
    return f"data:{kind};base64,{base64.b64encode(image_bytes(figure, image_format)).decode('ascii')}"
