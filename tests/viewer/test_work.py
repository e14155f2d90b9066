"""A mesh worked on in a child process: what is wrong with it is told, it can be ended at once, and a crash is told too."""

import shutil
import time
from pathlib import Path

import pytest

from anymesh.viewer.intake.work import ArticulationWork

MESHES = Path(__file__).parents[2] / "examples" / "meshes"


def until(what, seconds: float = 60):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.02)


def test_what_is_wrong_with_a_mesh_is_told_and_a_crash_too(tmp_path):
    (tmp_path / "bad.glb").write_bytes(b"glTF but no more")
    bad, crashed = (
        ArticulationWork(path, tmp_path / f"out{k}") for k, path in enumerate((tmp_path / "bad.glb", MESHES / "cabinet.glb"))
    )
    until(lambda: crashed.mesh is not None)
    (child,) = crashed._pool._live
    child._process.kill()
    until(lambda: bad.over and crashed.over)
    assert bad.error.startswith("bad.glb")
    assert "signal 9" in crashed.error
    assert not any(work.done for work in (bad, crashed))
    assert not (tmp_path / "out1").exists()


def test_work_is_ended_at_once(tmp_path):
    work = ArticulationWork(MESHES / "cabinet.glb", tmp_path / "out")
    begin = time.monotonic()
    work.cancel()
    assert time.monotonic() - begin < 2
    assert work.over
    assert work.error is None
    assert not work.done


@pytest.mark.slow
def test_a_mesh_becomes_an_asset_and_its_stages_are_told(tmp_path):
    shutil.copy(MESHES / "storage_box.glb", tmp_path / "box.glb")
    work, seen = ArticulationWork(tmp_path / "box.glb", tmp_path / "out"), []
    until(lambda: (seen.append((work.share, work.words)), work.over)[1])
    assert work.done, work.error
    assert [share for share, _ in seen] == sorted(share for share, _ in seen)
    for words in ("finding the parts", "finding how they move", "writing the files"):
        assert any(told.startswith(words) for _, told in seen)
    assert (tmp_path / "out" / "box.urdf").exists()
    assert len(work.mesh.faces) > 100
