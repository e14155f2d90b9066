"""Test the output folder: stages kept by key, complete or absent outputs, and the protection of other files."""

from dataclasses import fields, replace

import numpy as np
import pytest
from assets import cabinet, slanted
from run_folders import files, results, write_all

from anymesh.errors import OpenQuestionError, OutputError
from anymesh.export import write_asset
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.stage_files import JOINTS, MESH, SEGMENTATION, stage_key


def assert_same(a, b):
    for field in fields(a):
        x, y = getattr(a, field.name), getattr(b, field.name)
        if isinstance(x, np.ndarray):
            np.testing.assert_array_equal(x, y)
            assert x.dtype == y.dtype
        else:
            assert x == y


@pytest.mark.parametrize("make", [cabinet, slanted])
def test_results_come_back_as_they_were(make, tmp_path, source):
    asset = make()
    write_all(tmp_path / "out", source, asset, export=False)
    with RunFolder.open(tmp_path / "out") as run:
        placed, segmented, jointed = run.need(MESH), run.need(SEGMENTATION), run.need(JOINTS)
        assert run.key(SEGMENTATION) == "s"
        assert run.timing() == {"joints": 0.5}
    assert_same(placed.mesh, asset.mesh)
    assert_same(placed.source, asset.source)
    assert placed.warnings == ("scaled",)
    assert_same(segmented.segmentation, asset.segmentation)
    for a, b in zip(jointed.joints, asset.joints, strict=True):
        assert_same(a, b)
    assert jointed.warnings == ("unsure",)


def test_the_same_run_writes_the_same_bytes(tmp_path, source):
    write_all(tmp_path / "a", source)
    write_all(tmp_path / "b", source)
    assert files(tmp_path / "a") == files(tmp_path / "b")


def test_keys_follow_settings_and_the_stage_before():
    key = stage_key(SEGMENTATION, previous="a", config={"x": 1, "y": [1.5]})
    assert key == stage_key(SEGMENTATION, previous="a", config={"y": [1.5], "x": 1})
    others = [
        stage_key(SEGMENTATION, previous="b", config={"x": 1, "y": [1.5]}),
        stage_key(SEGMENTATION, previous="a", config={"x": 2, "y": [1.5]}),
        stage_key(JOINTS, previous="a", config={"x": 1, "y": [1.5]}),
    ]
    assert len({key, *others}) == 4


def test_a_forced_run_takes_over_stages_with_equal_keys(tmp_path, source):
    write_all(tmp_path / "out", source)
    with RunFolder.create(tmp_path / "out", source=source, force=True) as run:
        assert run.load(MESH, "m") is not None
        assert run.load(SEGMENTATION, "other") is None
        with pytest.raises(OutputError, match="segmentation"):
            run.need(SEGMENTATION)
    assert sorted(files(tmp_path / "out")) == ["stages/files.json", "stages/mesh.json", "stages/mesh.npz"]


def test_a_damaged_stage_counts_as_missing(tmp_path, source):
    write_all(tmp_path / "out", source)
    path = tmp_path / "out" / "stages" / "segmentation.npz"
    path.write_bytes(path.read_bytes()[:-40])
    with RunFolder.open(tmp_path / "out") as run:
        assert run.load(SEGMENTATION, "s") is None
        with pytest.raises(OutputError, match="segmentation"):
            run.need(SEGMENTATION)


def test_stages_one_by_one_end_as_all_at_once(tmp_path, source):
    placed, segmented, jointed = results(cabinet())
    out = tmp_path / "out"
    with RunFolder.create(out, source=source) as run:
        run.save(MESH, "m", placed)
        run.save(SEGMENTATION, "s", segmented)
    with RunFolder.open(out) as run:
        run.save(JOINTS, "j", jointed)
        run.add_time("joints", 0.5)
    with RunFolder.open(out) as run:
        write_asset(run.asset(), run.folder)
    write_all(tmp_path / "whole", source)
    assert files(out) == files(tmp_path / "whole")


def test_a_new_stage_result_removes_what_followed_from_the_old(tmp_path, source):
    write_all(tmp_path / "out", source)
    with RunFolder.open(tmp_path / "out") as run:
        run.save(SEGMENTATION, "s2", run.need(SEGMENTATION))
        with pytest.raises(OutputError, match="joints"):
            run.need(JOINTS)
    left = set(files(tmp_path / "out"))
    assert "asset.json" not in left
    assert "stages/joints.json" not in left
    assert {"stages/mesh.json", "stages/segmentation.json"} <= left


def test_a_second_export_leaves_no_files_of_the_first(tmp_path, source):
    write_all(tmp_path / "out", source)
    with RunFolder.open(tmp_path / "out") as run:
        renamed = cabinet(names=("base", "lid", "drawer", "knob"))
        write_asset(replace(renamed, name="other"), run.folder)
    left = set(files(tmp_path / "out"))
    assert {"other.urdf", "meshes/lid.obj", "stages/mesh.npz"} <= left
    assert not {"cabinet.urdf", "meshes/door.obj"} & left


def test_adding_a_file_keeps_the_rest(tmp_path, source):
    write_all(tmp_path / "out", source)
    before = files(tmp_path / "out")
    with RunFolder.open(tmp_path / "out") as run:
        (run.folder / "report.html").write_text("x")
    after = files(tmp_path / "out")
    assert after.pop("report.html") == b"x"
    assert {k: v for k, v in after.items() if k != "stages/files.json"} == {
        k: v for k, v in before.items() if k != "stages/files.json"
    }
    write_all(tmp_path / "out", source, force=True)  # written by this program, so it may be replaced


def test_what_follows_a_stage_that_was_made_anew_is_not_taken_over(tmp_path, source):
    write_all(tmp_path / "out", source)
    placed, segmented, _ = results(cabinet())
    with RunFolder.create(tmp_path / "out", source=source, force=True) as run:
        assert run.load(MESH, "m") is not None
        assert run.load(JOINTS, "j") is not None
        run.save(SEGMENTATION, "s", segmented)  # under the same key, as when other answers made it
        assert run.load(JOINTS, "j") is None
        assert run.load(MESH, "m") is not None
        assert placed.warnings == run.need(MESH).warnings


def test_an_open_question_keeps_the_finished_stages(tmp_path, source):
    placed, _, _ = results(cabinet())

    def stops() -> None:
        with RunFolder.create(tmp_path / "out", source=source) as run:
            run.save(MESH, "m", placed)
            raise OpenQuestionError("what is it?", [tmp_path / "q"])

    with pytest.raises(OpenQuestionError):
        stops()
    assert not (tmp_path / "out").exists()
    with RunFolder.create(tmp_path / "out", source=source) as run:
        assert run.load(MESH, "m") is not None
