"""Texts in the cells of XLSX files: what XML cannot hold, or would change, is written as an escape.

References
----------
ECMA-376-1:2016, 22.9.2.19, ST_Xstring: ``_xHHHH_`` stands for the character U+HHHH, and ``_x005F_`` for an underscore
that would begin such an escape.
"""

import re

_UNFIT = re.compile("[\x00-\x08\x0b-\x1f\ufffe\uffff]|_(?=x[0-9A-Fa-f]{4}_)")
_ERROR = re.compile("#(?=[A-Z0-9/]+[!?]?$)")  # a text such as #N/A, which reads back as a failed formula
_ESCAPE = re.compile("_x([0-9A-Fa-f]{4})_")


def escape_text(text: str) -> str:
    """Text as an XLSX file holds it; a carriage return would read back as a line feed."""
    fit = _UNFIT.sub(_escape, text)
    return _ERROR.sub(_escape, fit, count=1) if _ERROR.match(fit) else fit


def _escape(found: re.Match[str]) -> str:
    return f"_x{ord(found[0]):04X}_"


def unescape_text(text: str) -> str:
    """Text that a cell of an XLSX file stands for."""
    return _ESCAPE.sub(lambda found: chr(int(found[1], 16)), text)
