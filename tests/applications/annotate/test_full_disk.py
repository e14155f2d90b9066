"""A collection on a file system that is full: nothing is lost, and the next run finishes it."""

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

OBJECTS = 12


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
    assert run(command) == 4
    told = json.loads(capfd.readouterr().out)
    assert 0 < told["counts"]["done"] < OBJECTS
    assert told["counts"].get("quarantined", 0) == 0
    finished = {p: p.stat().st_mtime_ns for p in (out / "objects").glob("*/*/asset.json")}
    assert len(finished) == told["counts"]["done"]
    assert mounted(disk, "64m", "remount")
    assert run(command) == 0
    assert json.loads(capfd.readouterr().out)["counts"]["done"] == OBJECTS
    assert len(list((out / "objects").glob("*/*/asset.json"))) == OBJECTS
    assert all(p.stat().st_mtime_ns == at for p, at in finished.items())
    assert not list((out / "objects").glob("*/.*"))
