"""What describes a column of the catalogue, and a kind of row. Everything else is derived from these descriptions."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

UNIT_SUFFIXES = MappingProxyType(
    {
        "W": "_w",
        "V": "_v",
        "A": "_a",
        "rpm": "_rpm",
        "N m": "_nm",
        "Ω": "_ohm",
        "mH": "_mh",
        "N m/A": "_nm_per_a",
        "rpm/V": "_rpm_per_v",
        "V s/rad": "_v_s_per_rad",
        "N m s/rad": "_nm_s_per_rad",
        "g cm²": "_g_cm2",
        "kg m²": "_kg_m2",
        "kg": "_kg",
        "kg/m": "_kg_per_m",
        "K/W": "_k_per_w",
        "s": "_s",
        "°C": "_c",
        "%": "_percent",
        "arcmin": "_arcmin",
        "mm": "_mm",
        "m": "_m",
        "m/s": "_m_per_s",
        "N": "_n",
    }
)
"""How a unit ends a column's name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """A column of one kind of row.

    Attributes
    ----------
    name : str
        Column name, ending in its unit.
    type : {"float", "int", "str"}
        What it holds.
    description : str
        What it means.
    unit : str
        Unit as printed; empty for texts and pure numbers.
    minimum, exclusive_minimum, maximum : float or None
        What physics allows, in `unit`.
    may_be_unlimited : bool
        Whether the word ``unlimited`` (an infinite float) may stand here.
    required : bool
        Whether a row without it is refused.
    unique : bool
        Whether no two rows may share it.
    choices : tuple of str
        The only texts allowed, where there are such.
    pattern, form : str
        Regular expression that the whole text has to match, and the same in words.
    references : str
        Kind whose id stands here.
    aliases : tuple of str
        Other names that are understood in CSV headers and conditions.
    """

    name: str
    type: Literal["float", "int", "str"]
    description: str
    unit: str = ""
    minimum: float | None = None
    exclusive_minimum: float | None = None
    maximum: float | None = None
    may_be_unlimited: bool = False
    required: bool = False
    unique: bool = False
    choices: tuple[str, ...] = ()
    pattern: str = ""
    form: str = ""
    references: str = ""
    aliases: tuple[str, ...] = ()

    @property
    def is_text(self) -> bool:
        """Whether it holds texts."""
        return self.type == "str"

    @property
    def label(self) -> str:
        """Name for people, such as ``rated power [W]``."""
        words = self.name.removesuffix(UNIT_SUFFIXES.get(self.unit, "")).replace("_", " ")
        return f"{words} [{self.unit}]" if self.unit else words

    @property
    def expected(self) -> str:
        """What may stand here, with its unit, such as ``more than 0 [W]``."""
        if self.choices:
            return f"one of {', '.join(self.choices)}"
        if self.references:
            return f"the id of a row of {self.references}"
        if self.is_text:
            return self.form or "a text"
        noun = "a whole number" if self.type == "int" else "a number"
        text = " ".join(part for part in (noun, self.range_text) if part)
        text = f"{text} [{self.unit}]" if self.unit else text
        return f"{text}, or unlimited" if self.may_be_unlimited else text

    @property
    def range_text(self) -> str:
        """Allowed range in words, without the unit; empty where every number may stand."""
        limits = []
        if self.exclusive_minimum is not None:
            limits.append(f"more than {self.exclusive_minimum:g}")
        if self.minimum is not None:
            limits.append(f"at least {self.minimum:g}")
        if self.maximum is not None:
            limits.append(f"at most {self.maximum:g}")
        return " and ".join(limits)


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """Two columns of a row of which one can never be below the other.

    Attributes
    ----------
    greater, lesser : str
        Column names.
    """

    greater: str
    lesser: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """A kind of row: a table of the database, a CSV file, a word of the command line.

    Attributes
    ----------
    name, singular : str
        Such as ``motors`` and ``motor``.
    description : str
        What a row stands for.
    fields : tuple of Field
        Columns that users fill, in the order of the CSV file.
    shown : tuple of str
        Columns of the table for people, the most important first; narrow terminals leave out the last.
    orders : tuple of Order
        Relations between columns that physics enforces.
    any_of : tuple of tuple of str
        Groups of columns of which at least one has to be known.
    """

    name: str
    singular: str
    description: str
    fields: tuple[Field, ...]
    shown: tuple[str, ...]
    orders: tuple[Order, ...] = ()
    any_of: tuple[tuple[str, ...], ...] = ()

    @property
    def columns(self) -> tuple[Field, ...]:
        """`fields` and what the program itself fills."""
        return (*self.fields, ORIGIN)

    @property
    def required(self) -> tuple[Field, ...]:
        """Fields without which a row is refused."""
        return tuple(field for field in self.fields if field.required)

    @property
    def unique(self) -> tuple[Field, ...]:
        """Fields besides the id in which no two rows hold the same."""
        return tuple(field for field in self.fields if field.unique)

    @property
    def references(self) -> tuple[Field, ...]:
        """Fields that hold the id of another row."""
        return tuple(field for field in self.fields if field.references)

    @property
    def spellings(self) -> dict[str, Field]:
        """Fields by name and by alias."""
        return {name: field for field in self.fields for name in (field.name, *field.aliases)}

    def field(self, name: str) -> Field:
        """Column called `name`; a KeyError where there is none."""
        for field in self.columns:
            if field.name == name:
                return field
        raise KeyError(name)


ORIGIN = Field(
    name="origin",
    type="str",
    required=True,
    choices=("shipped", "user"),
    description="Whether the row came with the program or from the user; set by the program",
)
