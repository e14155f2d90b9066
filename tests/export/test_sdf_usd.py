"""Test what is specific to SDFormat; poses and limits are compared in test_formats_agree.py."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from assets import cabinet, slanted
from models import CONFIG, desk, model_of, with_meshes
from pxr import Usd, UsdPhysics, UsdValidation

from anymesh.export.model import Base, Exclusion
from anymesh.export.sdf import joint_names, sdf_text, write_sdf
from anymesh.export.usd_ import write_usd


def parsed(model) -> ElementTree.Element:
    found = ElementTree.fromstring(sdf_text(model)).find("model")
    assert found is not None
    return found


def test_gazebo_finds_the_model_and_its_meshes(tmp_path):
    model = model_of(cabinet())
    write_sdf(model, with_meshes(model, tmp_path), CONFIG)
    config = ElementTree.parse(tmp_path / "model.config").getroot()
    assert config.findtext("name") == "cabinet"
    file = ElementTree.parse(tmp_path / str(config.findtext("sdf"))).getroot()
    assert config.find("sdf").get("version") == file.get("version")
    uris = [str(u.text) for u in file.iter("uri")]
    assert len(uris) == len(set(uris)) == 9
    assert all((tmp_path / uri).is_file() for uri in uris)


def test_names_are_unique_among_links_and_joints_together():
    model = model_of(desk())  # its joints lid and tray have the names of links
    root = parsed(model)
    names = [e.get("name") for e in [*root.findall("link"), *root.findall("joint")]]
    assert len(names) == len(set(names))
    assert dict(joint_names(model)) == {
        "lid": "lid_2",
        "tray": "tray_2",
        "turn": "turn",
        "stop_joint": "stop_joint",
        "push": "push",
    }


@pytest.mark.parametrize("base", Base)
def test_no_model_is_static(base):
    root = parsed(model_of(cabinet(), base=base))
    assert root.find("static") is None  # it would also fix the joints
    assert len(root.findall("joint")) == 3 + (base is Base.FIXED)


@pytest.mark.parametrize(
    ("pairs", "collides"),
    [((), "true"), ((("base", "door"),), "true"), ((("base", "door"), ("door", "drawer")), "false")],
)
def test_links_that_no_joint_connects_collide_unless_such_a_pair_is_excluded(pairs, collides):
    exclusions = tuple(Exclusion(a, b, "close") for a, b in pairs)
    assert parsed(model_of(cabinet(), exclusions=exclusions)).findtext("self_collide") == collides


def test_colours_are_written_where_the_obj_has_no_material():
    asset = cabinet()
    knob = asset.segmentation.face_part == [p.name for p in asset.segmentation.parts].index("knob")
    mesh = replace(asset.mesh, face_material=np.where(knob, -1, asset.mesh.face_material))
    root = parsed(model_of(replace(asset, mesh=mesh)))
    colored = {str(link.get("name")): link.findtext("visual/material/diffuse") for link in root.findall("link")}
    assert colored == {"base": None, "door": None, "drawer": None, "knob": "0.0392157 0.784314 0.352941 1"}


def stage_of(model, folder):
    write_usd(model, with_meshes(model, folder), CONFIG)
    return Usd.Stage.Open(str(folder / f"{model.asset.name}.usdc"))


@pytest.mark.parametrize("base", Base)
@pytest.mark.parametrize("make", [cabinet, slanted, desk])
def test_all_validators_of_openusd_pass(make, base, tmp_path):
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert any("ArticulationChecker" in v.GetMetadata().name for v in validators)
    stage = stage_of(model_of(make(), base=base), tmp_path)
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [(e.GetName(), e.GetMessage()) for e in found] == []


def test_the_validators_see_a_fault(tmp_path):
    stage = stage_of(model_of(cabinet()), tmp_path)
    UsdPhysics.Joint(stage.GetPrimAtPath("/cabinet/joints/hinge")).GetBody1Rel().SetTargets(["/cabinet/links/missing"])
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert UsdValidation.ValidationContext(validators).Validate(stage)


def test_exclusions_filter_pairs_and_only_them(tmp_path):
    exclusions = (Exclusion("base", "door", "a shared wall"), Exclusion("base", "knob", "close"))
    stage = stage_of(model_of(cabinet(), exclusions=exclusions), tmp_path)
    filtered = UsdPhysics.FilteredPairsAPI(stage.GetPrimAtPath("/cabinet/links/base")).GetFilteredPairsRel()
    assert [t.name for t in filtered.GetTargets()] == ["door", "knob"]
    collides = {
        name: UsdPhysics.Joint(stage.GetPrimAtPath(f"/cabinet/joints/{name}")).GetCollisionEnabledAttr().Get()
        for name in ("hinge", "slide", "turn")
    }
    assert collides == {"hinge": False, "slide": True, "turn": True}


def test_one_articulation_and_no_scene_in_what_others_refer_to(tmp_path):
    asset = replace(cabinet(), name="physics_scene")  # the name of the scene beside it
    stage = stage_of(model_of(asset), tmp_path)
    root = stage.GetDefaultPrim()
    assert root.GetName() == "physics_scene"
    assert [p.GetPath() for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI)] == [root.GetPath()]
    assert not [p for p in Usd.PrimRange(root) if p.IsA(UsdPhysics.Scene)]
    assert [p for p in stage.Traverse() if p.IsA(UsdPhysics.Scene)]


def test_bodies_are_not_nested(tmp_path):
    stage = stage_of(model_of(slanted()), tmp_path)
    for prim in stage.Traverse():
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            inside = [p for p in Usd.PrimRange(prim) if p != prim and p.HasAPI(UsdPhysics.RigidBodyAPI)]
            assert not inside
