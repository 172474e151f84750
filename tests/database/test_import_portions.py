"""Long files: in one transaction, portion by portion, with flat memory; interrupted or refused, they leave nothing."""

import signal
import subprocess
import sys
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

from actuator_select.database import Catalogue, open_catalogue
from actuator_select.errors import InvalidRows

Write = Callable[[str, str], Path]
PORTION = 1000


def motors(count: int) -> str:
    return "id,rated_power_w,source_id\n" + "".join(f"m{number},{number + 1},$\n" for number in range(count))


def refusal(catalogue: Catalogue, path: Path, **options: bool) -> InvalidRows:
    before = catalogue.fingerprint()
    with pytest.raises(InvalidRows) as error:
        catalogue.import_file(path, **options)
    assert catalogue.fingerprint() == before
    return error.value


def test_a_value_that_is_repeated_far_apart_is_found(catalogue: Catalogue, write_csv: Write) -> None:
    path = write_csv("motors.csv", motors(3 * PORTION) + "m5,1,$\n")
    (problem,) = refusal(catalogue, path).problems
    assert problem.place == f"motors.csv, line {3 * PORTION + 2}, id"
    assert problem.expected == "another id than motors.csv, line 7"


def test_a_name_that_is_repeated_far_apart_is_told_once(catalogue: Catalogue, write_csv: Write) -> None:
    parts = "filipovic-kevac-2018-motor-1,filipovic-kevac-2018-winch,$"
    rows = "".join(f"a{number},Name {number},{parts}\n" for number in range(2 * PORTION))
    path = write_csv("actuators.csv", f"id,name,motor_id,winch_id,source_id\n{rows}b,Name 3,{parts}\n")
    (problem,) = refusal(catalogue, path).problems
    assert problem.expected == "another name than actuators.csv, line 5"


def test_what_is_wrong_far_apart_is_told_together_and_in_order(catalogue: Catalogue, write_csv: Write) -> None:
    text = motors(PORTION) + "x,-1,$\n" + motors(2 * PORTION).split("\n", 1 + PORTION)[-1] + "y,2,nowhere\n"
    problems = refusal(catalogue, write_csv("motors.csv", text)).problems
    assert [problem.place for problem in problems] == [
        f"motors.csv, line {PORTION + 2}, rated_power_w",
        f"motors.csv, line {2 * PORTION + 3}, source_id",
    ]


def test_of_very_many_problems_the_first_are_told(catalogue: Catalogue, write_csv: Write) -> None:
    text = "id,rated_power_w,source_id\n" + "".join(f"m{number},x,$\n" for number in range(5 * PORTION))
    error = refusal(catalogue, write_csv("motors.csv", text))
    assert len(error.problems) == 2000
    assert "there are more than 2000 problems" in str(error)
    assert error.problems[-1].place == "motors.csv, line 2001, rated_power_w"


def test_memory_does_not_grow_with_the_file(template: Path, tmp_path: Path, write_csv: Write) -> None:
    peaks = []
    for count in (3 * PORTION, 15 * PORTION):
        path = write_csv("motors.csv", motors(count))
        database = tmp_path / f"{count}.db"
        database.write_bytes(template.read_bytes())
        with open_catalogue(database) as catalogue:
            tracemalloc.start()
            catalogue.import_file(path)
            peaks.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
            assert catalogue.count("motors") == 5 + count
    assert peaks[1] - peaks[0] < 2**19  # the ids alone of the 12,000 rows between would take more


def test_rows_are_told_in_portions(catalogue: Catalogue, write_csv: Write) -> None:
    told: list[tuple[str, int]] = []
    path = write_csv("motors.csv", motors(2 * PORTION + 10))
    catalogue.import_file(path, on_rows=lambda kind, rows: told.append((kind, len(rows))))
    assert told == [("motors", PORTION), ("motors", PORTION), ("motors", 10)]


IMPORTING = """
import sys
from actuator_select.database import open_catalogue

def progress(done, total):
    if done == 5000:
        print("under way", flush=True)

with open_catalogue(sys.argv[1]) as catalogue:
    catalogue.import_file(sys.argv[2], progress=progress)
"""


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_an_import_that_is_stopped_from_outside_leaves_nothing(
    catalogue: Catalogue, tmp_path: Path, write_csv: Write, how: signal.Signals
) -> None:
    before = catalogue.fingerprint()
    path = write_csv("motors.csv", motors(30 * PORTION))
    command = [sys.executable, "-c", IMPORTING, str(tmp_path / "catalogue.db"), str(path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "under way\n"
        process.send_signal(how)
        _, err = process.communicate(timeout=60)
    assert process.returncode != 0
    assert how is signal.SIGKILL or "KeyboardInterrupt" in err
    assert catalogue.fingerprint() == before
    assert catalogue.import_file(write_csv("motors.csv", motors(10)))[0].added == 10


SPREADSHEET_HEADER = "id;rated_power_w;rated_torque_nm;mass_kg;source_id"


def test_a_spreadsheet_in_german_is_refused_with_every_cell_named(catalogue: Catalogue, tmp_path: Path) -> None:
    rows = [f"m{number};{number},5;0,{number + 1};1;filipovic-kevac-2018" for number in range(1, 26)]
    rows[3] = rows[3].replace("m4", "m3")
    text = "\r\n".join(["\ufeff" + SPREADSHEET_HEADER, *rows]) + "\r\n"
    path = tmp_path / "motors.csv"
    path.write_bytes(text.encode())
    problems = refusal(catalogue, path).problems
    cells = [
        f"motors.csv, line {line}, {name}" for line in range(2, 27) for name in ("rated_power_w", "rated_torque_nm")
    ]
    assert [problem.place for problem in problems] == [
        "motors.csv, line 1",
        *cells[:8],
        "motors.csv, line 5, id",
        *cells[8:],
    ]
    assert "replace the semicolons by commas" in problems[0].remedy
    assert problems[1].remedy == "a decimal comma was given, write 1.5 with a point"


def test_where_only_semicolons_and_decimal_commas_are_wrong_a_mapping_is_proposed_that_works(
    catalogue: Catalogue, tmp_path: Path
) -> None:
    path = tmp_path / "motors.csv"
    path.write_text(f"\ufeff{SPREADSHEET_HEADER}\nm1;1,5;0,2;1;filipovic-kevac-2018\n", encoding="utf-8")
    remedy = refusal(catalogue, path).problems[0].remedy
    for part in ('kind = "motors"', "[csv]", 'delimiter = ";"', 'decimal = ","'):
        assert part in remedy
    mapping = tmp_path / "own.toml"
    mapping.write_text('kind = "motors"\n[csv]\ndelimiter = ";"\ndecimal = ","\n')
    catalogue.import_file(path, mapping=mapping)
    assert catalogue.part("m1")[1]["rated_power_w"] == 1.5
