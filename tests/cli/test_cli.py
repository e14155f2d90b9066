"""The command line: exit codes, what is said where, and what is left on disk."""

import json
from pathlib import Path

import pytest
import trimesh
from assets import CABINET
from called import FACES, PARTS, called, contents
from PIL import Image

from anymesh import __version__
from anymesh.pipeline import results, solving


@pytest.mark.parametrize("command", [[], ["articulate"], ["segment"], ["joints"], ["export"]])
@pytest.mark.parametrize("flag", ["-h", "--help"])
def test_help_names_the_exit_codes(command, flag, capfd) -> None:
    code, out, err = called(capfd, *command, flag)
    assert (code, err) == (0, "")
    assert "Usage" in out
    assert "130 interrupted" in " ".join(out.split())


def test_no_command_shows_the_help(capfd) -> None:
    code, out, err = called(capfd)
    assert (code, err) == (2, "")
    assert "articulate" in out
    assert out.strip() == called(capfd, "--help")[1].strip()


def test_version(capfd) -> None:
    assert called(capfd, "--version") == (0, f"anymesh {__version__}\n", "")


def test_output_is_text_or_json_or_nothing(mesh, capfd) -> None:
    call = ["articulate", mesh, "-o", "out", *PARTS]
    code, out, err = called(capfd, *call)
    assert (code, err) == (0, "")
    assert all(word in out for word in ("door ", "drawer ", "hinge left, vertical", "up axis z (given)", "cabinet.urdf"))
    assert {"cabinet.urdf", "cabinet.glb", "preview.png", "asset.json"} <= set(contents(Path("out")))
    assert called(capfd, *call, "--force", "--quiet") == (0, "", "")
    code, out, err = called(capfd, *call, "--force", "--json")
    assert (code, err) == (0, "")
    told, asset = json.loads(out), json.loads(Path("out/asset.json").read_text())
    assert told["parts"] == [p["name"] for p in asset["parts"]]
    assert set(told["parts"]) == set(CABINET)
    for said, written in zip(told["joints"], asset["joints"], strict=True):
        assert [said[k] for k in ("name", "type", "parent", "child")] == [
            written[k] for k in ("name", "type", "parent", "child")
        ]
        assert said["axis"] == pytest.approx(written["axis"], abs=1e-9)
        assert said["limits"] == (written["limits"] and pytest.approx(written["limits"], abs=1e-9))


def test_stages_run_alone_write_the_same_bytes(mesh, capfd) -> None:
    assert called(capfd, "articulate", mesh, "-o", "whole", *PARTS, "--formats", "urdf", "-q")[0] == 0
    code, out, _ = called(capfd, "segment", mesh, "-o", "stages", *PARTS, "--json")
    assert code == 0
    assert sum(part["faces"] for part in json.loads(out)["parts"]) == FACES
    assert not Path("stages/asset.json").exists()
    code, out, _ = called(capfd, "joints", "stages", "--json")
    assert code == 0
    assert {j["child"] for j in json.loads(out)["joints"]} == set(CABINET) - {"base"}
    assert called(capfd, "export", "stages", "--formats", "urdf", "--quiet") == (0, "", "")
    whole, stages = contents(Path("whole")), contents(Path("stages"))
    assert set(whole) == set(stages)
    assert [name for name in whole if whole[name] != stages[name]] in ([], ["timing.json"])


def test_an_interrupt_is_an_object_where_one_is_asked_for(mesh, monkeypatch, capfd) -> None:
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(solving, "segment_parts", interrupted)
    code, out, err = called(capfd, "articulate", mesh, "-o", "out", "--json")
    assert (code, err) == (130, "interrupted; the same command resumes\n")
    assert json.loads(out) == {"error": "interrupted", "kind": "KeyboardInterrupt", "exit_code": 130, "resumes": True}


def test_the_category_changes_keys_and_the_note_on_size(mesh, capfd) -> None:
    for out, more in (("plain", []), ("told", ["--category", "cabinet"])):
        assert called(capfd, "articulate", mesh, "-o", out, *PARTS, *more, "--formats", "urdf", "-q")[0] == 0
    plain, told = contents(Path("plain")), contents(Path("told"))
    assert plain.keys() == told.keys()
    changed = {name for name in plain if plain[name] != told[name]} - {"timing.json"}
    assert changed == {"asset.json", "stages/mesh.json", "stages/segmentation.json", "stages/joints.json"}


def test_a_root_admits_textures_and_computes_the_mesh_anew(mesh, capfd) -> None:
    box = trimesh.creation.box().export(file_type="obj", include_texture=False)
    Path("model/meshes").mkdir(parents=True)
    Path("model/meshes/box.obj").write_text(f"mtllib box.mtl\nusemtl red\n{box}")
    Path("model/meshes/box.mtl").write_text("newmtl red\nmap_Kd ../skins/red.png\nmap_Ke model://model/skins/red.png\n")
    Path("model/skins").mkdir()
    Image.new("RGB", (2, 2), "red").save("model/skins/red.png")
    call = ["segment", "model/meshes/box.obj", "-o", "out", *PARTS]
    keys = []
    for root, count in ((), 2), (("--root", "model"), 0):
        assert called(capfd, *call, *root, "--force", "--quiet") == (0, "", "")
        saved = json.loads(Path("out/stages/mesh.json").read_text())
        assert len([w for w in saved["result"]["warnings"] if "red.png" in w]) == count
        keys.append(saved["key"])
    assert keys[0] != keys[1]
    code, out, err = called(capfd, *call, "--root", "model/skins", "--force")
    assert (code, out) == (2, "")
    assert err.startswith("error: --root: ")


def test_several_meshes_need_batch_and_a_batch_goes_on_past_what_fails(mesh, capfd) -> None:
    Path("other").mkdir()
    Path("other/cabinet.glb").write_bytes(mesh.read_bytes())
    Path("broken.obj").write_text("v nothing")
    code, _, err = called(capfd, "articulate", mesh, "broken.obj", "-o", "out", *PARTS)
    assert (code, "several need --batch" in err) == (2, True)
    code, _, err = called(capfd, "articulate", mesh, "other/cabinet.glb", "-o", "out", "--batch", *PARTS)
    assert (code, "have the same" in err) == (2, True)
    call = ("articulate", "broken.obj", mesh, "-o", "out", "--batch", "--formats", "urdf", *PARTS)
    code, out, err = called(capfd, *call, "--json")
    told = json.loads(out)
    assert (code, [o["state"] for o in told["objects"]]) == (3, ["failed", "done"])
    assert Path("out/cabinet/asset.json").is_file()
    before = contents(Path("out/cabinet"))
    assert called(capfd, *call, "--quiet")[0] == 3
    assert contents(Path("out/cabinet")) == before  # what is there stays
    other = trimesh.load(mesh)
    other.apply_scale(1.1)
    other.export(mesh)
    code, out, _ = called(capfd, *call, "--json")
    assert [o["state"] for o in json.loads(out)["objects"]] == ["failed", "failed"]
    assert "another version of the mesh" in out


def test_an_unsure_joint_says_what_would_help(mesh, capfd, monkeypatch) -> None:
    monkeypatch.setattr(results, "LOW_CONFIDENCE", 1.1)
    code, out, _ = called(capfd, "articulate", mesh, "-o", "out", "--formats", "urdf", *PARTS)
    assert code == 0
    (line,) = [line for line in out.splitlines() if "files:FOLDER" in line]
    assert "correct a joint in `anymesh view out`" in line
