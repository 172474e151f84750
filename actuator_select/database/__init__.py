"""The catalogue: tables, migrations, shipped rows, CSV files and queries. It knows nothing of physics."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from actuator_select.database.catalogue import Catalogue, open_catalogue
    from actuator_select.database.importing import ImportReport

__all__ = ["Catalogue", "ImportReport", "open_catalogue"]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - any public name
    """Import SQLAlchemy only when the catalogue is used."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module = "importing" if name == "ImportReport" else "catalogue"
    return getattr(import_module(f"{__name__}.{module}"), name)
