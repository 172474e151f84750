"""The attribute tables: names, units and what is derived from them."""

import pytest

from actuator_select.database.fields import ORIGIN, UNIT_SUFFIXES, Field
from actuator_select.database.kinds import ACTUATORS, KINDS, find_kind
from actuator_select.database.queries import columns_of
from actuator_select.database.schema import metadata
from actuator_select.errors import UnknownName

EVERY_FIELD = [pytest.param(field, id=f"{kind.name}.{field.name}") for kind in KINDS.values() for field in kind.columns]


@pytest.mark.parametrize("field", EVERY_FIELD)
def test_a_column_with_a_unit_ends_in_it(field: Field) -> None:
    if field.unit:
        assert field.name.endswith(UNIT_SUFFIXES[field.unit])
        assert field.label.endswith(f"[{field.unit}]")
    else:
        assert field.type != "float" or not field.name.endswith(tuple(UNIT_SUFFIXES.values()))


@pytest.mark.parametrize("field", EVERY_FIELD)
def test_every_column_says_what_it_means_and_what_it_takes(field: Field) -> None:
    assert field.description
    assert field.expected
    assert field.is_text or field.range_text
    assert not field.pattern or field.form


@pytest.mark.parametrize("kind", KINDS)
def test_no_spelling_names_two_columns(kind: str) -> None:
    fields = find_kind(kind).fields
    spellings = [name for field in fields for name in (field.name, *field.aliases)]
    assert len(spellings) == len(set(spellings))


@pytest.mark.parametrize("kind", KINDS)
def test_columns_for_people_exist(kind: str) -> None:
    found = find_kind(kind)
    assert set(found.shown) <= {column.name for column in columns_of(found)}
    assert found.columns[-1] is ORIGIN


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "sources"])
def test_every_part_names_its_source(kind: str) -> None:
    field = find_kind(kind).field("source_id")
    assert field.required
    assert field.references == "sources"


def test_references_point_to_kinds_that_come_before() -> None:
    order = list(KINDS)
    for kind in KINDS.values():
        assert all(order.index(field.references) < order.index(kind.name) for field in kind.references)


def test_names_are_short_enough_for_every_database() -> None:
    names = [str(thing.name) for table in metadata.tables.values() for thing in (*table.columns, *table.constraints)]
    assert max(map(len, names)) <= 63


def test_a_kind_is_found_by_its_plural_and_its_singular() -> None:
    assert find_kind("actuator") is find_kind("actuators") is ACTUATORS
    with pytest.raises(UnknownName, match="did you mean 'gearboxes'"):
        find_kind("gearboxs")
