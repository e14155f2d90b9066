"""The command line: real meshes to assets, a status; odd names through the whole of it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import trimesh
from dialects import _openai
from model_wire import SECRET, Service

from anymesh.applications.annotate import runner
from anymesh.cli import run

ODD = "a b'\"Tür\n扉" + "x" * 220
OBJECTS = 12


@pytest.fixture
def source(tmp_path, monkeypatch) -> Path:
    """A box with an odd name, and a file that is no mesh."""
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "in"
    folder.mkdir()
    trimesh.creation.box().export(folder / f"{ODD}.stl")
    (folder / "bad.glb").write_text("no mesh")
    return folder


def test_a_collection_ends_in_assets_a_report_and_a_status(tmp_path, source, capfd) -> None:
    out = tmp_path / "out"
    assert run(["annotate", str(source), "-o", str(out), "--json", "--formats", "urdf", "-j", "1"]) == 3
    told = json.loads(capfd.readouterr().out)
    assert (told["counts"]["done"], told["counts"]["quarantined"], told["ended"]) == (1, 1, None)
    (asset,) = (out / "objects").glob("*/*/asset.json")
    assert ODD[:3].replace(" ", "_") in asset.parent.name
    assert json.loads(asset.read_text())["source"]["path"].endswith(f"{ODD}.stl")
    assert {"ledger.sqlite", "report.html", "metrics.prom"} <= {p.name for p in out.iterdir()}
    assert run(["annotate", "--status", str(out)]) == 0
    assert capfd.readouterr().out.strip() == "1 done, 1 quarantined of 2"
    before = asset.stat().st_mtime_ns
    assert run(["annotate", str(source), "-o", str(out), "-q", "--formats", "urdf", "-j", "1"]) == 3
    assert asset.stat().st_mtime_ns == before


def test_wrong_calls_are_one_line(tmp_path, source, capfd) -> None:
    out = str(tmp_path / "out")
    for call, code in (
        ([], 2), ([str(source)], 2), (["--status", str(tmp_path)], 4), ([str(tmp_path / "none"), "-o", out], 3),
        ([str(source), "-o", out, "--workers", "0"], 2), ([str(source), "-o", out, "--formats", "fbx"], 2),
        ([str(source), "-o", out, "--attempts", "0"], 2), ([str(source), "-o", out, "--tokens-per-minute", "0"], 2),
        ([str(source), "-o", out, "--memory", "0.1"], 2),
    ):  # fmt: skip
        assert run(["annotate", *call]) == code, call
        told = capfd.readouterr().err
        assert told.startswith("error: ")
        assert told.count("\n") == 1
    assert not Path(out).exists()  # a mistyped call fixes no options for later ones


def mounted(folder: Path, size: str, *more: str) -> bool:
    """Mount a file system in memory of a size; whether that was possible."""
    options = ",".join([*more, f"size={size}"])
    return subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], capture_output=True).returncode == 0


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    folder = tmp_path / "disk"
    folder.mkdir()
    if not mounted(folder, "1m"):
        pytest.skip("no file system can be mounted here")
    yield folder
    subprocess.run(["umount", folder], check=True)


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="mounts a file system as Linux does")
def test_a_full_file_system_ends_the_run_and_the_next_one_finishes(disk, tmp_path, monkeypatch, capfd) -> None:
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(runner, "FREE", 0)  # go on until nothing can be written
    source, out = tmp_path / "in", disk / "out"
    source.mkdir()
    for k in range(OBJECTS):
        trimesh.creation.box((1, 1 + 0.1 * k, 1)).export(source / f"box_{k}.stl")
    command = ["annotate", str(source), "-o", str(out), "--formats", "urdf", "-j", "1", "--json"]
    assert run(command) == 4  # whether an asset or the ledger was the first that could not be written
    capfd.readouterr()
    finished = {p: p.stat().st_mtime_ns for p in (out / "objects").glob("*/*/asset.json")}
    assert 0 < len(finished) < OBJECTS
    assert mounted(disk, "64m", "remount")
    assert run(command) == 0
    assert json.loads(capfd.readouterr().out)["counts"]["done"] == OBJECTS
    assert len(list((out / "objects").glob("*/*/asset.json"))) == OBJECTS
    assert all(p.stat().st_mtime_ns == at for p, at in finished.items())
    assert not list((out / "objects").glob("*/.*"))


KEYS = ("ANYMESH_API_KEY", "OPENAI_API_KEY", "ANTHROPIC_API_KEY", "GOOGLE_API_KEY", "MESHY_API_KEY", "HF_TOKEN")


@pytest.fixture
def service(tmp_path, monkeypatch) -> Iterator[Service]:
    """A provider that repeats the key in its answers, then in its errors."""
    pytest.importorskip("pydantic_ai")
    for name in [n for n in os.environ if "PROXY" in n.upper()]:
        monkeypatch.delenv(name)
    for number, name in enumerate(KEYS):
        monkeypatch.setenv(name, f"{SECRET}-{number}")
    monkeypatch.setenv("ANYMESH_CACHE", str(tmp_path / "cache"))
    found = Service()

    def answer(handler) -> None:
        number = len(found.seen)
        text = f"I was sent {SECRET}-0 in {found.seen[-1].headers}"
        body = json.dumps(_openai(text, "stop") if number < 3 else {"error": {"message": text}}).encode()
        handler.send_response(200 if number < 3 else 400)
        handler.send_header("content-type", "application/json")
        handler.send_header("content-length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)
        found.turns.append(answer)

    found.turns.append(answer)
    server = found.start()
    yield found
    found.over.set()
    server.shutdown()
    server.server_close()


def leaks(folder: Path) -> list[str]:
    """Files that hold a key, as it is or packed in base64 or hex."""
    import base64

    marks = [SECRET.encode(), SECRET.encode().hex().encode(), base64.b64encode(SECRET.encode())[:12]]
    return [str(p) for p in folder.rglob("*") if p.is_file() and any(mark in p.read_bytes() for mark in marks)]


def test_keys_are_in_no_file_and_no_output_of_a_collection(tmp_path, service, capfd) -> None:
    (tmp_path / "in").mkdir()
    trimesh.creation.box().export(tmp_path / "in" / "box.stl")
    (tmp_path / "in" / f"{'x' * 40}.glb").write_text("no mesh")
    call = [
        "annotate",
        str(tmp_path / "in"),
        "-o",
        str(tmp_path / "out"),
        "--answerer",
        f"openai-compatible:{service.url}/v1#m",
    ]
    run([*call, "-j", "1", "--attempts", "1", "--views", "1@15", "--formats", "urdf"])
    told = capfd.readouterr()
    assert len(service.seen) >= 2
    assert any(SECRET in value for value in service.seen[0].headers.values())  # it was sent, to where it belongs
    assert SECRET not in told.out + told.err
    assert (tmp_path / "out" / "report.html").is_file()
    assert leaks(tmp_path) == []


def test_the_search_would_find_them(tmp_path) -> None:
    (tmp_path / "a").write_text(f"key={SECRET}-0")
    assert len(leaks(tmp_path)) == 1
