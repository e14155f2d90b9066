"""An internal defect: an exit code of its own, finished stages kept for the next run, a report without anything private."""

import json
import platform
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from anymesh import __version__, pipeline
from anymesh.cli import run
from anymesh.errors import InputError, redacted
from anymesh.pipeline import solving, stages

KEY = "sk-0123456789abcdefghijklmnopqrstuvwxyz"
CALL = ["articulate", "my mesh.stl", "-o", "out", "--up", "z", "--formats", "glb"]


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """A working folder with a mesh, and a key in the environment."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    monkeypatch.setattr(stages, "write_preview", lambda _, path: path.write_bytes(b"drawing takes longest"))
    trimesh.creation.box().export("my mesh.stl")
    return tmp_path


def fail_joints(monkeypatch, told: str) -> None:
    def fails(*_, **__):
        try:
            np.zeros(0).min()
        except ValueError as error:
            raise ValueError(told) from error

    monkeypatch.setattr(solving, "vetted_joints", fails)


def counted(monkeypatch) -> list[str]:
    """The stages that are computed from now on."""
    made: list[str] = []
    for name in ("segment_parts", "vetted_joints"):
        true = getattr(solving, name)
        monkeypatch.setattr(solving, name, lambda *a, true=true, name=name, **k: made.append(name) or true(*a, **k))
    return made


def test_the_report_tells_what_is_needed_and_nothing_private(folder, monkeypatch, capfd) -> None:
    fail_joints(monkeypatch, f"key {KEY}\nat '{folder}/my mesh.stl' and http://me:secret@host/x")
    code = run([*CALL, "--category", "box", "--json"])
    out, err = capfd.readouterr()
    report = folder / "out.defect.json"
    assert (code, json.loads(out)["exit_code"], json.loads(out)["report"]) == (70, 70, str(report))
    assert err.startswith("error: internal defect, ValueError: ")
    assert (err.count("\n"), str(report) in err) == (1, True)
    text = report.read_text()
    found = json.loads(text)
    assert (found["command"], found["stage"], found["error"]) == ("articulate", "joints", "ValueError")
    assert found["message"] == "key [removed] at 'my mesh.stl' and [address]"
    assert (found["options"]["mesh"], found["options"]["out"], found["options"]["category"]) == (["my mesh.stl"], "out", "box")
    assert found["versions"]["anymesh"] == __version__
    assert found["versions"]["python"] == platform.python_version()
    assert all(found["versions"][name] for name in ("numpy", "scipy", "embreex", "mujoco", "manifold3d"))
    assert any(re.match(r"anymesh/pipeline/solving\.py:\d+ joints: ", line) for line in found["traceback"])
    assert any(line.startswith("numpy/") for line in found["traceback"])
    assert "ValueError: zero-size array to reduction operation minimum which has no identity" in found["traceback"]
    for private in (KEY, str(folder), str(Path.home()) + "/", "secret", "OPENAI"):
        assert private not in text


def test_finished_stages_are_kept_and_a_rerun_resumes_after_them(folder, monkeypatch, capfd) -> None:
    with monkeypatch.context() as broken:
        fail_joints(broken, "broken")
        assert run(CALL) == 70
    (kept,) = folder.glob(".out.tmp-*")
    assert {p.name for p in (kept / "stages").glob("*.json")} == {"mesh.json", "segmentation.json"}
    assert not (folder / "out").exists()
    made = counted(monkeypatch)
    assert run(CALL) == 0
    assert made == ["vetted_joints"]
    assert (folder / "out" / "asset.json").exists()
    assert not list(folder.glob(".out.*"))


def test_an_output_that_is_there_is_not_touched(folder, monkeypatch, capfd) -> None:
    assert run(CALL) == 0
    before = {p: p.read_bytes() for p in (folder / "out").rglob("*") if p.is_file()}
    fail_joints(monkeypatch, "broken")
    assert run([*CALL, "--force", "--category", "box"]) == 70
    assert {p: p.read_bytes() for p in (folder / "out").rglob("*") if p.is_file()} == before


def test_python_gets_the_original_exception_with_the_stage(folder, monkeypatch) -> None:
    with monkeypatch.context() as broken:
        fail_joints(broken, "broken")
        with pytest.raises(ValueError, match="broken") as caught:
            pipeline.articulate("my mesh.stl", "out", up="z")
    assert caught.value.__notes__ == ["in the stage joints"]
    assert not list(folder.glob("*.defect.json"))
    made = counted(monkeypatch)
    pipeline.segment("my mesh.stl", "out", up="z")
    assert made == []


def test_nothing_stays_where_no_stage_was_finished_or_the_error_is_ours(folder, monkeypatch) -> None:
    def fails(error):
        def raises(*_, **__):
            raise error

        return raises

    for name, error in (("load_mesh", ValueError("x")), ("write_asset", InputError("x"))):
        with monkeypatch.context() as broken:
            broken.setattr(stages, name, fails(error))
            with pytest.raises(type(error)):
                pipeline.articulate("my mesh.stl", "out")
        assert [p.name for p in folder.iterdir()] == ["my mesh.stl"]


def test_a_command_without_an_output_reports_into_the_working_folder_or_a_temporary_one(folder, monkeypatch, capfd) -> None:
    def fails(*_, **__):
        raise ValueError("x")

    monkeypatch.setattr("anymesh.checking.check_asset", fails)
    assert run(["check", "out"]) == 70
    assert json.loads((folder / "anymesh-check.defect.json").read_text())["stage"] is None
    (folder / "anymesh-check.defect.json").unlink()
    (folder / "anymesh-check.defect.json").mkdir()
    (folder / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder / "tmp"))
    assert run(["check", "out"]) == 70
    assert (folder / "tmp" / "anymesh-check.defect.json").exists()


@pytest.mark.parametrize(
    ("told", "left"),
    [
        ("openai-compatible:http://10.0.0.1:8000/v1#qwen", "openai-compatible:[address]#qwen"),
        ("holopart:/srv/me/holo", "holopart:holo"),
        ("exact+sam:weights/vit_b.onnx", "exact+sam:vit_b.onnx"),
        (r"C:\Users\me\labels.npy", "labels.npy"),
        ("No such file: '/srv/me and you/x.obj'", "No such file: 'x.obj'"),
        ("door,drawer", "door,drawer"),
        ("x" * 40, "[removed]"),
    ],
)
def test_what_is_redacted(told, left) -> None:
    assert redacted(told) == left
