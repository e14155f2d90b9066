"""The command line: real meshes to assets, a status; odd names through the whole of it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import trimesh

from anymesh.cli import run

EXAMPLES = Path(__file__).parents[3] / "examples" / "meshes"
ODD = "a b'\"Tür\n扉" + "x" * 220


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
