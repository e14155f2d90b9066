"""Test surfaces: what links are made of, in each format, and a block that slides where the file's friction says."""

from dataclasses import replace
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest
from assets import box, mesh_of
from chests import SLIPS, TILTS, chest, slides
from models import CONFIG, with_meshes
from pxr import Usd, UsdPhysics, UsdShade

from anymesh.export.asset_json import asset_record
from anymesh.export.glb import GlbBuffer
from anymesh.export.model import build_model
from anymesh.export.notation import DRAKE
from anymesh.export.options import ExportOptions
from anymesh.formats.gltf.joints import KHR
from anymesh.formats.gltf.physics import add_physics
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.formats.robot.sdf import sdf_text
from anymesh.formats.robot.urdf import urdf_text
from anymesh.openusd.writer_ import write_usd
from anymesh.physics.substances import SUBSTANCES
from anymesh.types import Material, Part, Segmentation


def built(asset):
    return build_model(asset, ExportOptions(), config=CONFIG, cache=None)


def mixed():
    """Return a chest whose lid is an oak board with a steel handle."""
    asset = chest("oak")
    handle = box((-0.05, 0.02, 0.2), (0.05, 0.03, 0.24))
    pieces = [(asset.mesh.vertices[:8], asset.mesh.faces[:12]), (asset.mesh.vertices[8:], asset.mesh.faces[:12]), handle]
    mesh, number = mesh_of(pieces, np.repeat([0, 1, 2], 12), materials=(*asset.mesh.materials, Material("brushed steel")))
    return replace(asset, mesh=mesh, segmentation=Segmentation(np.minimum(number, 1), asset.segmentation.parts))


@pytest.mark.parametrize("material", SLIPS)
def test_a_block_on_the_lid_slides_where_the_friction_of_the_file_says(material, tmp_path):
    model = built(chest(material))
    write_mjcf(model, with_meshes(model, tmp_path), CONFIG)
    spec = mujoco.MjSpec.from_file(str(tmp_path / "thing.xml"))
    written = float(spec.geom("lid_collision_0").friction[0])
    assert written == SUBSTANCES[material].dynamic_friction
    block = spec.worldbody.add_body(name="block", pos=(0, 0, 0.22))
    block.add_freejoint(name="block")
    block.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.04, 0.04, 0.02), mass=0.3, friction=(written, 0.005, 0.0001))
    world = spec.compile()

    def travel(tilt):
        data = mujoco.MjData(world)
        for angle, steps in ((0.0, 100), (tilt, 500)):
            world.opt.gravity[:] = 9.81 * np.array([np.sin(angle), 0, -np.cos(angle)])
            start = data.joint("block").qpos[0]
            for _ in range(steps):
                mujoco.mj_step(world, data)
        return data.joint("block").qpos[0] - start

    assert [slides(travel(np.arctan(written) + tilt)) for tilt in TILTS] == [False, True]


def test_each_shape_has_the_friction_of_the_material_that_is_nearest():
    lid = built(mixed()).bodies[1]
    assert [share.substance.name for share in lid.substances] == ["oak", "steel"]
    tall = [shape.size.min() < 0.011 for shape in lid.shapes]
    assert sorted(tall) == [False, True]
    assert [s.name for s in lid.surfaces] == ["steel" if t else "oak" for t in tall]


def test_urdf_and_sdf_state_friction_and_restitution():
    model = built(mixed())
    root = ElementTree.fromstring(urdf_text(model).encode())
    lid = next(e for e in root.iter("link") if e.get("name") == "lid")
    drake = [[v.get("value") for v in e] for e in lid.iter(f"{DRAKE}proximity_properties")]
    assert sorted(drake) == [["0.4", "0.32"], ["0.74", "0.57"]]
    assert lid.find("contact/lateral_friction").get("value") == "0.32"
    gazebo = next(e for e in root.iter("gazebo") if e.get("reference") == "lid")
    assert (gazebo.findtext("mu1"), gazebo.findtext("mu2")) == ("0.32", "0.32")
    found = ElementTree.fromstring(sdf_text(model).encode())
    mu = [e.findtext("friction/ode/mu") for e in found.iter("surface")]
    assert sorted(mu) == ["0.32", "0.57"]
    assert {e.findtext("bounce/restitution_coefficient") for e in found.iter("surface")} == {"0.6"}


def test_usd_binds_physics_materials_to_colliders(tmp_path):
    write_usd(built(mixed()), tmp_path, CONFIG)
    stage = Usd.Stage.Open(str(tmp_path / "thing.usdc"))
    bound = {}
    for prim in stage.Traverse():
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            surface, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
            bound[prim.GetName()] = UsdPhysics.MaterialAPI(surface.GetPrim()) if surface else None
    values = [(s.GetStaticFrictionAttr(), s.GetDynamicFrictionAttr(), s.GetDensityAttr()) for s in bound.values() if s]
    assert sorted(tuple(round(a.Get(), 3) for a in row) for row in values) == [(0.4, 0.32, 720), (0.74, 0.57, 7850)]
    assert bound["base_collision_0"] is None


def test_glb_has_physics_materials():
    document, buffer = {"nodes": [{"name": n} for n in ("up", "base", "lid")], "meshes": [], "scenes": []}, GlbBuffer()
    add_physics(built(mixed()), document, buffer)
    assert {m["dynamicFriction"] for m in document["extensions"][KHR]["physicsMaterials"]} == {0.32, 0.57}
    own = [node.get("extensions", {}).get(KHR, {}) for node in document["nodes"]]
    assert sorted(k["collider"].get("physicsMaterial", -1) for k in own if "collider" in k) == [-1, 0, 1]


def test_what_is_not_known_keeps_the_defaults_of_the_engines():
    model = built(chest("Material.001"))
    assert not any(any(body.surfaces) for body in model.bodies)
    assert "mu" not in {e.tag for e in ElementTree.fromstring(sdf_text(model).encode()).iter()}
    record = asset_record(model)
    assert record["parts"][0]["substances"] == [{"name": None, "source": "default", "share": 1.0}]


def test_the_record_states_substances_and_a_range_that_holds_the_mass():
    record = asset_record(built(replace(mixed(), name="cupboard")))
    stated = [[(s["name"], s["source"]) for s in p["substances"]] for p in record["parts"]]
    assert stated == [[("wood", "kind")], [("oak", "material"), ("steel", "material")]]
    for part in (*record["parts"], record):
        assert part["mass_range"][0] < part["mass"] < part["mass_range"][1]
    assert record["mass"] == pytest.approx(sum(p["mass"] for p in record["parts"]))


def test_a_part_named_after_what_it_is_made_of():
    asset = replace(chest("paint"), name="fridge")
    parts = (Part("base", "base"), Part("dial", "knob"))
    joints = (replace(asset.joints[0], child="dial"),)
    model = built(replace(asset, segmentation=replace(asset.segmentation, parts=parts), joints=joints))
    assert [body.substances[0].substance.name for body in model.bodies] == ["sheet_steel", "plastic"]
