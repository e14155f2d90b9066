"""Test the comparison of what consumers hold with asset.json, and the motions that readers measure."""

import numpy as np
import pytest

from anymesh.types import JointType, Motion
from benchmarks.consumers.comparing import Truth, compare
from benchmarks.consumers.readers.common import swept

AXIS, ORIGIN = np.array([0.0, 0.6, 0.8]), np.array([0.3, -0.2, 0.1])
DOOR = {
    "type": "revolute", "parent": "base", "child": "door", "origin": ORIGIN.tolist(), "axis": AXIS.tolist(),
    "limits": [0.0, 1.5], "effort": 20.0, "velocity": 3.0, "damping": 0.2, "friction": 0.4,
}  # fmt: skip
TRUTH = Truth({"hinge": DOOR}, {"base": 4.0}, {"base": (np.zeros(3), np.eye(3))}, {}, {})


def turned(amount: float, axis: np.ndarray = AXIS, origin: np.ndarray = ORIGIN) -> np.ndarray:
    return Motion(JointType.REVOLUTE, axis, origin, "test").transform(amount)


def wrong(**held: object) -> list[str]:
    """Return the properties that are not equal, of a door that is held right but for these."""
    right = DOOR | {"armature": 0.0, "moved": turned(0.3).tolist(), "amount": 0.3}
    joint = {key: value for key, value in (right | held).items() if value != "left out" and key not in ("axis", "origin")}
    return [v.property for v in compare(TRUTH, {"joints": {"hinge": joint}}) if not v.equal]


def test_what_is_held_as_written_is_equal() -> None:
    assert wrong() == []


@pytest.mark.parametrize(
    ("held", "found"),
    [
        ({"moved": turned(-0.3).tolist()}, "axes"),
        ({"moved": turned(0.3, origin=ORIGIN + 1e-3).tolist()}, "axes"),
        ({"moved": turned(0.3, axis=np.array([0.0, 0.0, 1.0])).tolist()}, "axes"),
        ({"limits": None}, "limits"),
        ({"limits": [-1.5, 0.0]}, "limits"),
        ({"type": "prismatic"}, "types"),
        ({"child": "base", "parent": "door"}, "types"),
        ({"damping": 0.2 * 180 / np.pi}, "damping"),
        ({"friction": "left out"}, "friction"),
    ],
)
def test_what_differs_or_is_lost_is_found(held: dict, found: str) -> None:
    assert wrong(**held) == [found]


def test_an_axis_that_is_stated_counts_like_one_that_is_measured() -> None:
    for axis, origin, good in ((AXIS, ORIGIN + 2 * AXIS, True), (-AXIS, ORIGIN, False), (AXIS, ORIGIN + 0.01, False)):
        joint = {"type": "revolute", "axis": axis.tolist(), "origin": origin.tolist()}
        (value,) = (v for v in compare(TRUTH, {"joints": {"hinge": joint}}) if v.property == "axes")
        assert value.equal == good


def test_masses_and_inertia_are_compared() -> None:
    record = {"mass": 4.0, "center": [0, 0, 0], "inertia": np.diag([1, 1, 1.1]).tolist()}
    values = compare(TRUTH, {"links": {"base": record}})
    assert [(v.property, v.equal) for v in values] == [("masses", True), ("inertia", False)]


@pytest.mark.parametrize(("most", "limits"), [(1.5, [0.0, 1.5]), (2 * np.pi, None)])
def test_an_animation_tells_motion_and_limits(most: float, limits: list[float] | None) -> None:
    parent = turned(0.7, axis=np.array([1.0, 0.0, 0.0]))  # the parent's frame is not the asset's
    amounts = [*np.linspace(0, most, 13), *np.linspace(most, 0, 13)]
    local = [np.linalg.inv(parent) @ turned(amount) for amount in amounts]
    found = swept(parent, local, slides=False, axis=AXIS)
    np.testing.assert_allclose(found["moved"], turned(found["amount"]), atol=1e-9)
    assert found["amount"] > 0.5
    assert found["limits"] == (limits if limits is None else pytest.approx(limits))


@pytest.mark.parametrize(("axis", "limits"), [([1, 0, 0], [-0.4, 0.1]), ([-1, 0, 0], [-0.1, 0.4])])
def test_the_stated_axis_tells_which_way_an_animation_is_positive(axis: list[int], limits: list[float]) -> None:
    poses = [np.eye(4) for _ in range(3)]
    poses[1][0, 3], poses[2][0, 3] = 0.1, -0.4
    found = swept(np.eye(4), poses, slides=True, axis=axis)
    assert found["limits"] == pytest.approx(limits)
    assert found["moved"][0][3] == pytest.approx(found["amount"] * axis[0])
