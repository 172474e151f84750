"""Every example in a public docstring runs and gives what it says."""

import doctest
from datetime import datetime
from pathlib import Path

import pytest

import actuator_select

PUBLIC = {name: getattr(actuator_select, name) for name in actuator_select.__all__}
WITH_EXAMPLES = {"evaluate", "evaluate_workspace", "load_study", "open_catalogue", "rank", "render_report", "simulate"}


@pytest.mark.parametrize("name", [*sorted(WITH_EXAMPLES), "actuator_select"])
def test_the_examples_of_a_docstring_hold(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ACTUATOR_SELECT_DATABASE", str(tmp_path / "catalogue.db"))
    subject = PUBLIC.get(name, actuator_select)
    found = doctest.DocTestParser().get_doctest(subject.__doc__ or "", PUBLIC | {"datetime": datetime}, name, None, 0)
    assert found.examples
    failures = []
    doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(found, out=failures.append)
    assert failures == []


def test_every_public_name_is_there_and_documented() -> None:
    assert {"load_study", "open_catalogue", "evaluate", "rank", "simulate", "render_report"} <= set(PUBLIC)
    for name, subject in PUBLIC.items():
        assert name == "__version__" or subject.__doc__, name
    with pytest.raises(AttributeError, match="nonsense"):
        _ = actuator_select.nonsense
