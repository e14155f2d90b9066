"""The command line: real meshes to assets, a status; odd names through the whole of it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import trimesh

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
