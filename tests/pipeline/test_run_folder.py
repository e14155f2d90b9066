"""Test the output folder: stages kept by key, complete or absent outputs, and the protection of other files."""

import os
import signal
import subprocess
import sys
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet, slanted

from anymesh.errors import OpenQuestionError, OutputError
from anymesh.export import write_asset
from anymesh.pipeline.results import JointResult, LoadResult, SegmentationResult
from anymesh.pipeline.storage.packing import JOINTS, MESH, SEGMENTATION
from anymesh.pipeline.storage.run_folder import RunFolder
from anymesh.pipeline.storage.stage_files import stage_key


def results(asset):
    placed = LoadResult(asset.mesh, asset.source, ("scaled",))
    return placed, SegmentationResult(asset.segmentation, "geometry"), JointResult(asset.joints, "geometry", ("unsure",))


def write_all(target: Path, source: Path, asset=None, *, force=False, export=True) -> None:
    placed, segmented, jointed = results(asset or cabinet())
    with RunFolder.create(target, source=source, force=force) as run:
        run.save(MESH, "m", placed)
        run.save(SEGMENTATION, "s", segmented)
        run.save(JOINTS, "j", jointed)
        run.add_time("joints", 0.5)
        if export:
            write_asset(run.asset(), run.folder)


@pytest.fixture
def source(tmp_path):
    (tmp_path / "in").mkdir()
    path = tmp_path / "in" / "mesh.glb"
    path.write_bytes(b"mesh")
    return path


def files(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


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


def test_an_exception_leaves_nothing_or_the_old(tmp_path, source):
    def broken(force):
        with RunFolder.create(tmp_path / "out", source=source, force=force) as run:
            run.save(MESH, "m2", results(cabinet())[0])
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        broken(False)
    assert [p.name for p in tmp_path.iterdir()] == ["in"]
    write_all(tmp_path / "out", source)
    before = files(tmp_path / "out")
    with pytest.raises(KeyboardInterrupt):
        broken(True)
    assert files(tmp_path / "out") == before
    assert {p.name for p in tmp_path.iterdir()} == {"in", "out"}


def test_folders_that_are_refused(tmp_path, source):
    out = tmp_path / "out"
    write_all(out, source)
    with pytest.raises(OutputError, match="--force"):
        RunFolder.create(out, source=source)
    (out / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"notes\.txt"):
        RunFolder.create(out, source=source, force=True)
    with pytest.raises(OutputError, match="source mesh"):
        RunFolder.create(source.parent, source=source, force=True)
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "asset.json").write_text("{}")
    for force in (False, True):
        with pytest.raises(OutputError, match="not empty"):
            RunFolder.create(mine, source=source, force=force)
    with pytest.raises(OutputError, match="is a file"):
        RunFolder.create(mine / "asset.json", source=source, force=True)
    with pytest.raises(OutputError, match="not an output of anymesh"):
        RunFolder.open(mine)
    assert (out / "notes.txt").read_text() == "mine"
    assert source.read_bytes() == b"mesh"


def test_an_empty_folder_and_missing_parents_are_fine(tmp_path, source):
    (tmp_path / "empty").mkdir()
    write_all(tmp_path / "empty", source, export=False)
    write_all(tmp_path / "a" / "b" / "out", source, export=False)
    assert (tmp_path / "a" / "b" / "out" / "stages" / "mesh.json").exists()
    assert (tmp_path / "empty").stat().st_mode & 0o077 == (tmp_path / "in").stat().st_mode & 0o077


def test_someone_else_filling_the_folder_meanwhile_is_not_overwritten(tmp_path, source):
    def late():
        with RunFolder.create(tmp_path / "out", source=source) as run:
            (tmp_path / "out").mkdir()
            (tmp_path / "out" / "theirs").write_text("x")
            run.save(MESH, "m", results(cabinet())[0])

    with pytest.raises(OutputError, match="cannot write"):
        late()
    assert files(tmp_path / "out") == {"theirs": b"x"}


def test_a_mount_point_is_written_file_by_file(tmp_path, source, monkeypatch):
    out = tmp_path / "out"
    out.mkdir()
    monkeypatch.setattr(os.path, "ismount", lambda path: Path(path) == out)
    inode = out.stat().st_ino
    write_all(out, source)
    write_all(out, source, replace(cabinet(), name="again"), force=True)
    assert out.stat().st_ino == inode
    monkeypatch.undo()
    write_all(tmp_path / "usual", source)
    assert files(out) == files(tmp_path / "usual")


CHILD = """
import sys, time
sys.path[:0] = sys.argv[3:]
from pathlib import Path
from test_run_folder import results, cabinet
from anymesh.pipeline.storage.packing import MESH
from anymesh.pipeline.storage.run_folder import RunFolder
with RunFolder.create(Path(sys.argv[1]), source=Path(sys.argv[2])) as run:
    run.save(MESH, "m", results(cabinet())[0])
    print("ready", flush=True)
    time.sleep(60)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL and file locks")
def test_a_killed_run_leaves_no_output_and_its_stages_are_taken_over(tmp_path, source):
    out = tmp_path / "out"
    command = [sys.executable, "-c", CHILD, str(out), str(source), *map(str, Path(__file__).parents[:2])]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert child.stdout
    assert child.stdout.readline() == "ready\n"
    with RunFolder.create(out, source=source) as run:  # the other process is alive: nothing is taken from it
        assert run.load(MESH, "m") is None
        alive = sorted(p.name for p in tmp_path.iterdir() if p.name.startswith(".out.tmp-"))
        assert len(alive) == 2
    out_files = files(out)
    child.send_signal(signal.SIGKILL)
    child.wait()
    assert files(out) == out_files
    for path in sorted(out.rglob("*"), reverse=True):
        path.unlink() if path.is_file() else path.rmdir()
    out.rmdir()
    with RunFolder.create(out, source=source) as run:
        assert run.load(MESH, "m") is not None
    assert {p.name for p in tmp_path.iterdir()} == {"in", "out"}


def test_a_kill_between_the_two_renames_loses_nothing(tmp_path, source):
    write_all(tmp_path / "out", source)
    before = files(tmp_path / "out")
    (tmp_path / "out").rename(tmp_path / ".out.old-123")
    with RunFolder.open(tmp_path / "out"):
        pass
    assert files(tmp_path / "out") == before


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
