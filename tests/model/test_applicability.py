"""Checks that say nothing about some actuators, and figures that are unknown: properties of the ranking."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from actuator_select.model.actuation import FIGURES_NEEDED, Check
from actuator_select.model.components import ActuatorSet
from actuator_select.model.demand import Demand, compute_demand
from actuator_select.model.dynamics import required_wrench
from actuator_select.model.evaluation import evaluate_actuators, missing_figures, position_utilisation
from actuator_select.model.families import cpr8, cpr8_region
from actuator_select.model.kinematics import position_grid
from actuator_select.model.motion import independent_motion
from actuator_select.model.ranking import Verdict, ranking_order, verdicts
from actuator_select.model.tension import TensionModel

FRAME, CARRIER = np.array([3.2, 2.2, 2.2]), np.array([0.224, 0.154, 0.140])
REQUIRED = 50.0
LIMITS = ("motor_speed", "motor_torque", "voltage")
BASE = {
    "motor_speed": 490.0,
    "motor_torque": 0.3,
    "voltage": 48.0,
    "back_emf_constant": 0.09,
    "torque_constant": 0.09,
    "resistance": 0.4,
    "friction": 0.0,
    "rotor_inertia": 5e-5,
    "ratio": 30.0,
    "efficiency": 0.6,
    "drum_radius": 0.08,
}


def demand_of(model: TensionModel) -> Demand:
    return compute_demand(
        cpr8(FRAME, CARRIER),
        position_grid(cpr8_region(FRAME, CARRIER), (4, 4, 4)),
        np.zeros((1, 3)),
        [[required_wrench(2.0, 9.81)]],
        independent_motion(1.3, 1.82, 1.82, centripetal=True),
        tension_model=model,
    )


DEMANDS = {model: demand_of(model) for model in (TensionModel.PSEUDO_INVERSE, TensionModel.FORCE_ONLY)}
models = st.sampled_from(list(DEMANDS))
factors = st.floats(0.02, 20.0)
figures = st.fixed_dictionaries({name: factors.map(lambda factor, name=name: BASE[name] * factor) for name in LIMITS})


def order_of(model: TensionModel, *actuators: dict[str, float]) -> list[int]:
    """Places of the actuators, best first."""
    evaluation = evaluate_actuators(DEMANDS[model], ActuatorSet.from_figures(actuators), list(Check))
    return ranking_order(evaluation, verdicts(evaluation, REQUIRED)).tolist()


@given(models, figures, st.sampled_from(["motor_speed", "motor_torque"]), st.floats(1.0, 10.0))
@settings(max_examples=60, deadline=None)
def test_a_stronger_ac_servo_never_ranks_lower(
    model: TensionModel, limits: dict[str, float], figure: str, factor: float
) -> None:
    servo = BASE | limits | {"direct_current": 0.0}
    assert order_of(model, servo | {figure: servo[figure] * factor}, servo)[0] == 0


@given(models, figures, st.sampled_from(LIMITS))
@settings(max_examples=60, deadline=None)
def test_an_unknown_limit_never_ranks_above_the_same_limit_known_and_met(
    model: TensionModel, limits: dict[str, float], figure: str
) -> None:
    met = BASE | limits | {figure: 1e9}
    assert order_of(model, met | {figure: np.nan}, met) == [1, 0]


@given(models, figures, st.sampled_from(sorted(BASE)))
@settings(max_examples=60, deadline=None)
def test_a_missing_figure_never_lets_a_check_pass(model: TensionModel, limits: dict[str, float], figure: str) -> None:
    actuators = ActuatorSet.from_figures([BASE | limits | {figure: np.nan}])
    evaluation = evaluate_actuators(DEMANDS[model], actuators, list(Check))
    for check, count in evaluation.checks.items():
        lacking = missing_figures(actuators, check, model)[0]
        assert count.evaluated[0] == (not lacking)
        assert (count.positions[0] == -1) == bool(lacking)
        assert (figure in FIGURES_NEEDED[check]) <= bool(lacking)
    assert verdicts(evaluation, REQUIRED)[0] is not Verdict.MEETS
    assert not evaluation.decided[0]


@given(models, figures)
@settings(max_examples=60, deadline=None)
def test_an_ac_servo_and_an_equal_dc_motor_differ_in_the_voltage_check_only(
    model: TensionModel, limits: dict[str, float]
) -> None:
    both = ActuatorSet.from_figures([BASE | limits | {"direct_current": one} for one in (1.0, 0.0)])
    evaluation = evaluate_actuators(DEMANDS[model], both, list(Check))
    for check, count in evaluation.checks.items():
        if check is not Check.VOLTAGE:
            assert count.positions[0] == count.positions[1]
            assert count.worst_utilisation[0] == count.worst_utilisation[1]
            assert count.applicable.all()
    voltage = evaluation.checks[Check.VOLTAGE]
    assert voltage.applicable.tolist() == [True, False]
    assert voltage.evaluated.tolist() == [True, False]
    assert (voltage.positions[1], np.isnan(voltage.worst_utilisation[1])) == (-1, True)
    without = evaluate_actuators(DEMANDS[model], both, [check for check in Check if check is not Check.VOLTAGE])
    assert evaluation.positions[1] == without.positions[1] == without.positions[0] >= evaluation.positions[0]
    assert verdicts(evaluation, REQUIRED)[1] is verdicts(without, REQUIRED)[1]


def test_what_does_not_apply_is_neither_open_nor_missing() -> None:
    actuators = ActuatorSet.from_figures(
        [BASE | {"direct_current": one, "friction": np.nan, "voltage": np.nan} for one in (1.0, 0.0, np.nan)]
    )
    model = TensionModel.PSEUDO_INVERSE
    evaluation = evaluate_actuators(DEMANDS[model], actuators, list(Check))
    assert evaluation.open_checks.tolist() == [1, 0, 1]
    assert evaluation.decided.tolist() == [False, True, False]
    unknown = ("voltage", "friction")
    assert missing_figures(actuators, Check.VOLTAGE, model) == [unknown, (), ("electrical_convention", *unknown)]
    assert verdicts(evaluation, 1.0) == [Verdict.UNDECIDED, Verdict.MEETS, Verdict.UNDECIDED]


def test_an_actuator_to_which_no_check_applies_is_undecided() -> None:
    servo = ActuatorSet.from_figures([BASE | {"direct_current": 0.0}])
    evaluation = evaluate_actuators(DEMANDS[TensionModel.PSEUDO_INVERSE], servo, [Check.VOLTAGE])
    assert verdicts(evaluation, REQUIRED) == [Verdict.UNDECIDED]


def test_the_utilisation_of_what_does_not_apply_is_unknown_and_the_others_are_untouched() -> None:
    both = ActuatorSet.from_figures([BASE, BASE | {"direct_current": 0.0}])
    used = position_utilisation(DEMANDS[TensionModel.FORCE_ONLY], both, list(Check))
    assert np.isnan(used[Check.VOLTAGE][1]).all()
    assert not np.isnan(used[Check.VOLTAGE][0]).any()
    assert used[Check.ACCELERATION][0].tolist() == used[Check.ACCELERATION][1].tolist()


def test_actuators_are_direct_current_unless_they_say_otherwise() -> None:
    assert ActuatorSet.from_figures([BASE, BASE]).direct_current.tolist() == [1.0, 1.0]
    plain = ActuatorSet(**{name: np.array([value]) for name, value in BASE.items()})
    assert plain.direct_current.tolist() == [1.0]
    assert replace(plain, direct_current=np.array([np.nan])).take([0, 0]).direct_current.shape == (2,)
    with pytest.raises(ValueError, match="expected 1, 0 or NaN"):
        replace(plain, direct_current=np.array([0.5]))
