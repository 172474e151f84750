"""The design report: complete, escaped, by itself."""

import re
from datetime import UTC, datetime
from html import unescape
from pathlib import Path

import pytest

from actuator_select import Catalogue, ReportDetails, load_study, open_catalogue, rank, render_report
from actuator_select.selection.dossier import build_dossier
from actuator_select.selection.plausibility import check_rows
from tests.selection.parts import PRINTED

DETAILS = ReportDetails(
    generated_at=datetime(2026, 11, 22, 12, 0, tzinfo=UTC),
    project="Camera <robot>",
    author="A & B",
    revision="C",
    command="actuator-select report cpr8",
)


@pytest.fixture(scope="module")
def page(catalogue: Catalogue) -> str:
    return render_report(rank(load_study("cpr8"), catalogue, where=PRINTED), catalogue, DETAILS)


def test_the_first_section_has_verdict_weakest_check_pose_and_what_is_not_modelled(page: str) -> None:
    first = page[page.index('<section class="first">') : page.index("</section>")]
    text = " ".join(re.sub(r"<[^>]+>", " ", first).split())
    assert "1 of 5 actuators serves at least 90 % of the workspace: Actuator 1." in text
    assert "acceleration, 204/216 on its own" in text
    assert "x 3.047, y 2.047, z -0.153 m" in text
    assert "What is not modelled Sag and elasticity" in text
    for limits in (
        "Not checked, even where the catalogue states it: the motor's peak torque, greatest speed and heating;",
        "the gearbox's continuous and intermittent torque and input speed; the winch's tension and speed;",
        "the rope's breaking force.",
    ):
        assert limits in unescape(text)
    assert "pseudo_inverse" in text


def test_the_report_needs_no_network_and_no_other_file(page: str) -> None:
    references = re.findall(r'(?:src|href)\s*=\s*"([^"]*)"', page)
    assert references
    assert all(reference.startswith("data:image/") for reference in references)
    assert "<script" not in page
    assert "@import" not in page
    assert "url(" not in page
    assert len(page.encode()) < 3_000_000


def test_every_figure_has_a_description(page: str) -> None:
    images = re.findall(r"<img[^>]*>", page)
    assert len(images) > 8
    assert all(re.search(r'alt="[^"]{10,}"', image) for image in images)


def test_the_published_table_stands_only_in_studies_that_have_one(page: str, catalogue: Catalogue) -> None:
    assert "Table 2" in page
    text = load_study("cpr8").text
    own = text[: text.index("[published]")].replace('name = "cpr8"', 'name = "mine"')
    from actuator_select.study import parse_study

    other = render_report(rank(parse_study(own, place="mine"), catalogue), catalogue, DETAILS)
    assert "Table 2" not in other
    assert "Published:" not in other


def test_the_report_says_how_to_repeat_it(page: str, catalogue: Catalogue) -> None:
    assert catalogue.fingerprint() in page
    assert "actuator-select report cpr8" in page
    assert "2026-11-22 12:00 UTC" in page
    assert "Camera &lt;robot&gt;" in page
    assert "A &amp; B" in page
    assert "speed_max_m_per_s = 1.3" in page


def test_the_report_repeats_the_plausibility_findings_of_its_parts(page: str) -> None:
    for part in ("motor-2", "motor-3", "motor-4", "motor-5"):
        assert f"filipovic-kevac-2018-{part}" in page[page.index("Warnings") : page.index("What is not modelled")]
    assert "112.3 W follows from rated torque × rated speed" in page


def test_the_report_explains_the_findings_of_shipped_parts(catalogue: Catalogue, page: str) -> None:
    parts = " ".join(unescape(page[page.index("<h2>Parts and sources</h2>") :]).split())
    (finding,) = [
        one
        for one in check_rows("motors", [catalogue.part("filipovic-kevac-2018-motor-3")[1]])
        if one.rule == "rated_speed"
    ]
    assert finding.explanation is not None
    assert f"{finding.rule}: {finding.text}. Why: {finding.explanation}</li>" in parts


def test_the_twins_stand_in_everything_that_the_report_shows_of_the_case_study(catalogue: Catalogue) -> None:
    selection = rank(load_study("cpr8"), catalogue)
    details = [detail.actuator.name for detail in build_dossier(selection, catalogue).details]
    for twin in ("Actuator 4 (maxon 236662)", "Actuator 5 (maxon DCX22L01EBSL596)"):
        assert twin in details
    page = " ".join(render_report(selection, catalogue, DETAILS).split())
    compared = page[page.index("What the answer owes to the tension model") : page.index("<h2>Ranking</h2>")]
    others = page[page.index("Actuators that the publication does not have") :]
    for section in (compared, others[: others.index("</table>")]):
        assert "Actuator 4 (maxon 236662)" in section
        assert "Actuator 5 (maxon DCX22L01EBSL596)" in section


def test_where_only_the_best_are_shown_the_report_says_of_how_many() -> None:
    with open_catalogue(":memory:") as own:
        row = own.part("filipovic-kevac-2018-4")[1]
        same = {name: value for name, value in row.items() if "." not in name and name != "origin"}
        for number in range(10):
            own.add("actuators", same | {"id": f"a{number}", "name": f"A{number}"})
        added = ", ".join(f"'a{number}'" for number in range(10))
        page = render_report(rank(load_study("cpr8"), own, where=f"id in ({added})"), own, DETAILS)
        few = render_report(rank(load_study("cpr8"), own, where="id in ('a1', 'a2')"), own, DETAILS)
    assert page.count("Shown: the best 8 of 10 actuators.") == 3
    assert "Shown: the best 3 of 10 actuators." in page
    assert "Slices: the best 3 of 10 actuators." in page
    assert "Of the best 8 of 10 actuators." in page
    for words in ("Shown: the best", "Slices: the best", "Of the best"):
        assert words not in few


def test_a_part_named_like_a_script_appears_as_text() -> None:
    name = "<script>alert(1)</script>"
    with open_catalogue(":memory:") as own:
        own.add(
            "actuators",
            {
                "id": "evil",
                "name": name,
                "motor_id": "filipovic-kevac-2018-motor-1",
                "gearbox_id": "filipovic-kevac-2018-gearbox-30",
                "winch_id": "filipovic-kevac-2018-winch",
                "efficiency_percent": 60,
                "source_id": "filipovic-kevac-2018",
                "notes": "<img src=x onerror=alert(2)>",
            },
        )
        page = render_report(rank(load_study("cpr8"), own), own, DETAILS)
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    assert "<script" not in page
    assert "<img src=x" not in page


def test_a_report_of_actuators_with_unknown_figures_says_so() -> None:
    with open_catalogue(":memory:") as own:
        own.add("motors", {"id": "bare", "rated_speed_rpm": 5000, "source_id": "filipovic-kevac-2018"})
        own.add(
            "actuators",
            {
                "id": "bare",
                "name": "Bare",
                "motor_id": "bare",
                "winch_id": "filipovic-kevac-2018-winch",
                "source_id": "filipovic-kevac-2018",
            },
        )
        selection = rank(load_study("cpr8"), own, where="name = 'Bare'")
        page = render_report(selection, own, DETAILS)
    assert selection.ranked[0].verdict == "undecided"
    assert "cannot be decided, because figures are missing" in page
    assert "Bare: torque not evaluated, rated torque" in page


def test_a_fine_grid_stays_under_the_size_limit(catalogue: Catalogue) -> None:
    study = load_study("cpr8", {"workspace.points": [40, 40, 40]})
    assert len(render_report(rank(study, catalogue), catalogue, DETAILS).encode()) < 3_000_000


def test_the_finished_report_is_that_of_this_program_and_this_catalogue(catalogue: Catalogue, page: str) -> None:
    finished = (Path(__file__).parents[2] / "reports" / "cpr8.html").read_text(encoding="utf-8")
    assert catalogue.fingerprint() in finished
    for text in ("200/216 (92.6 %)", "184/216 (85.2 %)", "180/216 (83.3 %)", "152/216 (70.4 %)", "0/216 (0.0 %)"):
        assert text in finished
        assert text in page
    assert re.sub(r"(?s)<header>.*?</header>|<img[^>]*>", "", finished).count("<h2>") == page.count("<h2>")


def test_dollar_signs_in_names_are_dollar_signs() -> None:
    with open_catalogue(":memory:") as own:
        row = own.part("filipovic-kevac-2018-1")[1]
        same = {name: value for name, value in row.items() if "." not in name and name != "origin"}
        own.add("actuators", same | {"id": "dollar", "name": "Drive $x_{$"})
        page = render_report(rank(load_study("cpr8"), own, where="id = 'dollar'"), own, DETAILS)
    assert "Drive $x_{$" in page
