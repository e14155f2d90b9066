"""Test the files and options of the page that accepts meshes."""

import shutil

import pytest
from fake_bench import CUBE, FakeWork, until, upload

from anymesh.errors import OptionError
from anymesh.viewer import bench_
from anymesh.viewer.server_ import serve

pytest.importorskip("viser", reason="needs the extra view")


def test_kept_assets_get_names_of_their_own_and_the_same_mesh_the_same_questions(monkeypatch, tmp_path):
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    FakeWork.made = []
    source = tmp_path / "in" / "cube.obj"
    source.parent.mkdir()
    source.write_bytes(CUBE)
    for _ in range(2):
        options = {"ask": True, "out": tmp_path / "out", "author": "Ada", "clock": lambda: ""}
        with serve(source, port=8420, **options) as serving:
            assert str(tmp_path / "out") in serving.notes[0]
            FakeWork.made[-1].finish()
            until(lambda: serving.page.session is not None)
    first, second = FakeWork.made
    assert (first.out.name, second.out.name) == ("cube", "cube-2")
    assert first.options["answerer"] == second.options["answerer"]
    assert (tmp_path / "out" / "cube-2" / "asset.json").exists()


def test_what_was_handed_over_is_removed_at_the_end(monkeypatch):
    monkeypatch.setattr(bench_, "ArticulationWork", FakeWork)
    with serve(None, port=8440, author="Ada", clock=lambda: "") as serving:
        assert "removed at the end" in serving.notes[0]
        upload(serving.page)
        folder = serving.page.bench._bench.folder
        assert folder.exists()
    assert FakeWork.made[-1].cancelled
    assert not folder.exists()


@pytest.mark.parametrize(
    ("target", "options"),
    [(None, {"ask": True}), ("missing.glb", {"ask": True}), (".", {"ask": True}), (".", {"out": "x"})],
)
def test_options_that_do_not_go_together_are_refused(tmp_path, monkeypatch, target, options):
    monkeypatch.chdir(tmp_path)
    shutil.rmtree(tmp_path / "x", ignore_errors=True)
    with pytest.raises(OptionError), serve(target, author="Ada", clock=lambda: "", **options):
        pass
