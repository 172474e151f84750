"""The same study under every tension model."""

from dataclasses import replace

import numpy as np

from actuator_select import Catalogue, load_study
from actuator_select.selection.candidates import find_candidates
from actuator_select.selection.models import compare_models


def test_an_unknown_figure_is_not_counted_as_passed(catalogue: Catalogue) -> None:
    study = load_study("cpr8")
    known = find_candidates(study, catalogue).actuators
    unknown = replace(known, rotor_inertia=np.where(np.arange(len(known)) == 0, np.nan, known.rotor_inertia))
    for before, after in zip(compare_models(study, known), compare_models(study, unknown), strict=True):
        assert after.feasible[0] == -1
        assert after.exact[0] is None
        assert after.feasible[1:] == before.feasible[1:]
        assert after.by_torque == before.by_torque
