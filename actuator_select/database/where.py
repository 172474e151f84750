"""The language of ``--where`` and ``--sort``: parsed, checked against the columns, compiled to SQL expressions.

No text of the user becomes SQL: names are looked up, values are bound.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from math import inf
from typing import Any, TypeAlias, cast

import sqlalchemy as sa
from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedToken

from actuator_select.database.queries import Column
from actuator_select.errors import InvalidExpression, did_you_mean

Condition: TypeAlias = sa.ColumnElement[bool]

_GRAMMAR = r"""
condition: either
?either: both (OR both)*
?both: negation (AND negation)*
?negation: NOT negation -> not_
    | test
?test: "(" either ")"
    | operand COMPARISON operand -> comparison
    | NAME IN "(" literal ("," literal)* ")" -> among
    | NAME NOT IN "(" literal ("," literal)* ")" -> not_among
    | NAME BETWEEN operand AND operand -> between
    | NAME CONTAINS TEXT -> contains
    | NAME IS STATE -> state
?operand: NAME | literal
?literal: NUMBER | TEXT

sort: key ("," key)*
key: [MINUS] NAME
names: NAME ("," NAME)*

OR.3: /or(?![\w.])/i
AND.3: /and(?![\w.])/i
NOT.3: /not(?![\w.])/i
IN.3: /in(?![\w.])/i
IS.3: /is(?![\w.])/i
BETWEEN.3: /between(?![\w.])/i
CONTAINS.3: /contains(?![\w.])/i
STATE.3: /(unknown|known|unlimited)(?![\w.])/i
COMPARISON: /<=|>=|<>|!=|==?|<|>/
NUMBER: /[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?(?![\w.])/
TEXT: /'([^']|'')*'|"([^"]|"")*"/
NAME: /[^\W\d]\w*(\.\w+)?/
MINUS: "-"
%ignore /\s+/
"""

_WORDS = {
    "NAME": "a column",
    "NUMBER": "a number",
    "TEXT": "a text in quotes",
    "COMPARISON": "a comparison (= <> < <= > >=)",
    "OR": "or",
    "AND": "and",
    "NOT": "not",
    "IN": "in",
    "IS": "is",
    "BETWEEN": "between",
    "CONTAINS": "contains",
    "STATE": "unknown, known or unlimited",
    "LPAR": "(",
    "RPAR": ")",
    "COMMA": "a comma",
    "MINUS": "-",
    "$END": "the end",
}

_LONGEST = 20_000  # characters
_DEEPEST = 40  # parentheses and nots; databases and Python both limit the depth of an expression
_MOST_TESTS = 400  # ors and ands, for the same reason

_COMPARISONS: Mapping[str, Callable[[Any, Any], Condition]] = {
    "=": lambda left, right: left == right,
    "==": lambda left, right: left == right,
    "<>": lambda left, right: left != right,
    "!=": lambda left, right: left != right,
    "<": lambda left, right: left < right,
    "<=": lambda left, right: left <= right,
    ">": lambda left, right: left > right,
    ">=": lambda left, right: left >= right,
}


def compile_condition(expression: str, columns: Sequence[Column]) -> Condition | None:
    """Compile a condition.

    Parameters
    ----------
    expression : str
        Such as ``rated_power_w >= 50 and motor.manufacturer in ('maxon', 'Faulhaber')``; empty for none.
    columns : sequence of Column
        What it may name; columns without a dot go before others of the same name.

    Returns
    -------
    sqlalchemy expression or None
        Rows whose column is unknown meet no comparison.

    Raises
    ------
    InvalidExpression
        Pointing at the word that cannot be understood.
    """
    if not expression.strip():
        return None
    (test,) = _subtrees(_parse(expression, "condition"))
    return _Compiler(expression, columns).condition(test)


def compile_sort(expression: str, columns: Sequence[Column]) -> list[sa.ColumnElement[Any]]:
    """Compile a sort order.

    Parameters
    ----------
    expression : str
        Such as ``rated_torque_nm, -motor.mass_kg``; a minus begins with the greatest.
    columns : sequence of Column
        What it may name.

    Returns
    -------
    list of sqlalchemy expressions
        For ORDER BY; unknown comes last.

    Raises
    ------
    InvalidExpression
        Pointing at the word that cannot be understood.
    """
    if not expression.strip():
        return []
    compiler = _Compiler(expression, columns)
    order: list[sa.ColumnElement[Any]] = []
    for key in _subtrees(_parse(expression, "sort")):
        *minus, name = _tokens(key)
        column = compiler.column(name).expression
        order += [column.is_(None), column.desc() if minus else column.asc()]
    return order


def find_columns(expression: str, columns: Sequence[Column]) -> list[Column]:
    """Look up a list of names.

    Parameters
    ----------
    expression : str
        Such as ``id, name, motor.rated_power_w``.
    columns : sequence of Column
        What it may name.

    Returns
    -------
    list of Column
        In the order of the names.

    Raises
    ------
    InvalidExpression
        Pointing at the word that cannot be understood.
    """
    compiler = _Compiler(expression, columns)
    return [compiler.column(name) for name in _tokens(_parse(expression, "names"))]


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", lexer="basic", start=["condition", "sort", "names"], maybe_placeholders=False)


def _parse(expression: str, start: str) -> Tree[Token]:
    expression = _one_line(expression)
    if len(expression) > _LONGEST:
        raise InvalidExpression(expression[:60], 0, f"the expression is longer than {_LONGEST} characters")
    try:
        tokens = list(_parser().lex(expression))
        _limit(expression, tokens)
        return _parser().parse(expression, start=start)
    except UnexpectedCharacters as error:
        position = cast("int", error.pos_in_stream)
        raise InvalidExpression(expression, position, _unreadable(expression[position:])) from error
    except UnexpectedToken as error:
        at_end = error.token.type == "$END"
        position = len(expression.rstrip()) if at_end else _position(error.token)
        raise InvalidExpression(expression, position, _unexpected(error)) from error


def _one_line(expression: str) -> str:
    """Blanks for line breaks and tabs, so that an error can point at a column."""
    return "".join(char if char.isprintable() else " " for char in expression)


def _limit(expression: str, tokens: Sequence[Token]) -> None:
    deep = [token for token in tokens if token.type in {"LPAR", "NOT"}]
    many = [token for token in tokens if token.type in {"OR", "AND"}]
    for found, most in ((deep, _DEEPEST), (many, _MOST_TESTS)):
        if len(found) > most:
            message = f"more than {most} of '{found[most]}' are too many"
            raise InvalidExpression(expression, _position(found[most]), message)


def _unreadable(rest: str) -> str:
    if rest[0] in "'\"":
        return f"the text that begins here has no closing {rest[0]}"
    if re.match(r"[+-]?[\d.]+[\w%°]", rest):
        return "this is no number; write it with a point and without its unit, which is that of the column"
    return f"the character {rest[0]!r} has no meaning here"


def _unexpected(error: UnexpectedToken) -> str:
    token = error.token
    if token.type == "COMMA":
        return "a comma has no meaning here; write decimals with a point, such as 0.5"
    if token.type == "COMPARISON" and "AND" in error.accepts:
        return "comparisons cannot be chained; write 'a < x and x < b' or 'x between a and b'"
    found = "the expression ends here" if token.type == "$END" else f"{str(token)!r} is not expected here"
    words = sorted({_WORDS.get(name, name) for name in error.accepts})
    return f"{found}; expected {' or '.join(words)}"


class _Compiler:
    """Looks names up and checks types while a tree becomes an SQL expression."""

    def __init__(self, expression: str, columns: Sequence[Column]) -> None:
        self._expression = _one_line(expression)
        self._columns = columns

    def column(self, token: Token) -> Column:
        """Column that a word names: its own name, an alias, or the last half of a joined name."""
        word = str(token).casefold()
        exact = [one for one in self._columns if word in _spellings(one)]
        by_last_half = [one for one in self._columns if word in _short_spellings(one)]
        for found in (exact, by_last_half):
            if len(found) == 1:
                return found[0]
            if found:
                names = ", ".join(one.name for one in found)
                raise self._error(token, f"{token} is ambiguous; write one of {names}")
        raise self._error(token, self._unknown(str(token)))

    def condition(self, node: Tree[Token]) -> Condition:
        """Compile a test or several."""
        inner = _subtrees(node)
        if node.data == "either":
            return sa.or_(*(self.condition(one) for one in inner))
        if node.data == "both":
            return sa.and_(*(self.condition(one) for one in inner))
        if node.data == "not_":
            return sa.not_(self.condition(inner[0]))
        tests: dict[str, Callable[[list[Token]], Condition]] = {
            "comparison": self._comparison,
            "among": lambda tokens: self._among(tokens[0], tokens[2:]),
            "not_among": lambda tokens: sa.not_(self._among(tokens[0], tokens[3:])),
            "between": self._between,
            "contains": self._contains,
            "state": self._state,
        }
        return tests[str(node.data)](_tokens(node))

    def _comparison(self, tokens: list[Token]) -> Condition:
        left, operator, right = tokens
        if left.type != "NAME" and right.type != "NAME":
            raise self._error(left, "a comparison needs a column on one of its sides")
        if left.type != "NAME":
            return _COMPARISONS[operator](self._value(left, right), self.column(right).expression)
        column = self.column(left)
        return _COMPARISONS[operator](column.expression, self._other(right, column))

    def _other(self, token: Token, column: Column) -> Any:  # noqa: ANN401 - a column or a bound value
        if token.type != "NAME":
            return self._checked(token, column)
        other = self.column(token)
        if other.field.is_text != column.field.is_text:
            raise self._error(token, f"{token} and {column.name} cannot be compared: one is a text, one a number")
        return other.expression

    def _value(self, literal: Token, name: Token) -> Any:  # noqa: ANN401 - a bound value
        return sa.literal(self._checked(literal, self.column(name)))

    def _among(self, name: Token, literals: Sequence[Token]) -> Condition:
        column = self.column(name)
        return column.expression.in_([self._checked(literal, column) for literal in literals])

    def _between(self, tokens: list[Token]) -> Condition:
        name, _, low, _, high = tokens
        column = self.column(name)
        return column.expression.between(self._other(low, column), self._other(high, column))

    def _contains(self, tokens: list[Token]) -> Condition:
        name, _, text = tokens
        column = self.column(name)
        if not column.field.is_text:
            raise self._error(name, f"{name} is a number{_unit(column)}; 'contains' searches texts")
        # Both sides in lower case here: a database's own lower() may know ASCII only.
        return sa.func.lower(column.expression).contains(_text(text).lower(), autoescape=True)

    def _state(self, tokens: list[Token]) -> Condition:
        name, _, state = tokens
        column = self.column(name)
        match state.casefold():
            case "unknown":
                return column.expression.is_(None)
            case "known":
                return column.expression.is_not(None)
            case _:
                if not column.field.may_be_unlimited:
                    raise self._error(state, f"{name} cannot be unlimited")
                return column.expression == inf

    def _checked(self, literal: Token, column: Column) -> str | float:
        if literal.type == "TEXT":
            text = _text(literal)
            if not column.field.is_text:
                raise self._error(
                    literal,
                    f"{column.name} is a number{_unit(column)}, {literal} a text; write a number without quotes",
                )
            return text
        if column.field.is_text:
            raise self._error(literal, f"{column.name} is a text, {literal} a number; write '{literal}' in quotes")
        number = float(literal)
        if abs(number) == inf:
            raise self._error(literal, f"{literal} is more than a number can hold; write '{column.name} is unlimited'")
        return number

    def _unknown(self, word: str) -> str:
        if word.casefold() in {"nan", "null", "none"}:
            return f"{word} compares with nothing; write 'is unknown' or 'is known' after a column"
        if word.casefold() in {"inf", "infinity"}:
            return f"{word} is no column; write 'is unlimited' after a column"
        names = [one.name for one in self._columns]
        known = names if "." in word else list(dict.fromkeys(name.rpartition(".")[2] for name in names))
        hint = did_you_mean(word.casefold(), known)
        if hint.startswith("known are"):
            hint = "`actuator-select catalog fields` lists the columns; a text stands in quotes"
        return f"there is no column {word}; {hint}"

    def _error(self, token: Token, message: str) -> InvalidExpression:
        return InvalidExpression(self._expression, _position(token), message)


def _subtrees(tree: Tree[Token]) -> list[Tree[Token]]:
    return [child for child in tree.children if isinstance(child, Tree)]


def _tokens(tree: Tree[Token]) -> list[Token]:
    return [child for child in tree.children if isinstance(child, Token)]


def _position(token: Token) -> int:
    position: int | None = token.start_pos
    return 0 if position is None else position


def _spellings(column: Column) -> set[str]:
    qualified = {f"{column.part}.{name}" for name in _short_spellings(column)}
    return qualified if "." in column.name else qualified | _short_spellings(column)


def _short_spellings(column: Column) -> set[str]:
    return {column.field.name, *column.field.aliases}


def _text(token: Token) -> str:
    quote = token[0]
    return str(token[1:-1]).replace(quote * 2, quote)


def _unit(column: Column) -> str:
    return f" [{column.field.unit}]" if column.field.unit else ""
