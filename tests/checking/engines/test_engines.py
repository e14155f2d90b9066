"""The engines by name, in processes of their own, and the loop that drives a joint in each of them."""

import sys
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from drawn import chest

from anymesh.checking.engines import ENGINES, sweep_in
from anymesh.checking.engines.driving import STEP, drive, from_record, motors_of, readable
from anymesh.checking.engines.robot import read_urdf
from anymesh.errors import InputError, MissingExtraError, OptionError

OTHERS = [name for name in ENGINES if name != "mujoco"]


class Ideal:
    """A world that obeys at once; `stop` is where the first joint is blocked, `read` what it takes limits for."""

    engine = "ideal 1"

    def __init__(self, robot, stop: float = np.inf, read=None, twist: float = 0.0) -> None:
        self.robot, self.stop, self.twist = robot, stop, twist
        self.limits = {j.name: read or j.limits for j in robot.moving}
        self.reset()

    def reset(self) -> None:
        self.at = np.zeros(len(self.limits))

    def step(self, targets: np.ndarray) -> None:
        self.at = targets.copy()
        self.at[0] = min(self.at[0], self.stop)

    def positions(self) -> np.ndarray:
        return self.at

    def pose(self, link: str) -> np.ndarray:
        told = {name: v + self.twist for name, v in zip(self.limits, self.at, strict=True)}
        return self.robot.placements(told)[link]


@pytest.fixture
def robot(tmp_path):
    return read_urdf(chest(tmp_path))


def test_joints_that_obey_are_in_order(robot):
    report = drive(Ideal(robot), robot)
    assert report.ok
    assert [(j.name, j.reached_lower, j.reached_upper) for j in report.joints] == [("slide", 0, 0.3), ("hinge", 0, 1.6)]


def test_a_joint_that_is_blocked_is_told(robot):
    slide, hinge = drive(Ideal(robot, stop=0.1), robot).joints
    assert hinge.ok
    assert slide.reached_upper == pytest.approx(0.1)
    assert "not to its upper limit 0.3" in slide.faults[0]
    assert "it does not move" in drive(Ideal(robot, stop=0.0), robot).joints[0].faults


def test_a_drawer_behind_a_door_is_tried_with_the_door_opened(robot):
    class Behind(Ideal):
        def step(self, targets):
            super().step(targets)
            self.at[0] = min(self.at[0], 0.3 if self.at[1] > 1.5 else 0.08)

    report = drive(Behind(robot), robot)
    assert report.ok
    assert [(j.name, j.opened) for j in report.joints] == [("slide", ("hinge",)), ("hinge", ())]


def test_limits_read_otherwise_and_links_held_elsewhere_are_told(robot):
    assert "reads the limits" in drive(Ideal(robot, read=(0.0, 30.0)), robot).joints[0].faults[0]
    faults = drive(Ideal(robot, twist=0.1), robot).joints[0].faults
    assert any("0.1 m from where the joint should place it" in f for f in faults)


def test_a_joint_that_the_engine_does_not_know_is_told(robot):
    world = Ideal(robot)
    world.limits.pop("slide")
    world.reset()
    assert drive(world, robot).joints[0].faults == ("the engine does not know this joint",)


def test_motors_are_as_strong_as_what_they_carry_needs(robot):
    """By hand: the drawer's mass, and the door's inertia about its hinge, a plate turned about its edge."""
    slide, hinge = motors_of(robot).values()
    drawer = next(b for b in robot.links if b.name == "drawer").inertial.mass
    door = next(b for b in robot.links if b.name == "door").inertial.mass
    inertia = door * ((0.56**2 + 0.025**2) / 12 + 0.28**2 + 0.0125**2)
    assert slide.stiffness == pytest.approx(drawer * 400)
    assert hinge.stiffness == pytest.approx(inertia * 400, rel=1e-6)
    assert hinge.damping == pytest.approx(2 * np.sqrt(hinge.stiffness * inertia), rel=1e-6)
    assert (slide.effort, hinge.effort) == (50, 20)
    assert slide.seconds >= 1 > STEP


def test_a_file_that_is_no_tree_is_not_tried(tmp_path):
    with pytest.raises(InputError, match="not a tree"):
        readable(read_urdf(chest(tmp_path, ('<child link="door"', '<child link="lost"'))))
    with pytest.raises(InputError, match="not a tree"):
        readable(read_urdf(chest(tmp_path, ('axis xyz="0 0 1"', 'axis xyz="0 0 0"'))))


def test_mujoco_apart_tells_what_it_tells_here(tmp_path):
    path = chest(tmp_path)
    here, apart = sweep_in("mujoco", path), sweep_in("mujoco", path, apart=True)
    assert here.ok
    assert here == apart == from_record(asdict(here))


def test_a_file_that_cannot_be_loaded_is_one_error_from_the_other_process(tmp_path):
    path = chest(tmp_path, ("<robot", "<robert"), ("</robot", "</robert"))
    with pytest.raises(InputError, match="MuJoCo cannot load"):
        sweep_in("mujoco", path, apart=True)


def test_an_engine_that_ends_its_process_is_an_error_with_its_last_words(tmp_path):
    python = tmp_path / "python"
    python.write_text("#!/bin/sh\necho 'libgone is missing' >&2\nkill -11 $$\n")
    python.chmod(0o755)
    with pytest.raises(InputError, match=r"ended its process with code -11 on chest\.urdf: libgone"):
        sweep_in("sapien", chest(tmp_path), python=str(python))


def test_an_unknown_engine_is_an_option_error():
    with pytest.raises(OptionError, match="valid are mujoco, pybullet"):
        sweep_in("unreal", Path("a.urdf"))


@pytest.mark.parametrize("engine", OTHERS)
def test_without_an_engine_the_extra_is_named(engine, monkeypatch, tmp_path):
    library = {"drake": "pydrake.all"}.get(engine, engine)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingExtraError, match=rf"\[{engine}\]"):
        sweep_in(engine, chest(tmp_path), apart=False)


@pytest.mark.slow
@pytest.mark.parametrize("engine", OTHERS)
def test_each_engine_that_is_installed_moves_the_chest_and_sees_a_block(engine, tmp_path):
    try:
        assert sweep_in(engine, chest(tmp_path)).ok
    except MissingExtraError:
        pytest.skip(f"{engine} is not installed")
    report = sweep_in(engine, chest(tmp_path, ('lower="0" upper="0.3" effort="50"', 'lower="0" upper="0.3" effort="0.0001"')))
    assert not report.joints[0].ok
    assert report.joints[1].ok
