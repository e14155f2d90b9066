"""A push without motors, read from positions, and the damping that a light link can bear."""

import mujoco
import numpy as np
import pytest

from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.checking.engines.pushing import STEP, MujocoPassive, Resisting, push_faults
from anymesh.checking.engines.robot import read_urdf
from anymesh.checking.joints import check_damping, check_motion

KNOB = """<robot name="knob"><link name="base"/><link name="knob"><inertial><mass value=".014"/>
<inertia ixx="3e-6" iyy="3e-6" izz="3e-6" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="turn" type="continuous">
<parent link="base"/><child link="knob"/><axis xyz="0 0 1"/><limit effort="1" velocity="20"/>
<dynamics damping="%s"/></joint></robot>
"""


class Explicit:
    """A knob in an engine that applies damping explicitly; it keeps its velocity and not its position if `stuck`."""

    def __init__(self, damping: float, stuck: bool) -> None:
        self.damping, self.stuck = damping, stuck

    def reset(self, positions: np.ndarray) -> None:
        self.at, self.speed = positions.copy(), 1e-3

    def push(self, forces: np.ndarray) -> None:
        self.speed = float(np.clip(self.speed + STEP * (forces[0] - self.damping * self.speed) / 3e-6, -100, 100))
        self.at = self.at + (0 if self.stuck else STEP * self.speed)

    def positions(self) -> np.ndarray:
        return self.at


@pytest.mark.parametrize(
    ("damping", "stuck", "words"),
    [
        (1e-5, False, None),
        (1e-5, True, "moves it by 0 instead of 1.57, read from its position"),
        (0.1, False, "it shakes by 0.5"),
    ],
)
def test_a_push_without_motors_is_read_from_positions(damping, stuck, words):
    resisting = Resisting(3e-6, 0.0, damping, 1.0)
    faults = push_faults(Explicit(damping, stuck), 0, resisting, (-np.pi, np.pi), 1.0, np.zeros(1))
    assert (not faults) if words is None else any(words in fault for fault in faults), faults


def test_a_push_goes_as_far_as_friction_damping_and_springs_let_it():
    assert Resisting(2.0, 1.0, 0.0, 9.0).reached(3.0, 9.0, 1.0) == pytest.approx(0.5, rel=0.01)  # (3 - 1) / 2 / 2
    assert Resisting(1e-4, 1.0, 4.0, 9.0).reached(3.0, 9.0, 2.0) == pytest.approx(1, rel=0.01)  # (3 - 1) / 4 * 2
    assert Resisting(1.0, 4.0, 0.0, 9.0).reached(3.0, 9.0, 2.0) == 0
    assert Resisting(1e-3, 0.0, 1.0, 9.0, stiffness=4.0, relaxed=-0.25).reached(3.0, 9.0, 9.0) == pytest.approx(0.5, rel=0.01)
    assert Resisting(1.0, 4.0, 0.0, 9.0).force(0.1, 1.0) == pytest.approx(1.5 * 4.2)
    assert Resisting(1.0, 40.0, 0.0, 9.0).force(0.1, 1.0) == 9


def test_damping_that_a_light_link_cannot_bear_is_a_warning_with_the_largest_that_it_can(tmp_path):
    (tmp_path / "knob.urdf").write_text(KNOB % 0.1)
    (warned,) = check_damping(read_urdf(tmp_path / "knob.urdf"))
    assert (warned.severity, warned.subject) == ("warning", "turn")
    assert "at most 0.00018 N m s/rad" in warned.text
    (tmp_path / "knob.urdf").write_text(KNOB % 0.00017)
    assert not [*check_damping(read_urdf(tmp_path / "knob.urdf"))]
    assert sweep_joints(tmp_path / "knob.urdf", steps=20).ok


PINCHED = """<mujoco><worldbody><body name="rails"><geom type="box" pos="0 0 -.03" size=".5 .1 .01" friction="9"/>
<geom type="box" pos="0 0 .02999" size=".5 .1 .01" friction="9"/></body><body name="block" pos="-.3 0 0">
<joint name="slide" type="slide" axis="1 0 0" range="0 .6"/><geom type="box" size=".05 .05 .02" friction="9" mass="1"/></body>
</worldbody></mujoco>"""
FOLDED = """<mujoco><compiler angle="radian"/><worldbody><body><joint name="turn" axis="0 0 1" range="0 3"/>
<geom type="capsule" fromto="0 0 0 0 0 .2" size=".01"/><body pos="0 0 .2"><joint name="bend" axis="0 1 0" range="1 2"/>
<geom type="capsule" fromto="0 0 .02 0 0 .3" size=".01"/></body></body></worldbody></mujoco>"""


def test_contacts_that_hold_a_joint_fail_our_own_files_alone(tmp_path):
    path = tmp_path / "pinched.xml"
    path.write_text(PINCHED)
    for ours, severity in ((True, "failure"), (False, "warning")):
        (found,) = check_motion(path, "mujoco", ours=ours)[0]
        assert (found.severity, found.subject) == (severity, "slide")
        assert "contacts of its link are the cause" in found.text


def test_a_push_meets_the_inertia_of_its_start_and_moves_no_other_joint():
    model = mujoco.MjModel.from_xml_string(FOLDED)  # stretched along its axis at 0
    world = MujocoPassive(mujoco, model)
    assert world.resisting(0, 1.0, np.array([0.0, 1.0])).inertia > 50 * model.dof_M0[0]
    world.push(np.array([0.01, 0.0]))
    assert world.positions()[0] > 0
    assert world.positions()[1] == 1
