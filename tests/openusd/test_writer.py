"""Test what is specific to USD; poses and limits are compared in test_formats_agree.py."""

from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet, slanted, solid
from mechanical import MECHANISMS
from models import CONFIG, desk, model_of, with_meshes
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation

from anymesh.export.model import Exclusion
from anymesh.export.options import Base
from anymesh.openusd.geometry_ import welded
from anymesh.openusd.writer_ import write_usd
from anymesh.physics.substances import SUBSTANCES
from anymesh.types.mesh import to_linear


def faces_an_edge(faces: np.ndarray) -> set[int]:
    edges = np.sort(np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2), 1)
    return set(np.unique(edges, axis=0, return_counts=True)[1].tolist())


def stage_of(model, folder):
    write_usd(model, with_meshes(model, folder), CONFIG)
    return Usd.Stage.Open(str(folder / f"{model.asset.name}.usdc"))


@pytest.mark.parametrize("base", Base)
@pytest.mark.parametrize("make", [cabinet, slanted, desk, *MECHANISMS])
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


def test_a_mesh_is_called_after_its_link_and_colliders_are_hidden(tmp_path):
    stage = stage_of(model_of(cabinet()), tmp_path)
    door = stage.GetPrimAtPath("/cabinet/links/door")
    names = [child.GetName() for child in door.GetChildren()]
    assert names == ["door_visual", "door_collision_0", "door_collision_1", "door_collision_2"]
    for child in door.GetChildren():
        hidden = (
            UsdGeom.Imageable(child).ComputePurpose() == "guide" and UsdGeom.Imageable(child).ComputeVisibility() == "invisible"
        )
        assert hidden == child.HasAPI(UsdPhysics.CollisionAPI) == (child.GetName() != "door_visual")


def test_all_meshes_have_normals_flat_where_the_source_has_none(tmp_path):
    asset = cabinet()
    stage = stage_of(model_of(replace(asset, mesh=replace(asset.mesh, corner_normal=None))), tmp_path)
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert len(meshes) == 4 + 5
    for mesh in meshes:
        corners = np.array(mesh.GetPointsAttr().Get())[np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        across /= np.linalg.norm(across, axis=1, keepdims=True)
        assert mesh.GetNormalsInterpolation() == "faceVarying"
        np.testing.assert_allclose(np.array(mesh.GetNormalsAttr().Get()), np.repeat(across, 3, 0), atol=1e-5)


def test_faces_share_points_where_they_are_one_surface():
    one, beside = solid((0, 0, 0), (1, 1, 1)), solid((1, 1, 0), (2, 2, 1))  # two cubes that touch in an edge
    points, faces = welded(np.concatenate([one, beside]))
    assert (len(points), len(np.unique(points, axis=0)), faces.shape) == (16, 16, (24, 3))
    np.testing.assert_allclose(points[faces], np.concatenate([one, beside]), atol=1e-6)
    assert faces_an_edge(faces) == {2}
    assert len(welded(one)[0]) == 8
    points, faces = welded(np.concatenate([one, one[:1, ::-1]]))  # a back face is a surface of its own
    assert faces_an_edge(faces) == {1, 2}
    assert len(np.unique(points, axis=0)) == len(points)


def test_no_link_is_placed_by_whole_numbers(tmp_path):
    """Stored in bytes, they make three.js throw: findings/three-usdc-integers.sh."""
    asset = cabinet()
    joints = (replace(asset.joints[0], origin=np.array([1.0, 0.0, -2.0])), *asset.joints[1:])
    stage = stage_of(model_of(replace(asset, joints=joints)), tmp_path)
    (move,) = (op for op in UsdGeom.Xformable(stage.GetPrimAtPath("/cabinet/links/door")).GetOrderedXformOps())
    assert move.GetPrecision() == UsdGeom.XformOp.PrecisionDouble
    assert move.Get() != Gf.Vec3d(1, 0, -2)
    assert Gf.IsClose(move.Get(), Gf.Vec3d(1, 0, -2), 1e-14)


def test_a_material_takes_varying_colours_from_the_corners(tmp_path):
    asset = cabinet()
    colors = asset.mesh.corner_color.copy()
    knob = np.flatnonzero(asset.segmentation.face_part == 3)
    colors[knob[0], 0] = (200, 0, 0, 255)
    bare = replace(asset.mesh, face_material=np.full(len(colors), -1), materials=(), corner_color=colors)
    stage = stage_of(model_of(replace(asset, mesh=bare)), tmp_path)
    prim = stage.GetPrimAtPath("/cabinet/links/knob/knob_visual")
    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    color = material.ComputeSurfaceSource()[0].GetInput("diffuseColor")
    reader = UsdShade.Shader(color.GetConnectedSources()[0][0].source.GetPrim())
    assert material.GetPrim().GetName().endswith("_painted")
    assert not color.GetAttr().HasAuthoredValue()
    assert (reader.GetIdAttr().Get(), reader.GetInput("varname").Get()) == ("UsdPrimvarReader_float3", "displayColor")
    shown = UsdGeom.PrimvarsAPI(prim).GetPrimvar("displayColor")
    expected = to_linear(np.array([[10, 200, 90], [200, 0, 0]]) / 255)  # the most frequent first
    assert np.allclose(np.array(shown.Get()), expected, atol=1e-6)
    assert shown.GetIndices()[0] == 1
    assert list(shown.GetIndices()).count(0) == 3 * len(knob) - 1


def test_a_collider_of_known_substance_has_its_friction_and_restitution(tmp_path):
    model = model_of(cabinet())
    steel = SUBSTANCES["steel"]
    bodies = [replace(b, surfaces=(steel,) * len(b.shapes)) if b.name == "door" else b for b in model.bodies]
    stage = stage_of(replace(model, bodies=tuple(bodies)), tmp_path)
    for link in ("door", "drawer"):
        prim = stage.GetPrimAtPath(f"/cabinet/links/{link}/{link}_collision_0")
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
        assert bool(material) == (link == "door")
        if material:
            surface = UsdPhysics.MaterialAPI(material)
            reads = surface.GetStaticFrictionAttr(), surface.GetDynamicFrictionAttr(), surface.GetRestitutionAttr()
            said = [attribute.Get() for attribute in reads]
            assert np.allclose(said, [steel.static_friction, steel.dynamic_friction, steel.restitution])
