"""Test that a run with a short time limit still gives an asset, and states what was left out."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from PIL import Image

import anymesh
from anymesh import runtime as module
from anymesh.cli import run
from anymesh.errors import OptionError
from anymesh.pipeline import stages
from anymesh.runtime import Deadline

EXAMPLES = Path(__file__).parents[2] / "examples"
CABINET = EXAMPLES / "meshes" / "cabinet.glb"


def test_a_deadline_is_late_past_a_share_of_its_limit(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    deadline = Deadline(10.0)
    assert not deadline.late(0.4)
    now[0] = 104.1
    assert deadline.late(0.4)
    assert not deadline.late(0.7)
    assert not Deadline().late(0.0001)


@pytest.mark.parametrize("seconds", [0.0, -1.0, math.nan])
def test_a_limit_that_is_not_positive_is_refused(seconds):
    with pytest.raises(OptionError, match="--time-limit"):
        Deadline(seconds)


def test_what_is_left_out_is_told_once():
    deadline = Deadline(5.0)
    for _ in range(3):
        deadline.leave_out("joints: fewer")
    assert deadline.warnings() == ("time limit of 5 s: joints: fewer",)
    assert deadline.warnings() == ()


def test_without_time_nothing_is_examined_and_the_asset_says_so(tmp_path):
    asset = anymesh.articulate(CABINET, tmp_path / "out", time_limit=0.001)
    assert asset.joints == ()
    assert any("candidates for parts were not examined" in w for w in asset.warnings)
    assert any("one convex hull per component" in w for w in asset.warnings)
    assert asset.warnings.count("time limit of 0.001 s: preview: it shows only the list of joints") == 1
    assert asset.warnings == tuple(json.loads((tmp_path / "out" / "asset.json").read_text())["warnings"])
    with Image.open(tmp_path / "out" / "preview.png") as picture:
        assert picture.height < 100  # one line of the legend
    assert (tmp_path / "out" / "cabinet.urdf").is_file()


def test_a_run_without_a_limit_loads_libraries_before_it_draws_beside(tmp_path, monkeypatch):
    """OpenUSD hangs now and then if another thread works while it is imported."""
    order, draw = [], stages.write_preview
    monkeypatch.setattr(stages, "load_libraries", lambda formats: order.append([str(f) for f in formats]))
    monkeypatch.setattr(stages, "write_preview", lambda *given: [order.append("preview"), draw(*given)])
    anymesh.articulate(EXAMPLES / "meshes" / "bookcase.glb", tmp_path / "out", time_limit=math.inf, formats="urdf")
    assert order == [["urdf"], "preview"]


def test_given_parts_get_joints_from_the_likeliest_motions(tmp_path):
    labels = EXAMPLES / "truth" / "cabinet.npy"
    asset = anymesh.articulate(CABINET, tmp_path / "out", parts=str(labels), time_limit=0.001)
    assert len(asset.joints) == 5
    assert any("only the most likely motions were swept" in w for w in asset.warnings)


@pytest.mark.slow
def test_another_limit_computes_the_stages_anew(tmp_path):
    anymesh.articulate(CABINET, tmp_path / "out", time_limit=0.001)
    asset = anymesh.articulate(CABINET, tmp_path / "out", force=True)
    assert len(asset.joints) == 5
    assert not any("time limit" in w for w in asset.warnings)


def test_the_command_line_refuses_a_limit_of_nothing(tmp_path, capsys):
    assert run(["articulate", str(CABINET), "-o", str(tmp_path / "out"), "--time-limit", "0"]) == 2
    assert "--time-limit" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_pause_does_not_count(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    deadline = Deadline(10.0)
    with deadline.paused():
        now[0] = 5000.0
    assert not deadline.late(0.4)
    now[0] = 5004.1
    assert deadline.late(0.4)
