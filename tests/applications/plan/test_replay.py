"""Test replays with contacts: a trajectory opens the door, and a displaced one fails with the reason reported."""

import csv
import json
import sys

import numpy as np
import pytest

from anymesh.applications.plan.asset_ import open_object
from anymesh.applications.plan.film_ import Film, write_film
from anymesh.applications.plan.planner import open_arm, plan_motion
from anymesh.applications.plan.plans import BasePose, PlanFormat, gripper_commands, plan_text, read_plan, ros_record, write_plan
from anymesh.applications.plan.replay_ import Physics, ReplayFailure, ReplaySimulation, replay
from anymesh.cli import run
from anymesh.errors import InputError, OptionError, OutputError


def test_the_door_opens_and_nothing_passes_through(door_plan, cupboard, arm):
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7)
    assert seen.failure is None
    assert seen.value == pytest.approx(0.7, abs=0.05)
    assert seen.penetration < 0.003
    assert seen.force == 0
    assert seen.lag < 0.03


def test_the_door_stays_shut_when_it_is_elsewhere(door_plan, cupboard, arm):
    off = Physics(shift=(0.1, 0.0, 0.0))
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7, physics=off)
    assert seen.failure in (ReplayFailure.MISSED, ReplayFailure.SLIPPED, ReplayFailure.HIT)
    assert abs(seen.value) < 0.6


def test_a_door_that_resists_is_not_opened(door_plan, cupboard, arm):
    """What moves the part is contact, not a weld: the bar slips out of the fingers."""
    stiff = Physics(damping=10_000.0)  # 2000 N m s/rad
    seen = replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, 0.7, physics=stiff)
    assert seen.failure in (ReplayFailure.SLIPPED, ReplayFailure.SHORT)


def test_the_mass_of_what_moves_is_scaled(cupboard, arm):
    one, two = (
        ReplaySimulation(cupboard, arm.robot, arm.hand, BasePose(0.0, -0.8, 0.0, 1.57), Physics(mass=m)) for m in (1.0, 2.0)
    )
    body = one.model.body("object/door").id
    assert two.model.body_mass[body] == pytest.approx(2 * one.model.body_mass[body])
    assert two.model.body_mass.sum() - one.model.body_mass.sum() == pytest.approx(one.model.body_mass[body])


@pytest.mark.parametrize("wanted", [0.0, float("nan"), float("inf")])
def test_a_replay_needs_a_value_to_reach(door_plan, cupboard, arm, wanted):
    with pytest.raises(OptionError, match="valid is a finite value of door_joint other than 0"):
        replay(door_plan.trajectory, cupboard, arm.robot, arm.hand, door_plan.base, wanted)


def test_a_button_goes_in(things, arm):
    panel = open_object(things / "panel.xml", "button")
    found = plan_motion(panel, arm, -0.01)
    seen = replay(found.trajectory, panel, arm.robot, arm.hand, found.base, -0.01, physics=Physics(spring=300.0))
    assert seen.failure is None
    assert -0.011 < seen.value <= -0.009  # a stop is hard, though the push means to go on by 4 mm


def test_a_film_shows_what_moves(things, cupboard, tmp_path):
    small = open_arm(things / "arm5.xml")
    film = Film(cupboard, small.robot, small.hand, BasePose(0.0, -0.6, 0.0, 1.57))
    states = np.tile(film.model.qpos0, (2, 1))
    states[1, film.model.joint("object/door_joint").qposadr[0]] = 1.0
    camera = film.camera(states, width=96, height=72)
    shut, still, opened = (film.frame(q, camera) for q in states[[0, 0, 1]])
    assert shut.shape == (72, 96, 3)
    assert (shut == still).all()
    assert (shut != opened).any(-1).mean() > 0.02
    with pytest.raises(OptionError, match=r"valid are files that end in .mp4 or .png"):
        write_film(film, states, tmp_path / "film.gif")


def test_without_its_extra_a_film_becomes_a_sheet(things, cupboard, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    small = open_arm(things / "arm5.xml")
    film = Film(cupboard, small.robot, small.hand, BasePose(0.0, -0.6, 0.0, 1.57))
    written = write_film(film, np.tile(film.model.qpos0, (2, 1)), tmp_path / "film.mp4")
    assert written == tmp_path / "film.png"
    assert [p.name for p in tmp_path.iterdir()] == ["film.png"]


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
