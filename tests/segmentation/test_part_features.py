"""Test features of candidate parts on a scene with known values, and their invariance to scale, place and yaw."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.segmentation.contacts import find_contacts
from anymesh.segmentation.divide import object_shape
from anymesh.segmentation.part_candidates import part_candidates
from anymesh.segmentation.part_features import FeatureInputs, candidate_context, part_features
from anymesh.types import Mesh

WALLS = [
    box((0, 0, 0), (1, 0.5, 0.05)), box((0, 0, 0.95), (1, 0.5, 1)), box((0, 0, 0.05), (0.05, 0.5, 0.95)),
    box((0.95, 0, 0.05), (1, 0.5, 0.95)), box((0.05, 0.45, 0.05), (0.95, 0.5, 0.95)),
]  # fmt: skip
DOOR = box((0.055, 0.01, 0.055), (0.945, 0.04, 0.945))  # inset, with 5 mm of clearance
KNOB = box((0.85, -0.03, 0.47), (0.89, 0.01, 0.51))


def features(mesh: Mesh, solids: set[int]) -> dict[str, float]:
    whole = object_shape(mesh)
    contacts = find_contacts(whole)
    tree = part_candidates(mesh, whole, contacts)
    candidate = next(k for k, m in enumerate(tree.members) if set(np.flatnonzero(m).tolist()) == solids)
    inputs = FeatureInputs.of(mesh, tree)
    context = candidate_context(inputs, candidate)
    assert context is not None
    return part_features(inputs, candidate, context)


MESH = mesh_of([*WALLS, DOOR, KNOB])[0]


def test_an_inset_door_with_a_knob() -> None:
    f = features(MESH, {5, 6})
    assert f["rims with clearance"] == 4
    assert f["separate"] == 1
    assert f["contact area"] == 0
    assert f["log10 near gap"] == pytest.approx(np.log10(0.005 / 1.5), abs=0.05)
    assert f["open behind"] > 0.9
    assert f["handle"] == 1
    assert f["handle off the middle"] == pytest.approx(0.83, abs=0.1)
    assert f["log copies"] == 0
    assert f["bottom"] == pytest.approx(0.055, abs=1e-6)
    assert f["height"] == pytest.approx(0.5, abs=1e-6)
    assert abs(f["opening direction up"]) < 1e-6


def test_a_wall_is_held_and_not_free() -> None:
    f = features(MESH, {4})
    assert f["separate"] == 0
    assert f["handle"] == 0


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("yaw", [0.0, 90.0])
def test_scale_place_and_yaw_do_not_matter(scale: float, yaw: float) -> None:
    angle = np.deg2rad(yaw)
    T = np.eye(4)
    T[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    T[:3, :3] *= scale
    T[:3, 3] = scale * np.array([3.0, -2.0, 1.0])
    before, after = features(MESH, {5, 6}), features(MESH.transformed(T), {5, 6})
    assert after.keys() == before.keys()
    off = {k: (before[k], after[k]) for k in before if abs(after[k] - before[k]) > 0.05 + 0.05 * abs(before[k])}
    assert not off


def test_the_place_of_the_door_in_the_object() -> None:
    """The object is 1 x 0.53 x 1, with the knob in front; the door and its knob are 0.89 x 0.07 x 0.89."""
    f = features(MESH, {5, 6})
    diagonal = np.sqrt(1 + 0.53**2 + 1)
    expected = {
        "height": 0.5,
        "bottom": 0.055,
        "top": 0.055,
        "horizontal offset": 1 - 2 * 0.035 / 0.53,
        "sides reached": 1,  # the front
        "width share": 0.89,
        "height share": 0.89,
        "opening direction up": 0,
        "visibility": 1,
        "thin side towards opening": 1,
        "offset from the center": (0.235 - 0.005) / diagonal,
        "object height": 1,
    }
    assert {name: f[name] for name in expected} == pytest.approx(expected, abs=1e-6)
