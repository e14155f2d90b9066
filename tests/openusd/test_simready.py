"""Test the asset in the form of SimReady by what its rules ask for; benchmarks.robotics_prop.py runs the rules themselves."""

import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet, solid
from models import CONFIG, desk, model_of, with_meshes
from PIL import Image
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation

from anymesh.errors import OptionError
from anymesh.export.formats import write_formats
from anymesh.export.options import ExportOptions, Format
from anymesh.openusd.simready_ import grasp_line, kind_and_item, simready_file, write_simready
from anymesh.openusd.writer_ import write_usd, write_usdz
from anymesh.physics.resistance import Pull

ENGINES = {"PhysX": "physx", "Newton": "newton:", "MuJoCo": "mjc:"}


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    folder = tmp_path_factory.mktemp("package")
    model = model_of(cabinet())
    write_simready(model, folder, CONFIG)
    write_usd(model, with_meshes(model, folder), CONFIG)
    return folder


def opened(package, engine=None):
    stage = Usd.Stage.Open(str(package / simready_file("cabinet")))
    if engine:
        with Usd.EditContext(stage, stage.GetSessionLayer()):
            stage.GetDefaultPrim().GetVariantSet(engine).SetVariantSelection("Enabled")
    return stage


def of_engines(stage) -> dict[str, object]:
    """Return the attributes of engines by prim and name."""
    prims = Usd.PrimRange(stage.GetDefaultPrim())
    named = {(p.GetName(), a.GetName()): a.Get() for p in prims for a in p.GetAttributes() if a.IsAuthored()}
    return {f"{prim}.{name}": value for (prim, name), value in named.items() if name.startswith(tuple(ENGINES.values()))}


def test_the_folder_is_named_after_the_asset_and_holds_one_stage(package):
    file = package / simready_file("cabinet")
    assert file.relative_to(package).as_posix() == "simready/cabinet/simready_usd/cabinet.usda"
    assert [p.name for p in file.parent.iterdir() if p.is_file()] == ["cabinet.usda"]
    assert sorted(p.name for p in (file.parent / "payloads").glob("*.usd*")) == [
        "base.usda", "geometries.usdc", "instances.usda", "materials.usda", "physics.usda",
    ]  # fmt: skip
    with Image.open(file.parent / ".thumbs/256x256/cabinet.usda.png") as picture:
        assert picture.size == (256, 256)
        assert len(picture.getcolors(65536)) > 50
    layers, pictures, missing = UsdUtils.ComputeAllDependencies(str(file))
    assert (len(pictures), list(missing)) == (1, [])
    assert all(str(file.parent) in path for path in (*pictures, *(layer.realPath for layer in layers)))


def test_the_layers_say_what_the_one_file_says(package):
    whole, layered = Usd.Stage.Open(str(package / "cabinet.usdc")), opened(package)
    for prim in Usd.PrimRange(whole.GetDefaultPrim()):
        if "_visual" in prim.GetName() or "/materials" in str(prim.GetPath()) or prim.IsA(UsdGeom.Subset):
            continue
        other = layered.GetPrimAtPath(prim.GetPath())
        assert other.GetTypeName() == prim.GetTypeName()
        for attribute in prim.GetAuthoredAttributes():
            if not attribute.GetName().startswith(tuple(ENGINES.values())):
                assert other.GetAttribute(attribute.GetName()).Get() == attribute.Get(), attribute.GetPath()
        for relation in prim.GetAuthoredRelationships():
            assert other.GetRelationship(relation.GetName()).GetTargets() == relation.GetTargets()
        for kind in (UsdPhysics.RigidBodyAPI, UsdPhysics.CollisionAPI, UsdPhysics.ArticulationRootAPI, UsdPhysics.MassAPI):
            assert other.HasAPI(kind) == prim.HasAPI(kind)


def test_an_engine_adds_its_own_attributes_and_no_others(package):
    assert of_engines(opened(package)) == {}
    whole = of_engines(Usd.Stage.Open(str(package / "cabinet.usdc")))
    for engine, prefix in ENGINES.items():
        shown = of_engines(opened(package, engine))
        assert shown
        assert all(name.split(".", 1)[1].startswith(prefix) for name in shown)
        assert {k: v for k, v in whole.items() if k.split(".", 1)[1].startswith(prefix)}.items() <= shown.items()
    for engine, added in (("Newton", {"NewtonCollisionAPI", "NewtonMeshCollisionAPI"}), ("MuJoCo", {"MjcCollisionAPI"})):
        stage = opened(package, engine)
        hull = stage.GetPrimAtPath("/cabinet/links/door/door_collision_1")
        assert added <= set(hull.GetMetadata("apiSchemas").GetAddedOrExplicitItems())


def test_all_validators_of_openusd_pass(package):
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    for engine in (None, *ENGINES):
        context = UsdValidation.ValidationContext(validators)
        assert [(e.GetName(), e.GetMessage()) for e in context.Validate(opened(package, engine))] == []


def test_what_is_drawn_is_labelled_and_has_a_material(package):
    stage = opened(package)
    label = {
        p.GetName(): p.GetAttribute("semantics:labels:class").Get() for p in stage.GetPrimAtPath("/cabinet/links").GetChildren()
    }
    assert label == {"base": ["base"], "door": ["door"], "drawer": ["drawer"], "knob": ["knob"]}
    root = stage.GetDefaultPrim()
    assert root.GetAttribute("semantics:labels:wikidata_qcode").Get() == ["Q14745"]
    drawn = [p for p in Usd.PrimRange(root, Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Gprim)]
    for prim in drawn:
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            surface = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0].GetPrim()
            assert surface.GetAttribute("semantics:labels:material").Get() == [surface.GetName()]
        if UsdGeom.Imageable(prim).ComputePurpose() == "default":
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPrim()
            assert material.GetAttribute("semantics:labels:material").Get()


def test_metadata_is_derived_from_the_asset(package, monkeypatch, tmp_path):
    stage = opened(package)
    data = stage.GetRootLayer().customLayerData
    nested = data["SimReady_Metadata"]
    assert (nested["rigid_body_count"], nested["category"], nested["qcode"]) == (4, "cabinet", "Q14745")
    bodies = [p for p in stage.Traverse() if p.HasAPI(UsdPhysics.MassAPI)]
    assert nested["mass"] == pytest.approx(sum(UsdPhysics.MassAPI(p).GetMassAttr().Get() for p in bodies), rel=1e-6)
    assert np.allclose(nested["asset_extents"], np.ptp(cabinet().mesh.vertices, axis=0), atol=1e-6)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    write_simready(model_of(desk()), tmp_path, CONFIG)
    again = Usd.Stage.Open(str(tmp_path / simready_file("desk")))
    assert again.GetRootLayer().customLayerData["usd_date_generated"] == "1970-01-02"


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("kitchen_Refrigerator_03", ("refrigerator", "Q37828")),
        ("table_lamp_desk", ("desk", "Q1064858")),
        ("toy_car", ("object", "Q223557")),
        ("gizmo", ("object", "Q223557")),
    ],
)
def test_kinds_have_items_of_wikidata(name, kind):
    assert kind_and_item(replace(cabinet(), name=name)) == kind


def test_many_references_share_what_is_drawn(package):
    """`instanceable` at a reference shares the whole asset; without it, links may move and still share their geometry."""
    one = opened(package)
    alone = sum(1 for _ in Usd.PrimRange(one.GetDefaultPrim()))
    for whole, prims in ((True, 21), (False, 1 + 20 * alone)):
        stage = Usd.Stage.CreateInMemory()
        UsdGeom.Xform.Define(stage, "/scene")
        for k in range(20):
            asset = stage.DefinePrim(f"/scene/asset_{k}", "Xform")
            asset.GetReferences().AddReference(str(package / simready_file("cabinet")))
            asset.SetInstanceable(whole)
        assert len(stage.GetPrototypes()) == (1 + 4 if whole else 4)
        assert sum(1 for _ in stage.TraverseAll()) == prims


def test_a_grasp_line_crosses_the_handle():
    bar = solid((0.1, -0.05, 0.3), (0.12, -0.03, 0.6))  # upright, 2 cm thick, off the door
    panel = solid((0.0, -0.01, 0.0), (0.5, 0.0, 1.0))
    at, out = np.array([0.11, -0.05, 0.45]), np.array([0.0, -1.0, 0.0])
    ends = grasp_line(bar, Pull("N", 1.0, 1.0, 1.0, at, out), np.zeros(3))
    assert np.allclose(sorted(ends.tolist()), [[0.09, -0.04, 0.45], [0.13, -0.04, 0.45]], atol=1e-6)
    whole = grasp_line(np.concatenate([panel, bar]) - at, Pull("N", 1.0, 1.0, 1.0, at, out), at)
    assert abs((whole[1] - whole[0]) @ out) < 1e-9


def test_usdz_is_one_file_with_everything(tmp_path):
    model = model_of(cabinet())
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        write_usdz(model, tmp_path / name, CONFIG)
    data = (tmp_path / "one/cabinet.usdz").read_bytes()
    assert data == (tmp_path / "two/cabinet.usdz").read_bytes()
    assert [p.name for p in (tmp_path / "one").iterdir()] == ["cabinet.usdz"]
    with zipfile.ZipFile(tmp_path / "one/cabinet.usdz") as archive:
        assert [i.filename for i in archive.infolist()] == ["cabinet.usdc", "meshes/checker.png"]
        for entry in archive.infolist():
            start = (
                entry.header_offset + 30 + len(entry.filename) + int.from_bytes(data[entry.header_offset + 28 :][:2], "little")
            )
            assert (entry.compress_type, start % 64, data[start : start + 4]) == (0, 0, archive.read(entry)[:4])
    stage = Usd.Stage.Open(str(tmp_path / "one/cabinet.usdz"))
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert not UsdValidation.ValidationContext(validators).Validate(stage)
    assert UsdUtils.ComputeAllDependencies(str(tmp_path / "one/cabinet.usdz"))[2] == []


def test_the_profile_stays_as_asset_json_says():
    how = ExportOptions.parse({"formats": "urdf", "profile": "simready"})
    assert how.formats == (Format.URDF, Format.USD)
    assert how.record()["profile"] == "simready"
    kept = ExportOptions.parse({}, before={**json.loads(json.dumps(how.record())), "files": {"usd": "a.usdc"}})
    assert (kept.profile, kept.formats) == (how.profile, (Format.USD,))
    assert ExportOptions.parse({"profile": "none"}, before=how.record()).record().get("profile") is None
    with pytest.raises(OptionError, match="valid are none, simready"):
        ExportOptions.parse({"profile": "simredy"})


def test_formats_are_written_with_the_profile(tmp_path):
    how = ExportOptions.parse({"formats": "usd", "profile": "simready"})
    write_formats(replace(model_of(desk()), how=how), tmp_path, how.formats, CONFIG)
    assert (tmp_path / simready_file("desk")).exists()
    assert (tmp_path / "desk.usdc").exists()
