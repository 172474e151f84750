"""What the tables themselves refuse, whoever writes to them."""

from math import inf, nan

import pytest
import sqlalchemy as sa

from actuator_select.database import Catalogue
from actuator_select.database.connection import writing
from actuator_select.database.schema import TABLES

MOTOR = {"id": "m", "source_id": "filipovic-kevac-2018", "origin": "user"}
ACTUATOR = {
    "id": "a",
    "name": "A",
    "motor_id": "filipovic-kevac-2018-motor-1",
    "winch_id": "filipovic-kevac-2018-winch",
    "source_id": "filipovic-kevac-2018",
    "origin": "user",
}


@pytest.mark.parametrize(
    ("table", "row"),
    [
        ("motors", MOTOR | {"rated_power_w": 0.0}),
        ("motors", MOTOR | {"rated_power_w": -1.0}),
        ("motors", MOTOR | {"rated_power_w": inf}),
        ("motors", MOTOR | {"max_efficiency_percent": 101.0}),
        ("motors", MOTOR | {"max_efficiency_percent": 0.9}),
        ("motors", MOTOR | {"viscous_friction_nm_s_per_rad": -0.1}),
        ("motors", MOTOR | {"rated_torque_nm": 2.0, "peak_torque_nm": 1.0}),
        ("motors", MOTOR | {"electrical_convention": "steam"}),
        ("motors", MOTOR | {"source_id": "nowhere"}),
        ("motors", MOTOR | {"source_id": None}),
        ("motors", MOTOR | {"origin": None}),
        ("motors", MOTOR | {"id": ""}),
        ("sources", {"id": "s", "document": "D", "date": "2020", "origin": "user"}),
        ("sources", {"id": "s", "document": "D", "url": "https://example.org", "origin": "user"}),
        ("actuators", ACTUATOR | {"motor_id": "nowhere"}),
        ("actuators", ACTUATOR | {"winch_id": None}),
        ("actuators", ACTUATOR | {"name": "Actuator 1"}),
    ],
)
def test_a_row_that_cannot_be_is_refused(catalogue: Catalogue, table: str, row: dict[str, object]) -> None:
    with pytest.raises(sa.exc.IntegrityError), catalogue._engine.begin() as connection:  # noqa: SLF001
        connection.execute(TABLES[table].insert(), row)


def test_a_source_that_rows_name_cannot_be_removed(catalogue: Catalogue) -> None:
    with pytest.raises(sa.exc.IntegrityError), catalogue._engine.begin() as connection:  # noqa: SLF001
        connection.execute(TABLES["sources"].delete())


def test_unknown_unlimited_and_zero_stay_three_things(catalogue: Catalogue) -> None:
    row = MOTOR | {"max_speed_rpm": inf, "viscous_friction_nm_s_per_rad": 0.0, "rated_power_w": nan}
    with writing(catalogue._engine) as connection:  # noqa: SLF001
        connection.execute(TABLES["motors"].insert(), row)
    motor = catalogue.part("m")[1]
    assert motor["max_speed_rpm"] == inf
    assert motor["viscous_friction_nm_s_per_rad"] == 0.0
    assert motor["rated_power_w"] is None
