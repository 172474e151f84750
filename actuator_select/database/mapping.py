"""Mappings: small TOML files that say which foreign column fills which of ours, in which unit.

The files are described in the README, section "Importing somebody else's list". Where `Mapping.columns` is empty, the
foreign file has the catalogue's own columns, and only its writing is foreign.
"""

import codecs
import re
import tomllib
from collections.abc import Iterator, Sequence
from datetime import date
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from actuator_select.database.cells import Refused, quoted, read_value
from actuator_select.database.csv_table import CsvFormat
from actuator_select.database.fields import Field as Column
from actuator_select.database.fields import Kind
from actuator_select.database.kinds import KINDS, find_kind
from actuator_select.database.suggestions import suggestion
from actuator_select.database.unit_conversion import UnitRefused, conversion
from actuator_select.errors import InvalidRows, Problem, UnknownName, did_you_mean

_FOLDER = Path(__file__).resolve().parents[1] / "mappings"
PLACEHOLDER = re.compile(r"\{(\w+)\}")
"""One of our columns in the template of an id."""


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class Filling(_Strict):
    """How a foreign column fills one of ours.

    Attributes
    ----------
    field : str
        Our column; empty where the foreign one is ignored.
    unit : str or None
        Unit of the foreign figures; None for texts and pure numbers.
    reciprocal : bool
        Whether one over the foreign figure is meant.
    values : dict of str to str
        Our words for foreign ones.
    missing, unlimited : list of str
        Words that say that a figure is unknown, or has no limit.
    zero_is_unknown : bool
        Whether zero stands for an unknown figure.
    prefix : str
        What is put before a text.
    make_id : bool
        Whether characters that an id cannot hold are replaced by hyphens.
    ignore : bool
        Whether the foreign column is passed over.
    """

    field: str = ""
    unit: str | None = None
    reciprocal: bool = False
    values: dict[str, str] = {}
    missing: list[str] = []
    unlimited: list[str] = []
    zero_is_unknown: bool = False
    prefix: str = ""
    make_id: bool = False
    ignore: bool = False


class Writing(_Strict):
    """How a foreign CSV file is written; defaults are those of `CsvFormat`."""

    delimiter: str | None = Field(default=None, min_length=1, max_length=1)
    decimal: Literal[".", ","] = "."
    encoding: str = "utf-8-sig"
    header: bool = True


_EXPECTED = {
    "dict_type": "a table",
    "model_type": "a table",
    "list_type": 'a list such as ["n/a"]',
    "string_type": "a text",
    "bool_type": "true or false",
    "string_too_short": "one character",
    "string_too_long": "one character",
}
"""What pydantic's errors say, in the words of TOML."""


def _as_list(value: object) -> object:
    """Fillings of one column; a text alone names the field."""
    fillings = value if isinstance(value, list) else [value]
    return [{"field": one} if isinstance(one, str) else one for one in fillings]


def _as_cell(value: object) -> object:
    """A constant as a cell: TOML's dates are texts here."""
    if isinstance(value, date):
        return value.isoformat()
    if isinstance(value, str | int | float):
        return value
    raise ValueError("a text or a number is expected")


class Mapping(_Strict):
    """A mapping as its file states it.

    Attributes
    ----------
    name : str
        Of the file, for messages.
    kind : str
        Kind of the rows.
    description : str
        For people.
    layout : {"table", "one-to-many"}
        One row per line, or a line of a key and others, each of which makes a row with the columns 1 and 2 (CSV only).
    id_from : str
        Template of the id, with our columns in braces, where no foreign column holds one.
    ignore_others : bool
        Whether foreign columns that are not named are passed over; then those that are named have to be there.
    missing : list of str
        Words for an unknown figure, in every column.
    csv : Writing
        How the file is written.
    columns : dict of str to list of Filling
        By foreign column.
    constants : dict
        Our columns that hold the same in every row.
    """

    name: str
    kind: str
    description: str = ""
    layout: Literal["table", "one-to-many"] = "table"
    id_from: str = ""
    ignore_others: bool = False
    missing: list[str] = []
    csv: Writing = Writing()
    columns: dict[str, Annotated[list[Filling], BeforeValidator(_as_list)]] = {}
    constants: dict[str, Annotated[Any, BeforeValidator(_as_cell)]] = {}

    @property
    def csv_format(self) -> CsvFormat:
        """How CSV files are read."""
        # A byte order mark is no part of the first column's name.
        encoding = "utf-8-sig" if codecs.lookup(self.csv.encoding).name == "utf-8" else self.csv.encoding
        return CsvFormat(delimiter=self.csv.delimiter, encoding=encoding, header=self.csv.header)

    @property
    def is_for_any_format(self) -> bool:
        """Whether it says nothing that only CSV files can be."""
        return self.csv.header and self.layout == "table"

    @property
    def copy_hint(self) -> str:
        """How to get a copy to change, where the mapping comes with the program: the end of a remedy."""
        name = self.name.removesuffix(".toml")
        if name not in shipped_mappings():
            return ""
        return f" (in a copy: `actuator-select catalog import --show-mapping {name} > own.toml`)"

    @property
    def id_columns(self) -> list[str]:
        """Our columns that the id is made from."""
        return PLACEHOLDER.findall(self.id_from)


def shipped_mappings() -> dict[str, Path]:
    """Mappings that come with the program, by name."""
    return {path.stem: path for path in sorted(_FOLDER.glob("*.toml"))}


def find_shipped(name: str) -> Path:
    """File of a mapping that comes with the program; raises `UnknownName` if there is none of that name."""
    known = shipped_mappings()
    if name not in known:
        hint = did_you_mean(name, list(known))
        raise UnknownName(f"no mapping {name!r} comes with the program; {hint} (a file of your own ends in .toml)")
    return known[name]


def load_mapping(name: str | Path) -> Mapping:
    """Read a mapping.

    Parameters
    ----------
    name : str or Path
        A file that ends in ``.toml``, or the name of a mapping that comes with the program.

    Returns
    -------
    Mapping
        Checked: its columns exist, its units fit them.

    Raises
    ------
    UnknownName
        If no mapping that comes with the program is called so.
    InvalidRows
        With everything that is wrong in the file.
    """
    path = Path(name)
    if path.suffix.casefold() != ".toml":
        path = find_shipped(str(name))
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InvalidRows(
            f"cannot read the mapping {path}: {error.strerror or error}; check the name of the file"
        ) from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidRows(f"the mapping {path} is no TOML: {error}") from error
    return read_mapping(content, path.name)


def read_mapping(content: dict[str, Any], name: str) -> Mapping:
    """Check the content of a mapping; parameters, returns and raises as of `load_mapping`."""
    heading = f"the mapping {name} cannot be used"
    try:
        mapping = Mapping.model_validate(content | {"name": name})
    except ValidationError as error:
        problems = [_schema_problem(name, one) for one in error.errors()]
        raise InvalidRows(heading, [*problems, *_other_problems(content, name, error)]) from error
    try:
        kind = find_kind(mapping.kind)
    except UnknownName:
        remedy = did_you_mean(mapping.kind, list(KINDS))
        problem = Problem(place=f"{name}, kind", value=quoted(mapping.kind), expected="a kind of row", remedy=remedy)
        raise InvalidRows(heading, [problem]) from None
    if problems := [*_writing_problems(mapping), *_column_problems(mapping, kind), *_constant_problems(mapping, kind)]:
        raise InvalidRows(heading, problems)
    return mapping


def _other_problems(content: dict[str, Any], name: str, error: ValidationError) -> Sequence[Problem]:
    """What is wrong besides, in the parts of a mapping that are formed as they should be."""
    rest = dict(content)
    for first, *others in (one["loc"] for one in error.errors()):
        part = rest.get(str(first))
        if others and isinstance(part, dict):
            rest[str(first)] = {key: value for key, value in part.items() if key != others[0]}
        else:
            rest.pop(str(first), None)
    if "columns" in content and not rest.get("columns"):
        rest.pop("layout", None)  # it would miss the columns that were left out here
    if "kind" not in rest:
        return ()
    try:
        read_mapping(rest, name)
    except InvalidRows as more:
        return more.problems
    return ()


def _schema_problem(name: str, error: Any) -> Problem:  # noqa: ANN401 - pydantic's record of an error
    path = [str(part) for part in error["loc"] if not isinstance(part, int)]
    place = f"{name}, {'.'.join(path)}"
    if error["type"] == "extra_forbidden":
        models: dict[str, type[BaseModel]] = {"columns": Filling, "csv": Writing}
        known = [key for key in models.get(path[0], Mapping).model_fields if key != "name"]
        expected, remedy = "a key of a mapping", did_you_mean(path[-1], known)
        return Problem(place=place, value=quoted(path[-1]), expected=expected, remedy=remedy)
    if error["type"] == "missing":
        return Problem(place=place, value="empty", expected='a kind such as kind = "motors"', remedy="add it")
    expected = _EXPECTED.get(error["type"]) or error["msg"].removeprefix("Input should be ").removeprefix(
        "Value error, "
    )
    return Problem(place=place, value=quoted(error["input"]), expected=expected)


def _writing_problems(mapping: Mapping) -> Iterator[Problem]:
    place = f"{mapping.name}, csv"
    try:
        "".encode(mapping.csv.encoding)
    except LookupError:
        expected = "an encoding such as utf-8, cp1252 or utf-16"
        yield Problem(place=f"{place}.encoding", value=quoted(mapping.csv.encoding), expected=expected)
    if (mapping.csv.delimiter or ";") in f'{mapping.csv.decimal.replace(".", "")}"\r\n\0':
        yield Problem(
            place=f"{place}.delimiter",
            value=quoted(mapping.csv.delimiter),
            expected="another character than the decimal comma, a quotation mark or a line's end",
            remedy='write delimiter = ";" or "\\t"',
        )
    if not mapping.columns and mapping.layout != "table":
        yield Problem(
            place=f"{mapping.name}, columns", value="empty", expected="the columns 1 and 2", remedy="say what they fill"
        )


def _column_problems(mapping: Mapping, kind: Kind) -> Iterator[Problem]:
    filled: dict[str, str] = {}
    for foreign, fillings in mapping.columns.items():
        for filling in fillings:
            place = f"{mapping.name}, columns.{foreign}"
            if filling.ignore:
                if filling.field:
                    yield Problem(place=place, value="ignore = true", expected="either a field or ignore")
                continue
            column = kind.spellings.get(filling.field)
            if column is None:
                yield _no_column(f"{place}.field", filling.field, kind)
                continue
            if column.name in filled:
                expected = f"each field once; {filled[column.name]!r} fills it already"
                yield Problem(place=f"{place}.field", value=quoted(filling.field), expected=expected)
            filled[column.name] = foreign
            yield from _filling_problems(place, filling, column)
    for one in mapping.id_columns:
        if one not in {column.name for column in kind.fields if column.is_text}:
            yield _no_column(f"{mapping.name}, id_from", one, kind)
    if mapping.id_from and ("id" in filled or "id" in mapping.constants or not mapping.id_columns):
        expected = "columns in braces, and no other column or constant that fills id"
        yield Problem(place=f"{mapping.name}, id_from", value=quoted(mapping.id_from), expected=expected)


def _filling_problems(place: str, filling: Filling, column: Column) -> Iterator[Problem]:
    if column.is_text:
        stated = {"unit": filling.unit, "reciprocal": filling.reciprocal, "unlimited": filling.unlimited}
        for key in (key for key, value in {**stated, "zero_is_unknown": filling.zero_is_unknown}.items() if value):
            yield Problem(place=f"{place}.{key}", value="given", expected=f"none, because {column.name} is a text")
    elif column.unit and filling.unit is None:
        expected = f"the unit of the foreign figures; {column.name} is in {column.unit}"
        yield Problem(place=f"{place}.unit", value="empty", expected=expected, remedy=f'write unit = "{column.unit}"')
    elif filling.unit is not None or filling.reciprocal:
        try:
            conversion(filling.unit or "", column, reciprocal=filling.reciprocal)
        except UnitRefused as refused:
            expected = f"a unit that becomes {column.unit or 'a pure number'} for {column.name}"
            yield Problem(place=f"{place}.unit", value=quoted(filling.unit), expected=expected, remedy=str(refused))
    if filling.unlimited and not column.may_be_unlimited:
        expected = f"no such words, because {column.name} cannot be unlimited"
        yield Problem(place=f"{place}.unlimited", value=quoted(filling.unlimited[0]), expected=expected)
    if (filling.prefix or filling.make_id) and not column.is_text:
        yield Problem(place=place, value="prefix or make_id", expected=f"none, because {column.name} is a number")
    for word, ours in filling.values.items():
        try:
            read_value(column, ours)
        except Refused as refused:
            yield refused.at(f"{place}.values.{word}", ours)


def _constant_problems(mapping: Mapping, kind: Kind) -> Iterator[Problem]:
    filled = {one.field for fillings in mapping.columns.values() for one in fillings}
    stated: dict[str, str] = {}
    for name, value in mapping.constants.items():
        place = f"{mapping.name}, constants.{name}"
        column = kind.spellings.get(name)
        if column is None:
            yield _no_column(place, name, kind)
        elif filled & {column.name, *column.aliases}:
            yield Problem(place=place, value=quoted(value), expected="a field that no column fills")
        elif column.name in stated:
            expected = f"each field once; {stated[column.name]!r} fills it already"
            yield Problem(place=place, value=quoted(value), expected=expected)
        else:
            stated[column.name] = name
            try:
                read_value(column, value)
            except Refused as refused:
                yield refused.at(place, value)


def _no_column(place: str, name: str, kind: Kind) -> Problem:
    remedy = suggestion(name, list(kind.spellings), f"catalog fields {kind.name}")
    return Problem(place=place, value=quoted(name), expected=f"a column of {kind.name}", remedy=remedy)
