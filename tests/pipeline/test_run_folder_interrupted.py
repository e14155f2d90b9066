"""Test that an interrupted run leaves the output complete or absent, and that files of others are kept."""

import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from assets import cabinet
from run_folders import files, results, write_all

from anymesh.errors import RESUMES, OutputError
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.stage_files import MESH


def test_an_interrupt_keeps_finished_stages_for_the_same_command(tmp_path, source):
    def stopped(key):
        with RunFolder.create(tmp_path / "out", source=source) as run:
            if key:
                run.save(MESH, key, results(cabinet())[0])
            raise KeyboardInterrupt

    def interrupted(key):
        with pytest.raises(KeyboardInterrupt) as stop:
            stopped(key)
        return stop.value

    assert getattr(interrupted(""), "__notes__", []) == []  # nothing was finished yet
    assert [p.name for p in tmp_path.iterdir()] == ["in"]
    assert interrupted("m").__notes__ == [RESUMES]
    assert interrupted("").__notes__ == [RESUMES]  # what the run before it finished is still there
    with RunFolder.create(tmp_path / "out", source=source) as run:
        assert run.load(MESH, "m") is not None
    assert {p.name for p in tmp_path.iterdir()} == {"in", "out"}


def test_an_exception_leaves_nothing_or_the_old(tmp_path, source):
    def broken(force):
        with RunFolder.create(tmp_path / "out", source=source, force=force) as run:
            run.save(MESH, "m2", results(cabinet())[0])
            raise OutputError

    with pytest.raises(OutputError):
        broken(False)
    assert [p.name for p in tmp_path.iterdir()] == ["in"]
    write_all(tmp_path / "out", source)
    before = files(tmp_path / "out")
    with pytest.raises(OutputError):
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
from pathlib import Path
from test_run_folder import results, cabinet
from anymesh.pipeline.stage_files import MESH
from anymesh.pipeline.run_folder import RunFolder
with RunFolder.create(Path(sys.argv[1]), source=Path(sys.argv[2])) as run:
    run.save(MESH, "m", results(cabinet())[0])
    print("ready", flush=True)
    time.sleep(60)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL and file locks")
def test_a_killed_run_leaves_no_output_and_its_stages_are_taken_over(tmp_path, source):
    out = tmp_path / "out"
    command = [sys.executable, "-c", CHILD, str(out), str(source)]
    paths = [*map(str, Path(__file__).parents[:2]), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
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
