"""The command writes what was planned, says it in one JSON object, and ends with the code of its error."""

import json

import numpy as np
import pytest

from anymesh.applications.plan.formats import read_plan
from anymesh.cli import run

COMMAND = ["plan", "--joint", "door", "--speed", "1", "--to", "40deg"]


def test_the_command_plans_and_draws_with_a_robot_by_path(things, tmp_path, capsys):
    out, picture = tmp_path / "t.json", tmp_path / "t.png"
    wanted = [*COMMAND, str(things / "cupboard.xml"), "--robot", str(things / "arm5.xml")]
    code = run([*wanted, "-o", str(out), "--video", str(picture), "--json"])
    told = json.loads(capsys.readouterr().out)
    assert code == 0
    assert read_plan(out).value[1] == pytest.approx(np.deg2rad(40))
    assert told["replay"]["outcome"] == "done"
    assert picture.read_bytes()[:4] == b"\x89PNG"


def test_errors_have_their_codes(things, tmp_path, capsys):
    out = str(tmp_path / "t.json")
    robot = ["--robot", str(things / "arm5.xml")]
    assert run([*COMMAND[:-1], "170deg", str(things / "cupboard.xml"), *robot, "-o", out]) == 2
    assert "the nearest value is 103.1 deg" in capsys.readouterr().err
    assert run([*COMMAND, str(tmp_path / "nothing"), *robot, "-o", out]) == 3
    assert not (tmp_path / "t.json").exists()
