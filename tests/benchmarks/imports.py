"""How long an import takes and what memory it needs: ``python -m tests.benchmarks.imports``.

Each size runs in a process of its own, so that its peak is its own. Rows are invented: every column of a motor is
filled as the shipped rows fill it.
"""

import csv
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from resource import RUSAGE_SELF, getrusage

from actuator_select.database import open_catalogue
from actuator_select.database.kinds import MOTORS
from actuator_select.database.shipped import read_shipped

SIZES = (10_000, 100_000)


def write_motors(path: Path, count: int) -> None:
    """Write motors with a figure in every column that takes one."""
    names = [field.name for field in MOTORS.fields]
    source = next(iter(read_shipped()["sources"]))
    row = {field.name: _cell(field.name) for field in MOTORS.fields} | {"source_id": source}
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for number in range(count):
            filled = row | {"id": f"motor-{number}", "mass_kg": f"{1 + number % 997 / 1000}"}
            writer.writerow([filled[name] for name in names])


def _cell(name: str) -> str:
    field = MOTORS.field(name)
    if field.choices:
        return field.choices[0]
    if not field.is_text:
        return "12" if field.type == "int" else "12.5"
    texts = {"price_currency": "EUR", "price_date": "2026-11", "source_date": "2026", "accessed_date": "2026-11-22"}
    return texts.get(name, "words of some length")


def measure(path: Path) -> None:
    """Import a file into a new catalogue, and print the seconds and the peak memory in MiB before and after."""
    with tempfile.TemporaryDirectory() as folder, open_catalogue(Path(folder) / "catalogue.db") as catalogue:
        before = getrusage(RUSAGE_SELF).ru_maxrss
        start = time.perf_counter()
        catalogue.import_file(path, "motors")
        print(time.perf_counter() - start, before / 2**10, getrusage(RUSAGE_SELF).ru_maxrss / 2**10)


def main() -> None:
    """Print seconds and peak memory for every size, and their ratio."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for size in SIZES:
            path = Path(folder) / "motors.csv"
            write_motors(path, size)
            run = [sys.executable, "-m", "tests.benchmarks.imports", str(path)]
            told = subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()
            seconds.append(float(told[0]))
            print(
                f"import of {size:,} motors × {len(MOTORS.fields)} columns, all filled: {seconds[-1]:.1f} s; peak "
                f"memory {float(told[2]):.0f} MiB ({float(told[1]):.0f} before it)"
            )
    print(f"{SIZES[-1] / SIZES[0]:.0f} times the rows take {seconds[-1] / seconds[0]:.1f} times as long")


if __name__ == "__main__":
    if sys.argv[1:]:
        measure(Path(sys.argv[1]))
    else:
        main()
