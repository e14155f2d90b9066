"""Stage C from an output to another: what a user gets, and what stays."""

import hashlib
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import trimesh
from surfaces import case_with_door

from anymesh.checking import check_asset
from anymesh.errors import ModelError, OptionError, OutputError
from anymesh.finishing.finishing import finish, finish_asset
from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.texture import Carried
from anymesh.pipeline import articulate, export_asset


@pytest.fixture(scope="module")
def surface(tmp_path_factory) -> Path:
    """An output made from a case whose front a door covers: a surface mesh without any interior."""
    folder = tmp_path_factory.mktemp("finish")
    asset = case_with_door()
    trimesh.Trimesh(asset.mesh.vertices, asset.mesh.faces, process=False).export(folder / "case.ply")
    np.save(folder / "labels.npy", asset.segmentation.face_part)
    articulate(folder / "case.ply", folder / "out", parts=str(folder / "labels.npy"), up="z", scale="1")
    return folder / "out"


def digests(folder: Path) -> dict[str, str]:
    files = sorted(p for p in folder.rglob("*") if p.is_file())
    return {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest() for p in files}


@pytest.fixture(scope="module")
def finished(surface, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("finished") / "done"
    before = digests(surface)
    asset = finish(surface, folder)
    assert digests(surface) == before
    assert json.loads((folder / "asset.json").read_text())["finish"] == list(asset.notes)
    return folder


def test_a_surface_becomes_a_whole_asset(surface, finished):
    record = json.loads((finished / "asset.json").read_text())
    assert all(p["new_faces"] > 0 for p in record["parts"])
    assert any(note.startswith("base:") or note.startswith("part_0") for note in record["finish"])
    first = json.loads((surface / "asset.json").read_text())
    for part, old in zip(record["parts"], first["parts"], strict=True):
        np.testing.assert_array_equal(np.load(finished / part["faces"]), np.load(surface / old["faces"]))
        assert part["face_count"] == old["face_count"]
        mesh = trimesh.load(finished / "meshes" / f"{part['name']}.obj", force="mesh")
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
        assert mesh.is_watertight
    kinematics = ("name", "type", "parent", "child", "origin", "axis", "limits", "confidence", "reason")
    assert [[j[key] for key in kinematics] for j in record["joints"]] == [
        [j[key] for key in kinematics] for j in first["joints"]
    ]
    assert check_asset(finished).ok


def test_export_and_finish_keep_how_the_asset_was_written(surface, tmp_path):
    folder, done = tmp_path / "out", tmp_path / "done"
    shutil.copytree(surface, folder)
    export_asset(folder, base="free", drives="position", hulls=4)
    export_asset(folder, hulls=3)
    finish(folder, done, completer="off", base="fixed")
    for place, base in ((folder, "free"), (done, "fixed")):
        record = json.loads((place / "asset.json").read_text())
        assert (record["base"], record["drives"], record["hulls"]) == (base, "position", 3)
        assert set(record["files"]) == {"urdf", "mjcf", "sdf", "glb"}
        assert "<position" in (place / "case.xml").read_text()
    finish(folder, done, completer="off", formats="urdf", drives="passive", hulls=0, force=True)
    record = json.loads((done / "asset.json").read_text())
    assert (record["base"], record["drives"], set(record["files"])) == ("free", "passive", {"urdf"})
    assert "hulls" not in record


def test_finish_past_its_time_limit_leaves_surfaces_open_and_says_so(surface, finished, tmp_path):
    shutil.copytree(finished, tmp_path / "done")
    asset = finish(surface, tmp_path / "done", force=True, time_limit=1e-6)  # another limit computes the stage anew
    record = json.loads((tmp_path / "done" / "asset.json").read_text())
    assert not any(p.get("new_faces") for p in record["parts"])
    assert "time limit of 1e-06 s: completion: some surfaces remain open" in asset.notes
    assert record["joints"] == json.loads((surface / "asset.json").read_text())["joints"]
    assert check_asset(tmp_path / "done").ok


def test_a_rerun_and_an_export_write_the_same(surface, finished, tmp_path):
    def written() -> dict[str, str]:
        return {name: digest for name, digest in digests(tmp_path / "done").items() if name != "timing.json"}

    finish(surface, tmp_path / "done")
    first = written()
    assert first == {name: digest for name, digest in digests(finished).items() if name != "timing.json"}
    export_asset(tmp_path / "done")  # the finished stage is what is exported
    assert written() == first


def test_shapes_can_be_left_and_looks_baked(surface, tmp_path):
    finish(surface, tmp_path / "done", completer="off", texture="bake:64")
    record = json.loads((tmp_path / "done" / "asset.json").read_text())
    assert [p["new_faces"] for p in record["parts"]] == [0, 0]
    assert (tmp_path / "done" / "meshes" / "atlas.png").exists()


def test_a_missing_model_is_replaced_by_the_default():
    class Away:
        name = "away"

        def complete(self, asset):
            raise ModelError("there is no GPU")

    done = finish_asset(case_with_door(), shapes=True, completer=Away(), retexturer=Carried(), config=ShapeConfig())
    assert (done.source_face < 0).any()
    assert done.notes[0] == "away: there is no GPU; the built-in completer did all parts"


def test_wrong_places_and_names_are_one_clear_error(surface, tmp_path):
    with pytest.raises(OutputError, match="lies in the output folder"):
        finish(surface, surface)
    with pytest.raises(OutputError, match="lies in the asset"):
        finish(surface, surface / "done")
    with pytest.raises(OutputError, match="is not an output of anymesh"):
        finish(tmp_path, tmp_path / "done")
    with pytest.raises(OptionError, match="--completer: found 'magic'; valid are builtin, off"):
        finish(surface, tmp_path / "done", completer="magic")
    with pytest.raises(OptionError, match="--texture: found 'magic'"):
        finish(surface, tmp_path / "done", texture="magic")
    assert not (tmp_path / "done").exists()
