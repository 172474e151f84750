"""What a user's texts ask of a kind of row; the parser is imported only where there is one.

Building the parser takes longer than reading a small catalogue.
"""

from typing import Any

import sqlalchemy as sa

from actuator_select.database.fields import Kind
from actuator_select.database.queries import Column, columns_of


def condition_of(kind: Kind, where: str) -> sa.ColumnElement[bool] | None:
    """Condition that rows meet; none of an empty text."""
    if not where:
        return None
    from actuator_select.database.where import compile_condition

    return compile_condition(where, columns_of(kind))


def order_of(kind: Kind, sort: str) -> list[sa.ColumnElement[Any]]:
    """What rows are sorted by, for ORDER BY; nothing of an empty text."""
    if not sort:
        return []
    from actuator_select.database.where import compile_sort

    return compile_sort(sort, columns_of(kind))


def chosen_columns(kind: Kind, names: str) -> list[Column]:
    """Columns of a list of names; none of an empty text."""
    if not names.strip():
        return []
    from actuator_select.database.where import find_columns

    return find_columns(names, columns_of(kind))
