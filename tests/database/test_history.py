"""The history: complete, readable after a removal, and true to the rows."""

import re
import shutil
import tempfile
from pathlib import Path

import pytest
import sqlalchemy as sa
from hypothesis import event, given, settings
from hypothesis import strategies as st

from actuator_select._version import __version__
from actuator_select.database import Catalogue, migration, open_catalogue
from actuator_select.database.cells import read_value
from actuator_select.database.connection import database_url, make_engine, writing
from actuator_select.database.history import Change
from actuator_select.database.kinds import KINDS
from actuator_select.database.queries import Row
from actuator_select.database.schema import CHANGES
from actuator_select.errors import ActuatorSelectError, UnknownName

SOURCE = "filipovic-kevac-2018"
MOTOR = "filipovic-kevac-2018-motor-1"

Content = dict[tuple[str, str], Row]


def told(change: Change) -> tuple[str, str | None, str | None, str | None]:
    return change.action, change.field, change.old, change.new


def test_every_write_is_told_with_its_time_and_cause(catalogue: Catalogue) -> None:
    catalogue.add("motors", {"id": "m", "rated_power_w": 150, "source_id": SOURCE})
    catalogue.edit("m", {"rated_power_w": 120.5, "max_speed_rpm": "unlimited"})
    catalogue.remove("m")
    changes = catalogue.history("m")
    assert [told(change) for change in changes] == [
        ("added", None, None, None),
        ("changed", "rated_power_w", "150", "120.5"),
        ("changed", "max_speed_rpm", None, "unlimited"),
        ("removed", "id", "m", None),
        ("removed", "rated_power_w", "120.5", None),
        ("removed", "max_speed_rpm", "unlimited", None),
        ("removed", "source_id", SOURCE, None),
    ]
    assert list(dict.fromkeys(change.changed_by for change in changes)) == [
        "catalog add",
        "catalog edit",
        "catalog remove",
    ]
    assert all(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", change.changed_at) for change in changes)


def test_an_untouched_shipped_row_says_when_it_came(catalogue: Catalogue) -> None:
    (change,) = catalogue.history("Actuator 1")
    assert (change.action, change.row_id) == ("added", "filipovic-kevac-2018-1")
    assert change.changed_by == f"rows shipped with actuator-select {__version__}"


def test_an_id_of_several_kinds_has_the_history_of_each(catalogue: Catalogue) -> None:
    catalogue.add("motors", {"id": "m", "source_id": SOURCE})
    catalogue.add("gearboxes", {"id": "m", "source_id": SOURCE})
    assert [change.kind for change in catalogue.history("m")] == ["motors", "gearboxes"]
    assert [change.kind for change in catalogue.history("m", "gearbox")] == ["gearboxes"]


def test_an_id_that_never_was_is_suggested_also_from_removed_rows(catalogue: Catalogue) -> None:
    catalogue.add("motors", {"id": "old-motor", "source_id": SOURCE})
    catalogue.remove("old-motor")
    with pytest.raises(UnknownName, match="there is no 'old-moter' in the catalogue; did you mean 'old-motor'"):
        catalogue.history("old-moter")
    with pytest.raises(UnknownName, match=r"there is no 'old-motor' in winches; known are filipovic-kevac-2018-winch$"):
        catalogue.history("old-motor", "winches")


def test_a_removed_or_renamed_actuator_is_found_by_the_name_that_it_had(catalogue: Catalogue) -> None:
    catalogue.copy("Actuator 1", "mine", {"name": "First"})
    catalogue.edit("mine", {"name": "Second"})
    catalogue.remove("mine")
    for name in ("First", "Second"):
        changes = catalogue.history(name)
        assert changes == catalogue.history(name, "actuator") == catalogue.history("mine")
    with pytest.raises(UnknownName, match="did you mean 'Second'"):
        catalogue.history("Secund")
    with pytest.raises(UnknownName, match="in motors"):
        catalogue.history("Second", "motors")


def test_a_name_belongs_to_who_has_it_now_then_to_all_who_had_it(catalogue: Catalogue) -> None:
    for row_id in ("a", "b"):
        catalogue.copy("Actuator 1", row_id, {"name": "Mine"})
        if row_id == "a":
            catalogue.remove("a")
    assert {change.row_id for change in catalogue.history("Mine")} == {"b"}
    catalogue.remove("b")
    assert [(change.row_id, change.action) for change in catalogue.history("Mine") if change.field in {None, "id"}] == [
        ("a", "added"),
        ("a", "removed"),
        ("b", "added"),
        ("b", "removed"),
    ]


def test_a_row_from_before_the_history_began_has_none_until_it_changes(template: Path, tmp_path: Path) -> None:
    path = shutil.copy(template, tmp_path / "older.db")
    engine = make_engine(database_url(path))
    with writing(engine) as connection:
        migration.downgrade(connection, "0001")
    engine.dispose()
    with open_catalogue(path) as catalogue:
        assert catalogue.history(MOTOR) == []
        catalogue.edit(MOTOR, {"mass_kg": 3})
        assert [told(change) for change in catalogue.history(MOTOR)] == [("changed", "mass_kg", None, "3")]


def content(catalogue: Catalogue) -> Content:
    """What users see of every row: the columns that they fill."""
    return {
        (kind.name, str(row["id"])): {field.name: row[field.name] for field in kind.fields}
        for kind in KINDS.values()
        for row in catalogue.rows(kind.name)
    }


def recorded(catalogue: Catalogue) -> list[Change]:
    """The whole history, oldest first."""
    columns = [column for column in CHANGES.columns if column.name != "number"]
    with catalogue.transaction() as connection:
        rows = connection.execute(sa.select(*columns).order_by(CHANGES.c.number)).mappings()
        return [Change(**dict(row)) for row in rows]


def undo(rows: Content, change: Change) -> None:
    """Take a change back; it has to fit what it is taken back from."""
    key = (change.kind, change.row_id)
    if change.action == "added":
        del rows[key]
        return
    assert change.field is not None
    field = KINDS[change.kind].field(change.field)
    old, new = (read_value(field, text) for text in (change.old, change.new))
    if change.action == "removed":
        rows.setdefault(key, dict.fromkeys(one.name for one in KINDS[change.kind].fields))
    assert rows[key][field.name] == new
    rows[key][field.name] = old


NEW_IDS = st.sampled_from(["a", "b", "c", "d", "e", "two words"])
IDS = st.sampled_from(["a", "b", MOTOR, "filipovic-kevac-2018-motor-2", "Actuator 1", "nowhere"])
MOTOR_VALUES = st.fixed_dictionaries(
    {},
    optional={
        "notes": st.sampled_from([None, "", "a", " spaced ", "Ω\nnew line"]),
        "rated_power_w": st.floats(min_value=0.1, max_value=1e6),
        "max_speed_rpm": st.sampled_from(["unlimited", 3000, None]),
        "pole_pairs": st.integers(1, 20),
    },
)
ACTUATOR_VALUES = st.fixed_dictionaries(
    {"motor_id": st.sampled_from(["a", MOTOR])}, optional={"name": st.sampled_from(["a", "Actuator 2"])}
)
VALUES = (
    st.just({})
    | MOTOR_VALUES
    | MOTOR_VALUES
    | ACTUATOR_VALUES
    | st.sampled_from([{"rated_power_w": -1}, {"source_id": ""}])
)
STEPS = st.lists(
    st.tuples(st.sampled_from(["add", "edit", "copy", "remove"]), IDS, VALUES, NEW_IDS), min_size=8, max_size=16
)
NEW_SOURCE: dict[str, object] = {"document": "D", "url": "https://a.example", "date": "2024"}


def take(catalogue: Catalogue, step: tuple[str, str, dict[str, object], str]) -> None:
    name, row_id, values, new_id = step
    if name == "add":
        catalogue.add("motors", {"id": new_id, **values}, NEW_SOURCE)
    elif name == "edit":
        catalogue.edit(row_id, values)
    elif name == "copy":
        catalogue.copy(row_id, new_id, values)
    else:
        catalogue.remove(row_id)


@settings(deadline=None, max_examples=25)
@given(steps=STEPS)
def test_undoing_the_history_gives_every_earlier_state_and_refusals_leave_no_trace(
    template: Path, steps: list[tuple[str, str, dict[str, object], str]]
) -> None:
    with tempfile.TemporaryDirectory() as folder, open_catalogue(shutil.copy(template, folder)) as catalogue:
        states = [(len(recorded(catalogue)), content(catalogue))]
        for step in steps:
            before = (catalogue.fingerprint(), recorded(catalogue))
            try:
                take(catalogue, step)
                event(f"{step[0]} taken")
            except ActuatorSelectError:
                assert (catalogue.fingerprint(), recorded(catalogue)) == before
            states.append((len(recorded(catalogue)), content(catalogue)))
        changes, rows = recorded(catalogue), content(catalogue)
        for count, state in reversed(states):
            while len(changes) > count:
                undo(rows, changes.pop())
            assert rows == state
        while changes:
            undo(rows, changes.pop())
        assert rows == {}
