"""Test the whole folder: the contract, the schema, reproducible bytes, unusual names."""

import importlib.util
import json
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import jsonschema
import numpy as np
import pytest
import trimesh
import yourdfpy
from assets import cabinet, checker, mesh_of, slanted, source
from contract import faults
from mechanical import MECHANISMS
from models import CONFIG, desk, model_of, with_meshes

from anymesh.errors import InputError, OutputError
from anymesh.export import write_asset
from anymesh.export.asset_json import asset_record, schema
from anymesh.export.formats import write_formats
from anymesh.export.links import split_links
from anymesh.export.model import build_model
from anymesh.export.options import DEFAULT, Base, ExportOptions
from anymesh.formats.packed import check_zip, write_package, write_zip
from anymesh.pipeline.results import JointResult
from anymesh.pipeline.stage_files import JOINTS, read_stage, write_stage
from anymesh.types import Asset, Hull, Part, Segmentation
from anymesh.types.triangles import unique_rows

SHARED = Path(__file__).parents[3] / "shared" / "check_contract.py"


@pytest.fixture
def output(tmp_path):
    """Return a written cabinet with its preview, and its source mesh."""
    folder = tmp_path / "out"
    folder.mkdir()
    asset = cabinet()
    write_asset(asset, folder)
    (folder / "preview.png").write_bytes(checker())
    mesh = tmp_path / "source.ply"
    trimesh.Trimesh(asset.mesh.vertices, asset.mesh.faces, process=False).export(mesh)
    return folder, mesh


def test_the_contract_holds(output):
    assert faults(*output) == []


@pytest.mark.skipif(not SHARED.exists(), reason="the outside checker is not part of a clone")
def test_the_contract_holds_for_the_outside_checker(output):
    spec = importlib.util.spec_from_file_location("check_contract", SHARED)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert list(module.faults(*map(str, output))) == []


def changed(folder, change):
    record = json.loads((folder / "asset.json").read_text())
    change(record)
    (folder / "asset.json").write_text(json.dumps(record))


FAULTS = {
    "missing": lambda f: (f / "preview.png").unlink(),
    "axes differ": lambda f: changed(f, lambda r: r["joints"][0].update(axis=[0, 0, -1])),
    "hinge lines differ": lambda f: changed(f, lambda r: r["joints"][0].update(origin=[0, 0, 0])),
    "confidence and reason": lambda f: changed(f, lambda r: r["joints"][0].update(reason="")),
    "joints of URDF": lambda f: changed(f, lambda r: r["joints"].pop()),
    "not where the source is": lambda f: changed(
        f, lambda r: r["source"].update(T_asset_source=np.diag([2, 2, 2, 1]).tolist())
    ),
    "no such file": lambda f: (f / "meshes" / "door.obj").unlink(),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_the_contract_test_sees_a_fault(output, fault):
    FAULTS[fault](output[0])
    assert any(fault in found for found in faults(*output))


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_asset_json_follows_its_schema(make, tmp_path):
    asset = make()
    write_asset(asset, tmp_path)
    record = json.loads((tmp_path / "asset.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema())
    jsonschema.Draft202012Validator(schema()).validate(record)
    assert record["source"]["T_asset_source"] == np.eye(4).tolist()
    for index, part in enumerate(record["parts"]):
        np.testing.assert_array_equal(np.load(tmp_path / part["faces"]), asset.segmentation.faces(index))
    assert record["parts"][0]["parent"] is None
    record["joints"][0]["limits"] = None if record["joints"][0]["limits"] else [0, 1]
    assert not jsonschema.Draft202012Validator(schema()).is_valid(record)


@pytest.mark.parametrize(("front", "stated"), [(0.0, [0, -1, 0]), (90.0, [1, 0, 0]), (-45.0, [-0.707107, -0.707107, 0])])
def test_an_answered_front_is_the_direction_from_which_it_is_seen(front: float, stated: list[float]) -> None:
    record = asset_record(model_of(replace(cabinet(), front=front)))
    assert record["front"] == pytest.approx(stated, abs=1e-6)
    jsonschema.validate(record, schema())
    assert "front" not in asset_record(model_of(cabinet()))


def test_the_same_asset_gives_the_same_bytes(tmp_path):
    contents = []
    for run in ("a", "b"):
        (tmp_path / run).mkdir()
        write_asset(cabinet(), tmp_path / run)
        files = sorted(p for p in (tmp_path / run).rglob("*") if p.is_file())
        contents.append({p.relative_to(tmp_path / run): p.read_bytes() for p in files})
    assert contents[0] == contents[1]


def test_visuals_are_dae_and_all_shapes_hulls_on_request(tmp_path):
    how = ExportOptions.parse({"visuals": "dae", "shapes": "hulls"})
    model = write_asset(cabinet(), tmp_path, how)
    record = json.loads((tmp_path / "asset.json").read_text())
    jsonschema.validate(record, schema())
    assert (record["visuals"], record["shapes"]) == ("dae", "hulls")
    assert ExportOptions.parse({}, before=record) == how
    assert all(isinstance(shape, Hull) for body in model.bodies for shape in body.shapes)
    assert {path for body in model.bodies for path in body.hull_paths()} <= {
        f"meshes/{p.name}" for p in tmp_path.glob("meshes/*")
    }
    assert (tmp_path / "meshes" / "door.dae").exists()


def test_odd_names_become_legal_everywhere(tmp_path):
    asset = cabinet(names=("world", 'Tür "<&>', "2", "con"), name="Öl/../x y")
    write_asset(asset, tmp_path)
    record = json.loads((tmp_path / "asset.json").read_text())
    jsonschema.Draft202012Validator(schema()).validate(record)
    assert [p["name"] for p in record["parts"]] == ["world_part", "Tur", "part_2", "con_part"]
    (tmp_path / "preview.png").write_bytes(checker())
    assert (tmp_path / "Ol_x_y.urdf").exists()
    mesh = tmp_path / "source.ply"
    trimesh.Trimesh(asset.mesh.vertices, asset.mesh.faces, process=False).export(mesh)
    assert faults(tmp_path, mesh) == []


def test_an_object_with_nothing_that_moves(tmp_path):
    mesh, part = mesh_of([(np.eye(4)[:, :3], np.array([[0, 2, 1], [0, 1, 3]]))])
    write_asset(Asset("one", source(), mesh, Segmentation(part, (Part("body", "body"),)), (), "geometry"), tmp_path)
    assert json.loads((tmp_path / "asset.json").read_text())["joints"] == []
    assert trimesh.load(tmp_path / "one.glb").geometry["body"].faces.shape == (2, 3)


def test_links_hold_the_source_faces_in_order():
    asset = cabinet()
    for index, link in enumerate(split_links(asset)):
        np.testing.assert_array_equal(link.faces, asset.segmentation.faces(index))
        np.testing.assert_allclose(link.triangles + link.origin, asset.mesh.triangles[link.faces], atol=1e-12)


def test_equal_corners_are_merged_and_others_are_not():
    knob = split_links(cabinet())[3].primitives[0]
    assert len(knob.positions) == 24  # a box with flat normals and unwrapped sides
    bare = replace(cabinet().mesh, corner_uv=None, corner_normal=None, corner_color=None)
    assert len(split_links(replace(cabinet(), mesh=bare))[3].primitives[0].positions) == 8


def test_two_materials_in_a_part_are_two_primitives():
    asset = cabinet()
    material = asset.mesh.face_material.copy()
    material[asset.segmentation.faces(1)[:4]] = -1
    primitives = split_links(replace(asset, mesh=replace(asset.mesh, face_material=material)))[1].primitives
    assert [p.material for p in primitives] == [-1, 1]
    assert [len(p.triangles) for p in primitives] == [4, 8]


def test_zero_and_wrong_normals_become_the_face_normal():
    asset = cabinet()
    normals = asset.mesh.corner_normal.copy()
    normals[:6], normals[6:12] = 0, np.nan
    fixed = split_links(replace(asset, mesh=replace(asset.mesh, corner_normal=normals)))[0].primitives[0]
    np.testing.assert_allclose(np.linalg.norm(fixed.normals, axis=1), 1, atol=1e-6)


def test_unique_rows_against_numpy():
    rng = np.random.default_rng(0)
    rows = rng.integers(0, 3, (500, 4)).astype(np.uint64)
    first, inverse = unique_rows(list(rows.T))
    np.testing.assert_array_equal(rows[first][inverse], rows)
    assert len(first) == len(np.unique(rows, axis=0))
    assert (np.diff(first) > 0).all()


@pytest.fixture
def written(tmp_path):
    model = model_of(replace(desk(), name="Desk__No_7"))
    folder = tmp_path / "Desk__No_7"
    folder.mkdir()
    write_formats(model, with_meshes(model, folder), DEFAULT, CONFIG)
    return folder


@pytest.mark.parametrize("base", Base)
def test_a_package_is_whole_by_itself(written, tmp_path, base):
    package = write_package(written, tmp_path / "ros", base=base)
    assert package.name == "desk_no_7"
    assert ElementTree.parse(package / "package.xml").getroot().findtext("name") == package.name
    assert f"project({package.name})" in (package / "CMakeLists.txt").read_text()
    urdf = package / "urdf" / "Desk__No_7.urdf"
    files = [str(m.get("filename")) for m in ElementTree.parse(urdf).getroot().iter("mesh")]
    assert files
    assert all((package / f.removeprefix(f"package://{package.name}/")).is_file() for f in files)
    assert all(f.startswith(f"package://{package.name}/meshes/") for f in files)
    for mtl in (package / "meshes").glob("*.mtl"):
        for line in mtl.read_text().splitlines():
            assert not line.startswith(("map_", "norm ")) or (package / "meshes" / line.split()[1]).is_file()
    assert not list(package.rglob("*.npy"))
    robot = yourdfpy.URDF.load(str(urdf), load_meshes=False)
    assert robot.base_link == ("world" if base is Base.FIXED else "desk")
    assert robot.validate()


def test_a_package_is_not_overwritten_and_needs_a_urdf(written, tmp_path):
    write_package(written, tmp_path, base=Base.FREE)
    with pytest.raises(OutputError, match="exists"):
        write_package(written, tmp_path, base=Base.FREE)
    with pytest.raises(InputError, match=r"one \.urdf, found 0"):
        write_package(tmp_path / "desk_no_7", tmp_path, base=Base.FREE)


def test_a_package_needs_a_folder(written, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="exists"):
        write_package(written, tmp_path / "file", base=Base.FREE)


@pytest.mark.parametrize("path", ["", "asset.json", "lost/a.zip", "folder.zip"])
def test_a_zip_needs_a_name_of_its_own_in_a_folder_that_exists(tmp_path, path):
    (tmp_path / "folder.zip").mkdir()
    with pytest.raises(OutputError, match=r"ends in \.zip"):
        check_zip(tmp_path / path)
    check_zip(tmp_path / "a.zip")


def test_a_zip_holds_the_folder_and_its_bytes_do_not_depend_on_when(written, tmp_path):
    contents = []
    for run in ("a.zip", "b.zip"):
        for file in written.rglob("*"):
            file.touch()
        (written / ".hidden").touch()
        write_zip(written, tmp_path / run)
        contents.append((tmp_path / run).read_bytes())
    assert contents[0] == contents[1]
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        assert archive.testzip() is None
        assert {i.date_time[0] for i in archive.infolist()} == {1980}
        found = {name: archive.read(name) for name in archive.namelist()}
    whole = {p.relative_to(tmp_path).as_posix(): p.read_bytes() for p in written.rglob("*") if p.is_file()}
    del whole["Desk__No_7/.hidden"]
    assert found == whole
    assert list(found) == sorted(found)


@pytest.mark.parametrize("make", MECHANISMS)
def test_mechanisms_are_stated_by_the_schema_and_kept_by_stages(make, tmp_path):
    asset = make()
    model = build_model(asset, ExportOptions(), config=CONFIG, cache=None)
    record = asset_record(model)
    jsonschema.Draft202012Validator(schema()).validate(record)
    assert [j.get("mimic", {}).get("joint") for j in record["joints"]] == [j.mimic and j.mimic.joint for j in asset.joints]
    write_stage(tmp_path, JOINTS, "key", JointResult(asset.joints, "geometry", loops=asset.loops))
    again = read_stage(tmp_path, JOINTS, "key")
    assert again is not None
    assert list(map(repr, again.joints + again.loops)) == list(map(repr, asset.joints + asset.loops))
    assert [(j.mimic, j.pitch) for j in again.joints] == [(j.mimic, j.pitch) for j in asset.joints]
