"""Test replays with contacts: a trajectory opens the door, and a displaced one fails with the reason reported."""

import sys

import numpy as np
import pytest

from anymesh.applications.plan.asset_ import open_object
from anymesh.applications.plan.film_ import Film, write_film
from anymesh.applications.plan.planner import open_arm, plan_motion
from anymesh.applications.plan.plans import BasePose
from anymesh.applications.plan.replay_ import Physics, ReplayFailure, ReplaySimulation, replay
from anymesh.errors import OptionError


def test_the_door_opens_and_nothing_passes_through(door_plan, cupboard, arm):
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7)
    assert seen.failure is None
    assert seen.value == pytest.approx(0.7, abs=0.05)
    assert seen.penetration < 0.003
    assert seen.force == 0
    assert seen.lag < 0.03


def test_the_door_stays_shut_when_it_is_elsewhere(door_plan, cupboard, arm):
    off = Physics(shift=(0.1, 0.0, 0.0))
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7, physics=off)
    assert seen.failure in (ReplayFailure.MISSED, ReplayFailure.SLIPPED, ReplayFailure.HIT)
    assert abs(seen.value) < 0.6


def test_a_door_that_resists_is_not_opened(door_plan, cupboard, arm):
    """What moves the part is contact, not a weld: the bar slips out of the fingers."""
    stiff = Physics(damping=10_000.0)  # 2000 N m s/rad
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7, physics=stiff)
    assert seen.failure in (ReplayFailure.SLIPPED, ReplayFailure.SHORT)


def test_the_mass_of_what_moves_is_scaled(cupboard, arm):
    one, two = (
        ReplaySimulation(cupboard, arm.robot, arm.hand, BasePose(0.0, -0.8, 0.0, 1.57), Physics(mass=m)) for m in (1.0, 2.0)
    )
    body = one.model.body("object/door").id
    assert two.model.body_mass[body] == pytest.approx(2 * one.model.body_mass[body])
    assert two.model.body_mass.sum() - one.model.body_mass.sum() == pytest.approx(one.model.body_mass[body])


@pytest.mark.parametrize("wanted", [0.0, float("nan"), float("inf")])
def test_a_replay_needs_a_value_to_reach(door_plan, cupboard, arm, wanted):
    with pytest.raises(OptionError, match="valid is a finite value of door_joint other than 0"):
        replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, wanted)


def test_a_button_goes_in(things, arm):
    panel = open_object(things / "panel.xml", "button")
    found = plan_motion(panel, arm, -0.01)
    seen = replay(found.trajectory, panel, arm.robot, arm.hand, found.base, -0.01, physics=Physics(spring=300.0))
    assert seen.failure is None
    assert -0.011 < seen.value <= -0.009  # a stop is hard, though the push means to go on by 4 mm


def test_a_film_shows_what_moves(things, cupboard, tmp_path):
    small = open_arm(things / "arm5.xml")
    film = Film(cupboard, small.robot, small.hand, BasePose(0.0, -0.6, 0.0, 1.57))
    states = np.tile(film.model.qpos0, (2, 1))
    states[1, film.model.joint("object/door_joint").qposadr[0]] = 1.0
    camera = film.camera(states, width=96, height=72)
    shut, still, opened = (film.frame(q, camera) for q in states[[0, 0, 1]])
    assert shut.shape == (72, 96, 3)
    assert (shut == still).all()
    assert (shut != opened).any(-1).mean() > 0.02
    with pytest.raises(OptionError, match=r"valid are files that end in .mp4 or .png"):
        write_film(film, states, tmp_path / "film.gif")


def test_without_its_extra_a_film_becomes_a_sheet(things, cupboard, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    small = open_arm(things / "arm5.xml")
    film = Film(cupboard, small.robot, small.hand, BasePose(0.0, -0.6, 0.0, 1.57))
    written = write_film(film, np.tile(film.model.qpos0, (2, 1)), tmp_path / "film.mp4")
    assert written == tmp_path / "film.png"
    assert [p.name for p in tmp_path.iterdir()] == ["film.png"]
