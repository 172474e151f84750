"""Fixtures that several tests share."""

from collections.abc import Iterator

import pytest

from actuator_select import Catalogue, open_catalogue


@pytest.fixture(scope="session")
def catalogue() -> Iterator[Catalogue]:
    """The shipped catalogue, in memory; not to be written to."""
    with open_catalogue(":memory:") as opened:
        yield opened
