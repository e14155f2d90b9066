"""What follows what: a four-bar lid, a scissor lift and doors on one lever, by known formulas."""

from dataclasses import replace

import numpy as np
import pytest
from assets import joint
from mechanical import ACROSS, UP, asset_of, doors, linkage

from anymesh.geometry.kinematics import link_transforms
from anymesh.mechanisms.following import follower_tables, followers, leading, together
from anymesh.rendering.preview import opened_positions
from anymesh.types import Loop

WIDE, RISE = 0.4, 0.12  # of a stage of the scissor [m]


def scissor(stages: int = 2):
    """Crossed bars on a base: one foot is pinned, the other slides; the table is pinned above one and slides on the other."""
    pieces, joints, loops = {"base": ((-0.1, -0.1, -0.06), (0.6, 0.1, -0.02))}, [], []
    for k in range(stages):
        z = k * RISE
        pieces |= {f"a{k}": ((0, 0, z), (WIDE, 0.02, z + RISE)), f"b{k}": ((0, 0.02, z), (WIDE, 0.04, z + RISE))}
        under = f"b{k - 1}" if k else "base"
        joints += [joint(f"lift{k}", "revolute", under, f"a{k}", (0, 0.02, z), -ACROSS, (-0.2, 0.5) if k == 0 else (-1.0, 1.5))]
        joints += [joint(f"pin{k}", "revolute", f"a{k}", f"b{k}", (WIDE / 2, 0.02, z + RISE / 2), ACROSS, (-1.0, 1.5))]
        loops += [Loop(f"side{k}", f"a{k - 1}", f"b{k}", np.array([WIDE, 0.02, z]), ACROSS)] if k else []
    top = stages * RISE
    pieces |= {"foot": ((0.37, -0.04, -0.02), (0.43, 0, 0.01)), "table": ((-0.05, -0.1, top + 0.01), (0.45, 0.1, top + 0.03))}
    pieces |= {"shoe": ((0.37, -0.04, top - 0.01), (0.43, 0, top + 0.01))}
    joints += [joint("slide", "prismatic", "base", "foot", (WIDE, 0.02, 0), (1, 0, 0), (-0.3, 0.3))]
    joints += [joint("hold", "revolute", f"b{stages - 1}", "table", (0, 0.02, top), ACROSS, (-1.0, 1.0))]
    joints += [joint("shift", "prismatic", "table", "shoe", (WIDE, 0.02, top), (1, 0, 0), (-0.3, 0.3))]
    loops += [Loop("foot_pin", "foot", "b0", np.array([WIDE, 0.02, 0]), ACROSS)]
    loops += [Loop("shoe_pin", "shoe", f"a{stages - 1}", np.array([WIDE, 0.02, top]), ACROSS)]
    return asset_of("scissor", pieces, joints, loops)


@pytest.mark.parametrize("stages", [1, 2])
def test_a_scissor_has_one_freedom_and_its_table_stays_level(stages):
    asset = scissor(stages)
    assert leading(asset) == ("lift0",)
    assert len(followers(asset)) == len(asset.joints) - 1
    angle, length = np.arctan2(RISE, WIDE), np.hypot(RISE, WIDE)
    for turn in (-0.2, 0.4):
        at = together(asset, {"lift0": turn, "slide": 9.0})  # what loops place is not asked
        assert at["slide"] == pytest.approx(length * np.cos(angle + turn) - WIDE, abs=1e-7)
        table = link_transforms(asset, at)["table"]
        assert table[2, 3] == pytest.approx(stages * (length * np.sin(angle + turn) - RISE), abs=1e-7)
        np.testing.assert_allclose(table[:3, :3], np.eye(3), atol=1e-7)


def test_tables_follow_the_leader_and_stop_where_a_loop_cannot_close():
    asset = linkage()
    tables = follower_tables(asset)
    amounts = np.linspace(-0.6, 0.6, len(tables["rocker_joint"][1]))
    assert {name: leader for name, (leader, _) in tables.items()} == dict.fromkeys(
        ("rocker_joint", "coupler_joint"), "crank_joint"
    )
    np.testing.assert_allclose(tables["rocker_joint"][1], amounts, atol=1e-7)
    np.testing.assert_allclose(tables["coupler_joint"][1], -amounts, atol=1e-7)
    joints = (asset.joints[0], replace(asset.joints[1], origin=np.array([0.5, 0, 0.25])), asset.joints[2])  # a short rocker
    short = follower_tables(replace(asset, joints=joints))["rocker_joint"][1]
    assert np.ptp(short[:8]) < 1e-9  # it hangs where it was last


def test_chains_of_mimics_have_one_leader():
    tables = follower_tables(doors())
    assert {name: leader for name, (leader, _) in tables.items()} == {"twin": "hinge", "second": "first", "third": "first"}
    np.testing.assert_allclose(tables["third"][1], np.linspace(0, 0.2, len(tables["third"][1])), atol=1e-12)
    assert followers(doors()) == {"twin", "second", "third"}
    assert UP @ ACROSS == 0


def test_the_preview_shows_loops_closed():
    at = opened_positions(linkage())
    assert at["rocker_joint"] == pytest.approx(at["crank_joint"], abs=1e-7)
    assert at["coupler_joint"] == pytest.approx(-at["crank_joint"], abs=1e-7)
