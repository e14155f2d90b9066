"""Loops stay closed: a four-bar linkage, one with balls, and a scissor by known formulas."""

from dataclasses import replace

import numpy as np
import pytest
from mechanical import ACROSS, UP, asset_of, doors, linkage

from anymesh.geometry.kinematics import link_transforms
from anymesh.mechanisms.closing import closed, closed_over, loop_gap
from anymesh.types import JointType, Loop


@pytest.mark.parametrize("kind", [JointType.REVOLUTE, JointType.BALL])
@pytest.mark.parametrize("angle", [0.6, -0.6, 1.4])
def test_a_parallelogram_stays_one(angle, kind):
    asset = replace(linkage(), loops=(replace(linkage().loops[0], kind=kind),))
    at = closed(asset, {"crank_joint": angle})
    assert at == pytest.approx({"crank_joint": angle, "rocker_joint": angle, "coupler_joint": -angle}, abs=1e-9)
    assert loop_gap(asset, link_transforms(asset, at)) < 1e-12
    assert loop_gap(asset, link_transforms(asset, {"crank_joint": angle})) > 0.1


def test_positions_on_a_way_are_those_from_rest():
    asset, amounts = linkage(), [-0.5, 0.0, 0.3, 0.6]
    for amount, at in zip(amounts, closed_over(asset, "crank_joint", amounts), strict=True):
        assert at == pytest.approx(closed(asset, {"crank_joint": amount}), abs=1e-9)


def test_a_slider_crank_follows_its_formula():
    """A crank of .1 and a rod of .3 that push a block along x."""
    pieces = {
        "base": ((0, 0, 0), (0.6, 0.02, 0.02)),
        "crank": ((0, 0.03, 0.04), (0.1, 0.04, 0.05)),
        "rod": ((0.1, 0.05, 0.04), (0.4, 0.06, 0.05)),
        "block": ((0.38, 0.07, 0.04), (0.42, 0.08, 0.05)),
    }
    joints = linkage().joints
    joints = (
        replace(joints[0], child="crank", origin=np.array([0, 0, 0.045])),
        replace(joints[2], name="rod_joint", child="rod", origin=np.array([0.1, 0, 0.045])),
        replace(joints[1], name="slide", type=JointType.PRISMATIC, child="block", axis=np.array([1.0, 0, 0])),
    )
    asset = asset_of("engine", pieces, joints, [Loop("pin", "rod", "block", np.array([0.4, 0, 0.045]), ACROSS)])
    for angle in (0.5, 2.0, 3.0):
        slide = 0.1 * np.cos(angle) + np.sqrt(0.09 - (0.1 * np.sin(angle)) ** 2) - 0.4
        assert closed(asset, {"crank_joint": angle})["slide"] == pytest.approx(slide, abs=1e-9)


def test_where_no_pose_closes_it_the_gap_tells():
    asset = replace(linkage(), joints=(*linkage().joints[:2], replace(linkage().joints[2], type=JointType.FIXED, limits=None)))
    at = closed(asset, {"crank_joint": 0.5})
    assert loop_gap(asset, link_transforms(asset, at)) > 0.01
    assert closed(doors(), {"hinge": 0.5}) == {"hinge": 0.5}
    assert UP @ ACROSS == 0
