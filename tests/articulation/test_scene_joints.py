"""Test joints of scenes with obvious motions: type, line, direction and range, and their invariance to the frame."""

from functools import cache

import numpy as np
import pytest
from assets import box
from scenes import Scene, door, drawer, joints_of, lid, similarity, slider, wheel

from anymesh.geometry.kinematics import joint_transform
from anymesh.types import Joint, JointType


def stopped_door() -> Scene:
    """Return a door with a post that it hits at a right angle."""
    scene = door("left")
    return {**scene, "base": [*scene["base"], box((0.63, -0.6, 0), (0.66, -0.5, 0.8))]}


SCENES = {
    "left": door("left"),
    "right": door("right"),
    "drawer": drawer(),
    "tilted": drawer(degrees=-20),
    "wheel": wheel(),
    "lid": lid(),
    "slider": slider(),
    "stopped": stopped_door(),
    "shallow": drawer(0.2),
    "shallow tilted": drawer(0.2, -20),
}
THICK = 0.021  # [m] thickness of the plates: the hinge may be at either edge of a plate's rim


@cache
def found(name: str) -> Joint:
    (joint,) = joints_of(SCENES[name]).values()
    return joint


def off_line(joint: Joint, point) -> float:
    return float(np.linalg.norm(np.cross(np.asarray(point) - joint.origin, joint.axis)))


def after(joint: Joint, point, amount: float) -> np.ndarray:
    return (joint_transform(joint, amount) @ [*point, 1])[:3]


@pytest.mark.parametrize(("handle", "hinge_x"), [("left", 0.6), ("right", 0.0)])
def test_a_door_turns_outwards_about_the_side_away_from_its_handle(handle: str, hinge_x: float) -> None:
    joint = found(handle)
    assert joint.type is JointType.REVOLUTE
    assert abs(joint.axis[2]) == pytest.approx(1, abs=1e-6)
    assert off_line(joint, (hinge_x, -0.012, 0)) < THICK
    assert after(joint, (0.6 - hinge_x, -0.012, 0.4), 0.3)[1] < -0.1  # towards the front
    assert joint.limits == (0, pytest.approx(np.deg2rad(110), abs=0.05))


DRAWERS = [("drawer", 0.35, 0), ("tilted", 0.35, -20), ("shallow", 0.2, 0), ("shallow tilted", 0.2, -20)]


@pytest.mark.parametrize(("name", "depth", "degrees"), DRAWERS)
def test_a_drawer_slides_out_along_itself_for_most_of_its_depth(name: str, depth: float, degrees: float) -> None:
    joint = found(name)
    assert joint.type is JointType.PRISMATIC
    a = np.deg2rad(degrees)
    assert joint.axis == pytest.approx(np.array([0, -np.cos(a), -np.sin(a)]), abs=2e-3)
    assert joint.limits is not None
    assert joint.limits[0] == 0
    assert 0.8 * depth < joint.limits[1] < depth


def test_a_wheel_on_an_axle_turns_endlessly_about_it() -> None:
    joint = found("wheel")
    assert (joint.type, joint.limits) == (JointType.CONTINUOUS, None)
    assert abs(joint.axis[1]) == pytest.approx(1, abs=1e-4)
    assert off_line(joint, (0, 0, 0.2)) < 1e-3


def test_a_lid_opens_upwards_about_its_back() -> None:
    joint = found("lid")
    assert joint.type is JointType.REVOLUTE
    assert off_line(joint, (0, 0.4, 0.31)) < THICK
    assert after(joint, (0.3, 0, 0.31), 0.3)[2] > 0.4
    assert joint.limits is not None
    assert joint.limits[0] == 0


def test_a_pane_slides_along_its_rails_as_far_as_they_go() -> None:
    joint = found("slider")
    assert joint.type is JointType.PRISMATIC
    assert joint.axis == pytest.approx(np.array([1, 0, 0]), abs=1e-4)  # it starts at the left, so it opens to the right
    assert joint.limits == (0, pytest.approx(0.5, abs=0.01))


MOVES = [similarity(30, (0.3, -0.2, 0.1), 0.01), similarity(200, (4, 2, -1), 2.5)]


@pytest.mark.parametrize("T", MOVES, ids=["shrunk", "enlarged"])
@pytest.mark.parametrize("name", ["left", "right", "drawer", "tilted", "wheel", "lid", "slider"])
def test_joints_move_with_the_scene(name: str, T: np.ndarray) -> None:
    at_home, factor = found(name), float(np.linalg.norm(T[:3, 0]))
    (joint,) = joints_of(SCENES[name], T).values()
    axis = T[:3, :3] @ at_home.axis / factor
    endless = joint.type is JointType.CONTINUOUS  # neither direction opens
    assert joint.type is at_home.type
    assert (abs(joint.axis @ axis) if endless else joint.axis @ axis) > np.cos(np.deg2rad(0.5))
    if joint.type is not JointType.PRISMATIC:
        assert off_line(joint, T[:3, :3] @ at_home.origin + T[:3, 3]) < THICK * factor
    if at_home.limits is not None:
        unit = factor if joint.type is JointType.PRISMATIC else 1
        assert joint.limits == pytest.approx(np.array(at_home.limits) * unit, abs=0.01 * unit)


def inside(points: np.ndarray, boxes, margin: float) -> np.ndarray:
    """Return which points lie deeper than the margin in one of the boxes."""
    return np.any([((points > v.min(0) + margin) & (points < v.max(0) - margin)).all(1) for v, _ in boxes], axis=0)


def grid(pieces) -> np.ndarray:
    """Return points throughout boxes."""
    unit = np.stack(np.meshgrid(*[np.linspace(0, 1, 9)] * 3), -1).reshape(-1, 3)
    return np.concatenate([v.min(0) + unit * np.ptp(v, axis=0) for v, _ in pieces])


@pytest.mark.parametrize("name", ["left", "drawer", "lid", "slider", "stopped"])
def test_within_its_limits_a_part_meets_nothing(name: str) -> None:
    scene, joint = SCENES[name], found(name)
    assert joint.limits is not None
    points = grid(scene[joint.child])
    for amount in np.linspace(*joint.limits, 25):
        T = joint_transform(joint, float(amount))
        assert not inside(points @ T[:3, :3].T + T[:3, 3], scene["base"], margin=0.006).any()


def test_a_stop_in_the_way_ends_the_range() -> None:
    joint = found("stopped")
    assert joint.limits is not None
    assert np.deg2rad(85) < joint.limits[1] < np.deg2rad(100)  # without the post it is 110


def test_a_pane_slides_as_far_as_the_other_pane_in_its_rails() -> None:
    """Two panes of 0.2 m stand 0.4 m apart between rails of 1 m, each at its end."""
    rails = [box((0, y, z), (1, y + 0.02, z + 0.02)) for y in (-0.05, 0.03) for z in (0, 0.48)]
    ends = [box((x, -0.05, 0), (x + 0.02, 0.05, 0.5)) for x in (-0.02, 1.0)]
    sills = [box((0, -0.03, z), (1, 0.03, z + 0.002)) for z in (-0.002, 0.5)]
    panes = {name: [box((x, -0.028, 0.002), (x + 0.2, 0.028, 0.498))] for name, x in (("left", 0.1), ("right", 0.7))}
    joints = joints_of({"base": [*rails, *ends, *sills], **panes})
    assert {joint.type for joint in joints.values()} == {JointType.PRISMATIC}
    for joint in joints.values():
        assert joint.limits is not None
        assert abs(joint.axis[0]) == pytest.approx(1)
        assert max(joint.limits) == pytest.approx(0.4, abs=0.02)
