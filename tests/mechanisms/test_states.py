"""Closed, half and open: which joints take part, where they are, and what MJCF, USD and asset.json say of it."""

import json
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from assets import box, joint, mesh_of, source
from models import CONFIG, model_of, with_meshes
from pxr import Usd, UsdGeom

from anymesh.export.asset_json import asset_record, json_text
from anymesh.export.formats import write_formats
from anymesh.export.options import Base, Format
from anymesh.geometry.kinematics import link_transforms
from anymesh.mechanisms.states import named_states
from anymesh.physics.mechanism import Mechanism, MechanismKind
from anymesh.types import Asset, Box, JointType, Loop, Part, Segmentation

CASE = box((0.0, 0.0, 0.0), (0.4, 0.3, 0.6))
DOOR = box((0.0, -0.022, 0.0), (0.4, -0.002, 0.6))
KNOB = box((0.44, 0.1, 0.5), (0.46, 0.12, 0.52))
BESIDE = box((0.402, 0.01, 0.1), (0.7, 0.29, 0.4))
HINGE = joint("hinge", "revolute", "case", "door", (0, 0, 0.3), (0, 0, -1), (0.0, 1.9))
TURN = joint("turn", "revolute", "case", "knob", (0.45, 0.1, 0.51), (0, 1, 0), (0.0, 3.0))


def asset_of(*parts: tuple[str, tuple], joints: tuple) -> Asset:
    mesh, part_of = mesh_of([piece for _, piece in parts])
    return Asset("thing", source(), mesh, Segmentation(part_of, tuple(Part(n, n) for n, _ in parts)), joints, "test")


def states(asset: Asset) -> dict:
    """Return the states; each part is the box around it, for collisions."""
    found = {}
    origins = {j.child: j.origin for j in asset.joints}
    for k, part in enumerate(asset.segmentation.parts):
        corners = asset.mesh.triangles[asset.segmentation.faces(k)].reshape(-1, 3) - origins.get(part.name, 0.0)
        low, high = corners.min(0), corners.max(0)
        found[part.name] = (Box((low + high) / 2, np.eye(3), high - low),)
    return named_states(asset, found)


def test_a_door_opens_and_a_knob_stays():
    asset = asset_of(("case", CASE), ("door", DOOR), ("knob", KNOB), joints=(HINGE, TURN))
    assert states(asset) == {"closed": {"hinge": 0.0}, "half": {"hinge": 0.95}, "open": {"hinge": 1.9}}


def test_without_a_door_every_joint_with_limits_takes_part():
    endless = joint("spin", "continuous", "case", "wheel", (0.45, 0.1, 0.51), (0, 1, 0), None)
    assert states(asset_of(("case", CASE), ("knob", KNOB), joints=(TURN,)))["open"] == {"turn": 3.0}
    assert states(asset_of(("case", CASE), ("wheel", KNOB), joints=(endless,))) == {}


def test_a_drawer_that_is_modelled_open_is_closed_at_its_lower_limit():
    drawn, inside = (
        box((0.05, -0.2, 0.1), (0.35, 0.05, 0.3)),
        joint("slide", "prismatic", "case", "drawer", (0, 0, 0), (0, -1, 0), (-0.2, 0.1)),
    )
    assert states(asset_of(("case", CASE), ("drawer", drawn), joints=(inside,)))["closed"] == {"slide": -0.2}


def test_what_a_loop_holds_fast_stays_at_rest():
    slide = joint("slide", "prismatic", "case", "drawer", (0.55, 0.15, 0.25), (0, -1, 0), (0.0, 0.25))
    asset = asset_of(("case", CASE), ("door", DOOR), ("drawer", BESIDE), joints=(HINGE, slide))
    assert states(asset)["open"] == {"hinge": 1.9, "slide": 0.25}
    held = Loop("pin", "door", "case", np.array([0.2, 0.0, 0.3]), np.array([0.0, 0, 1]), JointType.BALL)
    assert states(replace(asset, loops=(held,)))["open"] == {"slide": 0.25}


def test_what_swings_both_ways_is_closed_in_the_middle():
    both = joint("hinge", "revolute", "case", "door", (0.0, -0.012, 0.3), (0, 0, -1), (-1.5, 1.5))
    assert states(asset_of(("case", box((0.0, -0.3, -0.1), (0.4, 0.276, 0.0))), ("door", DOOR), joints=(both,)))["closed"] == {
        "hinge": 0.0
    }


def test_a_drawer_behind_a_half_open_door_comes_as_far_as_the_door():
    behind, slide = (
        box((0.05, 0.0, 0.2), (0.39, 0.25, 0.4)),
        joint("slide", "prismatic", "case", "drawer", (0, 0, 0), (0, -1, 0), (0.0, 0.25)),
    )
    asset = asset_of(
        ("case", box((0.0, 0.26, 0.0), (0.4, 0.3, 0.6))), ("door", DOOR), ("drawer", behind), joints=(HINGE, slide)
    )
    found = states(asset)
    assert found["half"]["hinge"] == pytest.approx(0.95)
    assert 0.0 < found["half"]["slide"] < 0.125
    assert found["open"] == {"hinge": 1.9, "slide": 0.25}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("states")
    asset = asset_of(("case", CASE), ("door", DOOR), ("knob", KNOB), joints=(HINGE, TURN))
    latch = Mechanism(MechanismKind.LATCH, 1.0, "for the test", 9.0, least=-9.0, slope=-90.0)
    model = replace(model_of(asset, base=Base.FREE), states=states(asset), mechanisms={"hinge": latch})
    write_formats(model, with_meshes(model, folder), (Format.MJCF, Format.USD), CONFIG)
    (folder / "asset.json").write_text(json_text(asset_record(model)))
    return folder, asset


def test_a_keyframe_holds_each_state_of_a_free_asset(written):
    folder, _ = written
    model = mujoco.MjModel.from_xml_path(str(folder / "thing.xml"))
    assert [model.key(k).name for k in range(model.nkey)] == ["closed", "half", "open"]
    key = model.key("open")
    assert key.qpos.tolist() == [0, 0, 0, 1, 0, 0, 0, 1.9, 0]
    assert {model.actuator(k).name: key.ctrl[k] for k in range(model.nu)} == {"hinge": 1.9, "turn": 0.0, "hinge_latch": 0.0}
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 2)
    mujoco.mj_forward(model, data)
    assert not data.ncon


def test_keyframes_survive_being_attached_beside_something_free(written):
    world = mujoco.MjSpec()
    world.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    ball = world.worldbody.add_body(pos=[0, 0, 2])
    ball.add_freejoint()
    ball.add_geom(size=[0.1, 0, 0])
    for side in "ab":
        thing = mujoco.MjSpec.from_file(str(written[0] / "thing.xml"))
        world.attach(thing, prefix=side, frame=world.worldbody.add_frame())
    model = world.compile()
    assert model.key("bopen").qpos[model.joint("bhinge").qposadr[0]] == 1.9
    assert model.key("bopen").qpos[model.joint("ahinge").qposadr[0]] == 0.0


def test_usd_has_a_variant_for_each_state(written):
    folder, asset = written
    stage = Usd.Stage.Open(str(folder / "thing.usdc"))
    variants = stage.GetDefaultPrim().GetVariantSet("state")
    assert (variants.GetVariantNames(), variants.GetVariantSelection()) == (["closed", "half", "open"], "closed")
    for name, at in json.loads((folder / "asset.json").read_text())["states"].items():
        variants.SetVariantSelection(name)
        T = link_transforms(asset, at)["door"]
        T = T @ np.block([[np.eye(3), HINGE.origin[:, None]], [0, 0, 0, 1]])
        held = UsdGeom.Xformable(stage.GetPrimAtPath("/thing/links/door")).GetLocalTransformation()
        assert np.allclose(np.array(held).T, T, atol=1e-6)
        position = stage.GetPrimAtPath("/thing/joints/hinge").GetAttribute("state:angular:physics:position")
        assert (position.Get() or 0.0) == pytest.approx(np.degrees(at["hinge"]))
