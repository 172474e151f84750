"""The catalogue: tables, migrations, shipped rows, queries, history, and files in CSV, XLSX and JSON.

It knows nothing of physics.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from actuator_select.database.catalogue import Catalogue, open_catalogue
    from actuator_select.database.comparing import compare
    from actuator_select.database.importing import ImportReport
    from actuator_select.database.snapshot import open_for_reading

__all__ = ["Catalogue", "ImportReport", "compare", "open_catalogue", "open_for_reading"]

_MODULES = {"ImportReport": "importing", "compare": "comparing", "open_for_reading": "snapshot"}


def __getattr__(name: str) -> Any:  # noqa: ANN401 - any public name
    """Import SQLAlchemy only when the catalogue is used."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES.get(name, 'catalogue')}"), name)
