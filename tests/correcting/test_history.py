"""A history undoes and redoes exactly, and its log makes the same asset again."""

import json
import signal
import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from correctable import write_output
from hypothesis import given
from hypothesis import strategies as st

from anymesh import pipeline
from anymesh.checking import check_asset
from anymesh.correcting import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Confirm,
    CorrectionError,
    FaceSet,
    FlipSign,
    History,
    HistoryEntry,
    MergeParts,
    MoveFaces,
    Opened,
    Relabel,
    RemovePart,
    Rename,
    SetAxis,
    SetLimits,
    SetLoop,
    SetMimic,
    SetScrew,
    SplitComponents,
    SplitPart,
    StaleError,
    open_asset,
    save_asset,
)
from anymesh.correcting.history import KINDS, pack_log, unpack_log
from anymesh.errors import OutputError
from anymesh.finishing.finishing import finish
from anymesh.pipeline.results import JointResult
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.stage_files import JOINTS
from anymesh.types import JointType

NOW = "2024-05-01T12:00:00+00:00"
ONE_OF_EACH = (
    ChangeType("door", JointType.CONTINUOUS),
    SetLimits("door", -0.25, 1.5),
    FlipSign("door"),
    SetAxis("door", (0.0, 0.6, 0.8), (0.1, 0.2, 0.3), "snapped to an edge"),
    ChooseMotion("drawer", JointType.PRISMATIC, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.3), 0.4, "slides outwards"),
    SplitPart("door", FaceSet(((72, 74),)), "tab", "tab"),
    MoveFaces(FaceSet(((74, 76), (77, 78))), "tab"),
    ChangeParent("knob", "door"),
    Relabel("tab", "Griff ü"),
    Rename("tab", "grip"),
    SetMimic("drawer", "door", -0.2),
    SetScrew("knob", 0.01),
    SetLoop("drawer", "door", (0.1, 0.0, 0.2), JointType.BALL),
    Confirm("drawer"),
    RemovePart("drawer"),
    MergeParts("knob", "door"),
    SplitComponents("door"),
)


def entries(corrections):
    return tuple(HistoryEntry(c, f"2024-05-0{1 + i % 9}T12:00:00+00:00", "Ada") for i, c in enumerate(corrections))


def same(a, b) -> None:
    assert a.segmentation.parts == b.segmentation.parts
    np.testing.assert_array_equal(a.segmentation.face_part, b.segmentation.face_part)
    assert a.warnings == b.warnings
    for x, y in zip(a.joints, b.joints, strict=True):
        for field in fields(x):
            np.testing.assert_array_equal(getattr(x, field.name), getattr(y, field.name))


def test_every_kind_is_tried_here():
    assert {type(c) for c in ONE_OF_EACH} == set(KINDS.values())


def test_the_log_replays_to_the_same_asset_bit_for_bit():
    history = History.of(cabinet(), entries(ONE_OF_EACH))
    text = json.dumps(pack_log(history.done), allow_nan=False)
    log = unpack_log(json.loads(text))
    assert log == history.done
    same(History.of(cabinet(), log).asset, history.asset)


@given(st.integers(0, len(ONE_OF_EACH)), st.integers(0, len(ONE_OF_EACH)))
def test_undo_is_exact_and_redo_brings_back(done, undone):
    history = start = History.of(cabinet(), entries(ONE_OF_EACH[:done]))
    for _ in range(min(undone, done)):
        history = history.undo()
    assert history.asset is start.states[done - min(undone, done)]
    for _ in range(min(undone, done)):
        history = history.redo()
    same(history.asset, start.asset)
    assert history.done == start.done


def test_corrections_made_as_one_step_are_undone_and_redone_as_one():
    start = History.of(cabinet(), entries([FlipSign("drawer")]))
    done = start.do_all([FlipSign("door"), SetLimits("door", 0.0, 1.0), SetLimits("drawer", 0.0, 0.1)], NOW, "Ada")
    assert unpack_log(json.loads(json.dumps(pack_log(done.done)))) == done.done
    undone = done.do_all([FlipSign("knob")], NOW, "Ada").undo().undo()
    assert undone.asset is start.asset
    same(undone.redo().asset, done.asset)
    assert undone.redo().undone == (HistoryEntry(FlipSign("knob"), NOW, "Ada"),)
    same(History.of(cabinet(), undone.redo().redo().done).asset, undone.redo().redo().asset)


def test_a_new_correction_ends_what_could_be_redone():
    history = History.of(cabinet(), entries(ONE_OF_EACH[:2])).undo().do(*entries([FlipSign("door")]))
    assert history.undone == ()
    with pytest.raises(CorrectionError, match="nothing to redo"):
        history.redo()


def test_a_correction_that_is_refused_changes_nothing():
    history = History.of(cabinet())
    with pytest.raises(CorrectionError):
        history.do(*entries([FlipSign("nothing")]))
    assert history.done == ()
    with pytest.raises(CorrectionError, match="nothing to undo"):
        history.undo()


@pytest.mark.parametrize(
    "record",
    [{"correction": "explode"}, {}, {"correction": "flip_sign", "time": "", "author": ""}, {"correction": "change_type",
     "part": "door", "type": "wobbly", "time": "", "author": ""}],
)  # fmt: skip
def test_a_log_that_cannot_be_read_is_refused(record):
    with pytest.raises(CorrectionError):
        unpack_log([record])


def corrected(opened: Opened, *corrections) -> Opened:
    history = opened.history
    for c in corrections:
        history = history.do(HistoryEntry(c, NOW, "Ada"))
    return Opened(opened.folder, history, opened.version)


def urdf_joint(folder: Path, name: str) -> ET.Element:
    return next(j for j in ET.parse(folder / "cabinet.urdf").getroot().iter("joint") if j.get("name") == name)


def content(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_a_save_writes_the_corrected_files_and_keeps_the_original(tmp_path):
    folder = write_output(tmp_path / "out")
    before = content(folder)
    opened = open_asset(folder)
    saved = save_asset(corrected(opened, SetLimits("door", 0.0, 1.25), FlipSign("door"), MergeParts("knob", "drawer")))
    hinge = urdf_joint(folder, "hinge")
    assert float(hinge.find("limit").get("upper")) == 1.25
    assert hinge.find("axis").get("xyz").split()[2] == "-1"
    assert [p["name"] for p in json.loads((folder / "asset.json").read_text())["parts"]] == ["base", "door", "drawer"]
    assert not list((folder / "meshes").glob("knob*"))
    for name in ("stages/mesh.npz", "stages/segmentation.json", "stages/joints.json"):
        assert (folder / name).read_bytes() == before[name]
    log = json.loads((folder / "corrections.json").read_text())["corrections"]
    assert [(e["correction"], e["author"], e["time"]) for e in log] == [
        ("set_limits", "Ada", NOW), ("flip_sign", "Ada", NOW), ("merge_parts", "Ada", NOW),
    ]  # fmt: skip
    again = open_asset(folder)
    assert again.version == saved.version != opened.version
    assert again.history.done == saved.history.done
    assert [j.name for j in again.history.original.joints] == ["hinge", "slide", "turn"]
    assert again.history.original.warnings
    assert not again.history.asset.warnings


def test_what_is_undone_and_saved_is_the_original_again(tmp_path):
    folder = write_output(tmp_path / "out")
    first = (folder / "cabinet.urdf").read_bytes()
    opened = save_asset(corrected(open_asset(folder), FlipSign("door")))
    assert (folder / "cabinet.urdf").read_bytes() != first
    save_asset(Opened(opened.folder, opened.history.undo(), opened.version))
    assert (folder / "cabinet.urdf").read_bytes() == first
    assert json.loads((folder / "corrections.json").read_text())["corrections"] == []


def test_the_same_corrections_give_the_same_bytes(tmp_path):
    folders = [write_output(tmp_path / name / "out") for name in ("a", "b")]
    for folder in folders:
        save_asset(corrected(open_asset(folder), SplitComponents("drawer"), FlipSign("door")))
    a, b = ({n: d for n, d in content(f).items() if n != "timing.json"} for f in folders)
    assert a == b


def test_a_corrected_asset_passes_the_check(tmp_path):
    folder = write_output(tmp_path / "out")
    save_asset(corrected(open_asset(folder), SetLimits("door", 0.0, 1.2), ChangeType("knob", JointType.FIXED)))
    report = check_asset(folder)
    assert report.ok, report.lines()


def test_a_save_over_what_somebody_else_saved_is_refused(tmp_path):
    folder = write_output(tmp_path / "out")
    mine, theirs = open_asset(folder), open_asset(folder)
    save_asset(corrected(theirs, SetLimits("door", 0.0, 1.0)))
    kept = content(folder)
    with pytest.raises(StaleError, match="saved by someone else"):
        save_asset(corrected(mine, FlipSign("door")))
    assert content(folder) == kept
    save_asset(corrected(open_asset(folder), FlipSign("door")))
    assert len(open_asset(folder).history.done) == 2


def test_a_save_while_another_process_saves_is_refused(tmp_path):
    pytest.importorskip("fcntl")
    folder = write_output(tmp_path / "out")
    code = (
        f"import fcntl,os; fd=os.open({str(folder)!r},os.O_RDONLY); fcntl.flock(fd,fcntl.LOCK_EX); print(1,flush=True); input()"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        other.stdout.readline()
        with pytest.raises(StaleError, match="is being saved"):
            save_asset(corrected(open_asset(folder), FlipSign("door")))
        other.communicate("\n")
    save_asset(corrected(open_asset(folder), FlipSign("door")))


def test_a_save_that_fails_or_is_killed_leaves_what_was_there(tmp_path, monkeypatch):
    folder = write_output(tmp_path / "out")
    before = content(folder)
    with monkeypatch.context() as patch:
        patch.setattr("anymesh.correcting.history.write_preview", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            save_asset(corrected(open_asset(folder), FlipSign("door")))
    assert content(folder) == before
    code = (
        "import os, signal, anymesh.correcting.history as s; from anymesh.correcting import *;"
        "s.write_preview = lambda *_: os.kill(os.getpid(), signal.SIGKILL);"
        f"o = open_asset({str(folder)!r});"
        "s.save_asset(Opened(o.folder, o.history.do(HistoryEntry(FlipSign('door'), '', '')), o.version))"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True).returncode == -signal.SIGKILL
    assert content(folder) == before
    save_asset(corrected(open_asset(folder), FlipSign("door")))
    assert (folder / "corrections.json").exists()


def test_files_of_others_stay_and_are_not_taken_for_ours(tmp_path):
    folder = write_output(tmp_path / "out")
    (folder / "notes").mkdir()
    (folder / "notes" / "mine.txt").write_text("keep")
    save_asset(corrected(open_asset(folder), FlipSign("door")))
    assert (folder / "notes" / "mine.txt").read_text() == "keep"
    assert "notes/mine.txt" not in json.loads((folder / "stages" / "files.json").read_text())["files"]


def test_a_finished_asset_is_corrected_after_stage_c(tmp_path):
    folder = write_output(tmp_path / "out", finished=True)
    save_asset(corrected(open_asset(folder), MergeParts("knob", "drawer")))
    asset = open_asset(folder).history.asset
    assert asset.notes == ("walls",)
    assert len(asset.segmentation.parts) == 3
    assert (folder / "stages" / "revision.json").exists()
    assert not (folder / "stages" / "correction.json").exists()


def test_stage_c_builds_on_the_corrections(tmp_path):
    folder = write_output(tmp_path / "out")
    save_asset(corrected(open_asset(folder), MergeParts("knob", "drawer"), FlipSign("door")))
    asset = finish(folder, tmp_path / "finished", completer="off", formats="urdf")
    assert [p.name for p in asset.segmentation.parts] == ["base", "door", "drawer"]
    np.testing.assert_array_equal(asset.joints[0].axis, (0, 0, -1))


def test_a_new_export_keeps_the_corrections(tmp_path):
    folder = write_output(tmp_path / "out")
    save_asset(corrected(open_asset(folder), SetLimits("door", 0.0, 1.25)))
    asset = pipeline.export_asset(folder, formats="urdf")
    assert asset.joints[0].limits == (0.0, 1.25)
    assert (folder / "corrections.json").exists()


def test_a_new_export_keeps_the_other_formats(tmp_path):
    folder = write_output(tmp_path / "out")
    before = json.loads((folder / "asset.json").read_text())["files"]
    assert set(before) == {"urdf", "mjcf", "sdf", "glb"}
    pipeline.export_asset(folder, formats="urdf")
    assert json.loads((folder / "asset.json").read_text())["files"] == before
    assert all((folder / file).exists() for file in before.values())


def test_no_run_takes_corrections_away(tmp_path):
    folder = write_output(tmp_path / "out")
    save_asset(corrected(open_asset(folder), FlipSign("door")))
    kept = content(folder)
    with pytest.raises(OutputError, match="manual corrections"), RunFolder.open(folder) as run:
        run.save(JOINTS, "new", JointResult((), "geometry"))
    with pytest.raises(OutputError, match="manual corrections"):
        RunFolder.create(folder, source=tmp_path / "mesh.glb", force=True)
    assert content(folder) == kept
