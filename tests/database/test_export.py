"""Exported CSV reads back as the same catalogue, whatever the rows hold."""

import shutil
from math import inf
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.database.cells import LARGEST_FIGURE, SMALLEST_FIGURE
from actuator_select.database.fields import Field
from actuator_select.database.kinds import KINDS
from actuator_select.errors import OutputNotWritable

CONTROLS = "".join(map(chr, {*range(32), 127} - {9, 10, 13}))  # refused in texts: they garble terminals

TEXTS = st.one_of(
    st.text(st.characters(blacklist_categories=["Cs"], blacklist_characters=CONTROLS), min_size=1).filter(str.strip),
    st.sampled_from(
        [
            '"',
            "a,b",
            "a\nb",
            "a\r\nb",
            "a\rb",
            " a ",
            '=HYPERLINK("x")',
            "unlimited",
            "Ω µ – 日本",
            "None",
            "#N/A",
            "236662",
            "_x000D_",
        ]
    ),
)


def values_of(field: Field) -> st.SearchStrategy[object]:
    """Anything that may stand in a field, or nothing."""
    some: st.SearchStrategy[object]
    if field.choices:
        some = st.sampled_from(field.choices)
    elif field.pattern:
        some = st.from_regex(field.pattern, fullmatch=True).filter(lambda text: text.isprintable())
    elif field.is_text:
        some = TEXTS
    elif field.type == "int":
        some = st.integers(1, int(field.maximum or 1))
    else:
        low = field.minimum if field.minimum is not None else field.exclusive_minimum
        high = LARGEST_FIGURE if field.maximum is None else field.maximum
        numbers = st.floats(low, high, exclude_min=field.minimum is None, allow_infinity=False).filter(
            lambda number: number == 0.0 or abs(number) >= SMALLEST_FIGURE
        )
        some = st.one_of(numbers, st.just(inf)) if field.may_be_unlimited else numbers
    return some if field.required else st.none() | some


def rows_of(kind: str) -> st.SearchStrategy[dict[str, object]]:
    """Rows that fill any columns; figures that have to be ordered are left out of some."""
    found = KINDS[kind]
    ordered = {order.lesser for order in found.orders}
    fields = [field for field in found.fields if not field.references and field.name not in ordered]
    return st.fixed_dictionaries({field.name: values_of(field) for field in fields})


@settings(suppress_health_check=list(HealthCheck), max_examples=10, deadline=None)
@pytest.mark.parametrize("form", ["folder", "xlsx", "json"])
@given(rows=st.fixed_dictionaries({kind: rows_of(kind) for kind in KINDS}))
def test_any_export_imports_to_the_identical_catalogue(
    template: Path, tmp_path: Path, form: str, rows: dict[str, dict[str, object]]
) -> None:
    one, other = (shutil.copy(template, tmp_path / name) for name in ("one.db", "other.db"))
    with open_catalogue(one) as first, open_catalogue(other) as second:
        fill(first, rows)
        second.add("ropes", {"id": "not-in-the-export", "source_id": "filipovic-kevac-2018"})
        first.remove("Actuator 1")
        path = tmp_path / f"all.{form}"
        if form == "folder":
            first.export_folder(path)
        else:
            first.export_file(path, form)
        second.import_file(path, replace=True)
        assert second.fingerprint() == first.fingerprint()
        for kind in KINDS:
            assert second.rows(kind) == first.rows(kind)


def fill(catalogue: Catalogue, rows: dict[str, dict[str, object]]) -> None:
    """Add a row of every kind, which refer to each other."""
    source = rows["sources"] | {"page": rows["sources"]["page"] or "1", "date": rows["sources"]["date"] or "2020"}
    catalogue.add("sources", source | {"id": "new"})
    parts = {"motor_id": "new", "gearbox_id": "new", "winch_id": "new"}
    for kind in (one for one in KINDS if one != "sources"):
        refers = {"source_id": "new"} | (parts if kind == "actuators" else {})
        catalogue.add(kind, rows[kind] | {"id": "new"} | refers)


def test_an_export_says_unlimited_unknown_and_zero(catalogue: Catalogue) -> None:
    row = {"id": "m", "max_speed_rpm": inf, "viscous_friction_nm_s_per_rad": 0, "source_id": "filipovic-kevac-2018"}
    catalogue.add("motors", row)
    header, *lines = catalogue.export_csv("motors").splitlines()
    cells = dict(zip(header.split(","), lines[-1].split(","), strict=True))
    assert cells["max_speed_rpm"] == "unlimited"
    assert cells["viscous_friction_nm_s_per_rad"] == "0"
    assert cells["rated_power_w"] == ""
    assert "origin" not in cells


def test_a_folder_that_cannot_be_made_is_explained(catalogue: Catalogue, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(OutputNotWritable, match="cannot make the folder"):
        catalogue.export_folder(tmp_path / "file" / "folder")
