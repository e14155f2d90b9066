"""An asset that version 0.2.0 wrote (asset.json 1.2: a box with a door, in all formats) is read by every command of today."""

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

from anymesh.cli import run
from anymesh.runtime import read_json
from anymesh.viewer.session import Session

SHIPPED = Path(__file__).with_name("asset_1_2.zip")


@pytest.fixture
def old(tmp_path: Path) -> Path:
    with zipfile.ZipFile(SHIPPED) as file:
        file.extractall(tmp_path / "box")
    assert record(tmp_path / "box")["schema_version"] == "1.2"
    return tmp_path / "box"


def record(folder: Path) -> dict:
    found = read_json(folder / "asset.json")
    assert found is not None
    return found


def test_it_passes_the_check(old: Path, capsys: pytest.CaptureFixture) -> None:
    assert run(["check", str(old), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["failures"] == 0


def test_export_writes_it_anew_with_the_same_joint(old: Path) -> None:
    (before,) = record(old)["joints"]
    assert run(["export", str(old), "--quiet"]) == 0
    written = record(old)
    (after,) = written["joints"]
    assert written["schema_version"] > "1.2"
    assert {key: after[key] for key in ("name", "type", "parent", "child", "reason")} == {
        key: before[key] for key in ("name", "type", "parent", "child", "reason")
    }
    for key in ("origin", "axis", "limits"):
        np.testing.assert_allclose(after[key], before[key])
    assert set(written["files"]) >= {"urdf", "mjcf", "usd", "sdf", "glb"}


def test_finish_reads_it(old: Path, tmp_path: Path) -> None:
    assert run(["finish", str(old), "-o", str(tmp_path / "finished"), "--quiet"]) == 0
    assert [j["name"] for j in record(tmp_path / "finished")["joints"]] == ["door_joint"]


def test_it_is_viewed_reported_and_drawn(old: Path, tmp_path: Path) -> None:
    session = Session(old, "Ada", lambda: "2026-11-29T12:00:00+00:00")
    assert [(j.name, j.limits[0]) for j in session.asset.joints if j.limits] == [("door_joint", 0.0)]
    assert run(["report", str(old), "-o", str(tmp_path / "box.html"), "--quiet"]) == 0
    assert "door_joint" in (tmp_path / "box.html").read_text(encoding="utf-8")
    assert run(["picture", str(old), "-o", str(tmp_path / "box.png"), "--quiet"]) == 0
    assert (tmp_path / "box.png").stat().st_size > 1000
