"""What a row says, as a digest: to tell edited rows from untouched ones and to name a whole catalogue in a report."""

import hashlib
import json
from collections.abc import Iterable, Mapping

from actuator_select.database.cells import Value, write_value
from actuator_select.database.fields import Kind


def row_digest(kind: Kind, row: Mapping[str, Value]) -> str:
    """SHA-256 of a row's known figures.

    Parameters
    ----------
    kind : Kind
        Of the row; columns that the program itself fills are left out.
    row : mapping of str to value
        Values by column.

    Returns
    -------
    str
        64 hexadecimal digits. A column that a later version adds does not change it while it is empty.
    """
    known = {field.name: write_value(value) for field in kind.fields if (value := row.get(field.name)) is not None}
    text = json.dumps([kind.name, known], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def catalogue_digest(rows: Iterable[tuple[Kind, Mapping[str, Value]]]) -> str:
    """SHA-256 of many rows, whatever their order."""
    digests = sorted(row_digest(kind, row) for kind, row in rows)
    return hashlib.sha256("\n".join(digests).encode()).hexdigest()
