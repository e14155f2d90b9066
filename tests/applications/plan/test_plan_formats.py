"""Files hold the trajectory: our JSON comes back as it was, CSV and ROS have its numbers."""

import csv
import json

import numpy as np
import pytest

from anymesh.applications.plan.plans import PlanFormat, gripper_commands, plan_text, read_plan, ros_record, write_plan
from anymesh.cli import run
from anymesh.errors import InputError, OptionError, OutputError

COMMAND = ["plan", "--joint", "door", "--speed", "1", "--to", "40deg"]


def test_json_comes_back(door_plan, tmp_path):
    write_plan(door_plan, tmp_path / "t.json")
    again = read_plan(tmp_path / "t.json")
    for name in ("time", "position", "velocity", "acceleration", "gap", "value"):
        np.testing.assert_allclose(getattr(again.trajectory, name), getattr(door_plan.trajectory, name), atol=1e-8)
    assert again.trajectory.phase == door_plan.trajectory.phase
    assert again.base == door_plan.base
    assert plan_text(again, PlanFormat.JSON) == (tmp_path / "t.json").read_text()


def test_csv_has_a_row_a_sample(door_plan, tmp_path):
    write_plan(door_plan, tmp_path / "t.csv", "csv")
    rows = list(csv.DictReader((tmp_path / "t.csv").open()))
    assert len(rows) == len(door_plan.trajectory.time)
    names = [f"position_{j}" for j in door_plan.trajectory.joints]
    read = np.array([[float(row[n]) for n in names] for row in rows])
    np.testing.assert_allclose(read, door_plan.trajectory.position, atol=1e-8)


def test_ros_has_the_message_fields_and_no_others(door_plan):
    record = json.loads(plan_text(door_plan, PlanFormat.ROS))
    assert record == ros_record(door_plan.trajectory)
    assert set(record) == {"header", "joint_names", "points"}
    last = record["points"][-1]
    assert set(last) == {"positions", "velocities", "accelerations", "effort", "time_from_start"}
    stamp = last["time_from_start"]
    assert stamp["sec"] + stamp["nanosec"] / 1e9 == pytest.approx(door_plan.trajectory.duration)
    assert 0 <= stamp["nanosec"] < 1_000_000_000


def test_the_gripper_opens_closes_and_opens(door_plan):
    gaps = [command["gap"] for command in gripper_commands(door_plan.trajectory)]
    assert len(gaps) == 3
    assert gaps[1] == 0
    assert gaps[0] == gaps[2] > 0


def test_files_are_not_replaced_unasked_and_others_are_no_plans(door_plan, tmp_path):
    path = tmp_path / "t.json"
    path.write_text("{}")
    with pytest.raises(OutputError, match="--force replaces it"):
        write_plan(door_plan, path)
    with pytest.raises(OptionError, match="valid are json, csv, ros"):
        write_plan(door_plan, path, "yaml")
    with pytest.raises(InputError, match="is not a plan of anymesh"):
        read_plan(path)
    assert path.read_text() == "{}"


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
