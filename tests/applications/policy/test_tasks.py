"""Rewards, success and goals: functions of a few numbers, held against DexArt's definitions."""

import math
from dataclasses import replace

import pytest

from anymesh.applications.policy.tasks import (
    AJAR,
    NO_RANDOMIZATION,
    NOMINAL,
    JointGoal,
    PolicyTask,
    Randomization,
    Situation,
    joint_goal,
    reward,
    success,
)
from anymesh.errors import OptionError

OPEN, LIFT = PolicyTask.OPEN, PolicyTask.LIFT
AWAY = Situation(0.15, 0, False, 0.0, 0.0, 0.0, 0.0, 5, 70)


def test_nearer_is_better_until_a_finger_touches():
    assert reward(OPEN, AWAY) == pytest.approx(-0.15)
    assert reward(OPEN, replace(AWAY, distance=0.1)) > reward(OPEN, AWAY)
    assert reward(OPEN, replace(AWAY, distance=3.0)) == pytest.approx(-0.5)
    assert (
        reward(OPEN, replace(AWAY, fingers=2))
        > reward(OPEN, replace(AWAY, fingers=1))
        > reward(OPEN, replace(AWAY, distance=0.0))
    )


def test_progress_pays_only_in_contact_and_regress_always_costs():
    assert reward(OPEN, replace(AWAY, progress=0.5)) == reward(OPEN, AWAY)
    held = replace(AWAY, fingers=2)
    assert reward(OPEN, replace(held, progress=0.5)) == pytest.approx(reward(OPEN, held) + 0.5)
    assert reward(OPEN, replace(AWAY, progress=-0.5)) == pytest.approx(reward(OPEN, AWAY) - 0.25)


def test_the_lid_is_open_at_its_goal_in_contact_and_an_early_end_pays_more():
    done = replace(AWAY, fingers=2, progress=0.96)
    assert success(OPEN, done)
    assert not success(OPEN, replace(done, progress=0.94))
    assert not success(OPEN, replace(done, fingers=1))
    assert not success(OPEN, replace(done, distance=0.3))
    assert reward(OPEN, done) - reward(OPEN, replace(done, step=6)) == pytest.approx(1.2 * 0.96)


def test_the_bucket_is_lifted_by_its_raised_handle():
    held = replace(AWAY, fingers=2, progress=0.8, rise=0.26)
    assert success(LIFT, held)
    assert not success(LIFT, replace(held, rise=0.24))
    assert not success(LIFT, replace(held, progress=0.6))
    assert success(LIFT, replace(held, fingers=0))  # DexArt asks for no contact here
    low, high = (reward(LIFT, replace(held, rise=rise)) for rise in (0.05, 0.2))
    assert high > low


def test_a_collision_and_effort_cost():
    assert reward(OPEN, replace(AWAY, collides=True)) == pytest.approx(reward(OPEN, AWAY) - 0.1)
    assert reward(OPEN, replace(AWAY, effort=1.0)) < reward(OPEN, AWAY)


def test_open_ends_at_90_degrees_or_at_the_limit():
    assert joint_goal(OPEN, (-2.0, 1.0), slides=False) == JointGoal(-2.0 + AJAR, -2.0 + math.pi / 2)
    assert joint_goal(OPEN, (0.0, 1.0), slides=False).goal == pytest.approx(1.0)
    assert joint_goal(OPEN, (0.0, 0.2), slides=True).goal == pytest.approx(0.2)
    assert joint_goal(PolicyTask.CLOSE, (0.0, 0.2), slides=True) == JointGoal(0.2, 0.0)
    assert joint_goal(OPEN, (0.0, 1.0), slides=False, opening=0.5).goal == pytest.approx(0.5)


@pytest.mark.parametrize(("limits", "opening"), [((0.0, 0.0), None), ((0.0, 1.0), 1.5), ((0.0, 1.0), -0.1)])
def test_an_opening_out_of_range_is_refused(limits, opening):
    with pytest.raises(OptionError):
        joint_goal(OPEN, limits, False, opening)


def test_progress_counts_from_start_to_goal_in_both_directions():
    assert JointGoal(1.0, 0.0).progress(0.25) == pytest.approx(0.75)
    assert JointGoal(0.0, 2.0).progress(-1.0) == pytest.approx(-0.5)


def test_the_randomization_is_that_of_its_seed_and_within_its_ranges():
    import numpy as np

    ranges = Randomization()
    draws = [ranges.draw(np.random.default_rng(k)) for k in range(200)]
    assert draws[3] == ranges.draw(np.random.default_rng(3)) != draws[4]
    assert max(abs(d.x) for d in draws) <= ranges.position < 1.05 * max(abs(d.x) for d in draws)
    assert all(ranges.friction[0] <= d.friction <= ranges.friction[1] for d in draws)
    assert all(1 / ranges.mass <= d.mass <= ranges.mass for d in draws)
    assert min(d.mass for d in draws) < 0.8 < 1.25 < max(d.mass for d in draws)
    assert NO_RANDOMIZATION.draw(np.random.default_rng(0)) == NOMINAL


@pytest.mark.parametrize("wrong", [{"position": -1.0}, {"mass": 0.5}, {"friction": (2.0, 1.0)}, {"yaw": float("nan")}])
def test_a_randomization_out_of_range_is_refused(wrong):
    with pytest.raises(OptionError):
        Randomization(**wrong)
