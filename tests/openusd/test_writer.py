"""Test what is specific to USD; poses and limits are compared in test_formats_agree.py."""

from dataclasses import replace

import pytest
from assets import cabinet, slanted
from models import CONFIG, desk, model_of, with_meshes
from pxr import Usd, UsdPhysics, UsdValidation

from anymesh.export.model import Exclusion
from anymesh.export.options import Base
from anymesh.openusd.writer_ import write_usd


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
