"""How joints answer a hand in MuJoCo: the pull that starts them, a slope of one degree, and what happens after a push."""

import json

import numpy as np
import pytest
import trimesh
from assets import box, cabinet, joint, mesh_of, source

from anymesh.checking.engines.robot import read_urdf
from anymesh.export import Base, ExportOptions, Format, write_asset
from anymesh.types import Asset, Part, Segmentation
from benchmarks.behaviour import agree, free_roll, inside
from benchmarks.behaviour_engines import Hand, _swing, rolls, starts


@pytest.fixture(scope="module")
def hand(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cabinet")
    write_asset(cabinet(), folder)
    record = json.loads((folder / "asset.json").read_text())
    joints = [j | {"opened": []} for j in record["joints"] if j["type"] != "fixed"]
    return Hand("mujoco", folder, read_urdf(folder / f"{record['name']}.urdf"), joints)


def test_joints_begin_to_move_at_the_pull_that_the_asset_states(hand):
    for stated in hand.joints.values():
        got = hand.begins(stated)
        assert inside(starts(stated), got), (stated["name"], stated["pull"], got)
        assert got["begins"] == pytest.approx(starts(stated)["typical"], rel=0.1)


def test_joints_stay_closed_at_a_slope_of_one_degree(hand):
    assert max(hand.tilted().values()) < 1


def test_nothing_swings_two_seconds_after_a_push(hand):
    for stated in hand.joints.values():
        got = hand.settles(stated)
        assert abs(got["ends"]) > 0
        assert got["swing"] < 1


def test_a_swing_goes_forth_and_back_and_engines_agree_within_a_tenth():
    assert _swing(np.array([0.0, 0.2, 0.5, 0.5])) == 0
    assert _swing(np.array([0.0, 0.2, 0.1, 0.3])) == pytest.approx(0.1)
    first, near, far = ({"begins": v, "bound": ""} for v in (1.0, 1.09, 1.2))
    assert agree([first, near])
    assert not agree([first, far])
    assert not agree([first, {"begins": 1.0, "bound": "above"}])


def test_a_toy_car_rolls_down_a_slope_almost_as_far_as_without_friction(tmp_path):
    wheel = trimesh.creation.cylinder(
        0.03, 0.02, sections=24, transform=trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0))
    )
    places = [(x, y, 0.03) for x in (-0.08, 0.08) for y in (-0.06, 0.06)]
    pieces = [box((-0.12, -0.04, 0.03), (0.12, 0.04, 0.08)), *((wheel.vertices + at, wheel.faces) for at in places)]
    mesh, part = mesh_of(pieces)
    names = ("body", *(f"wheel_{k}" for k in range(4)))
    parts = tuple(Part(name, name.split("_")[0] if k else "base") for k, name in enumerate(names))
    joints = tuple(
        joint(f"{n}_joint", "continuous", "body", n, at, (0, 1, 0), None) for n, at in zip(names[1:], places, strict=True)
    )
    asset = Asset("toy_car", source(), mesh, Segmentation(part, parts), joints, "")
    model = write_asset(asset, tmp_path, ExportOptions(Base.FREE, (Format.URDF, Format.MJCF)))
    down, free = free_roll(asset, model)
    got = rolls("mujoco", {"folder": str(tmp_path), "down": down.tolist(), "ground": 0.0})
    assert got["rolled"] == pytest.approx(got["loose"], rel=0.1)
    assert 0.75 * free < got["rolled"] < 1.05 * free  # contacts of the wheels take some
