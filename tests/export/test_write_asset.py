"""Test the whole folder: the contract, the schema, reproducible bytes, unusual names."""

import importlib.util
import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import trimesh
from assets import cabinet, checker, mesh_of, slanted, source
from contract import faults

from anymesh.export import write_asset
from anymesh.export.asset_json import schema
from anymesh.types import Asset, Part, Segmentation

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


def test_the_same_asset_gives_the_same_bytes(tmp_path):
    contents = []
    for run in ("a", "b"):
        (tmp_path / run).mkdir()
        write_asset(cabinet(), tmp_path / run)
        files = sorted(p for p in (tmp_path / run).rglob("*") if p.is_file())
        contents.append({p.relative_to(tmp_path / run): p.read_bytes() for p in files})
    assert contents[0] == contents[1]


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
