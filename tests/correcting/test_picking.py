"""A click says which edge, plane, axis or patch was meant; turning the object turns the answer."""

import numpy as np
import pytest
from assets import CUBE, box, mesh_of, source

from anymesh.correcting import CorrectionError
from anymesh.correcting.picking import PickedPart
from anymesh.types import Asset, Joint, JointType, Motion, Part, Segmentation

TURNS = [np.eye(4), Motion(JointType.REVOLUTE, np.array([0.6, 0.0, 0.8]), np.array([0.3, 0.1, 0]), "test").transform(0.7)]


def cylinder(radius: float, height: float, sides: int = 32) -> tuple[np.ndarray, np.ndarray]:
    """A closed cylinder about z that stands on z = 0; faces 0 .. 2 sides - 1 are its mantle."""
    t = 2 * np.pi * np.arange(sides) / sides
    ring = np.c_[radius * np.cos(t), radius * np.sin(t)]
    vertices = np.concatenate([np.c_[ring, np.zeros(sides)], np.c_[ring, np.full(sides, height)], [[0, 0, 0], [0, 0, height]]])
    k, n = np.arange(sides), (np.arange(sides) + 1) % sides
    mantle = np.stack([np.c_[k, n, n + sides], np.c_[k, n + sides, k + sides]], 1).reshape(-1, 3)
    return vertices, np.concatenate([mantle, np.c_[n, k, np.full(sides, 2 * sides)], np.c_[k, n, np.full(sides, 0)] + sides])


def asset_of(T: np.ndarray) -> Asset:
    """A box 2 x 1 x 0.5 as base and a cylinder about x = 3."""
    v, f = cylinder(0.4, 1.0)
    f = f.copy()
    f[-32:, 2] = 65
    mesh, part = mesh_of([box((0, 0, 0), (2, 1, 0.5)), (v + np.array([3.0, 0, 0]), f)])
    turn = Joint("j", JointType.FIXED, "base", "barrel", np.zeros(3), np.array([0.0, 0, 1]), None, 1.0, "built so")
    parts = (Part("base", "base"), Part("barrel", "barrel"))
    return Asset("thing", source(), mesh.transformed(T), Segmentation(part, parts), (turn,), "geometry")


def face_at(asset: Asset, point: np.ndarray) -> int:
    return int(np.linalg.norm(asset.mesh.triangles.mean(1) - point, axis=1).argmin())


def at(T: np.ndarray, *point: float) -> np.ndarray:
    return T[:3, :3] @ np.array(point, float) + T[:3, 3]


def assert_line(line, axis, point, T):
    axis = T[:3, :3] @ np.array(axis, float)
    assert abs(line.axis @ axis) == pytest.approx(1)
    assert np.linalg.norm(np.cross(line.origin - at(T, *point), axis)) < 1e-6


@pytest.mark.parametrize("T", TURNS)
def test_the_edge_nearest_to_the_click(T):
    asset = asset_of(T)
    for point, axis, on in (((1, 0.1, 0.5), (1, 0, 0), (0, 0, 0.5)), ((0.1, 0.5, 0.5), (0, 1, 0), (0, 0, 0.5))):
        line = PickedPart(asset, face_at(asset, at(T, *point))).edge(at(T, *point))
        assert_line(line, axis, on, T)
    assert line.how == "snapped to an edge"


@pytest.mark.parametrize("T", TURNS)
def test_the_normal_of_the_plane_through_the_click(T):
    asset = asset_of(T)
    line = PickedPart(asset, face_at(asset, at(T, 1, 0.5, 0.5))).normal(at(T, 1, 0.5, 0.5))
    np.testing.assert_allclose(line.axis, T[:3, 2], atol=1e-9)
    np.testing.assert_allclose(line.origin, at(T, 1, 0.5, 0.5))


@pytest.mark.parametrize("T", TURNS)
def test_the_axis_of_a_round_surface(T):
    asset = asset_of(T)
    assert_line(PickedPart(asset, face_at(asset, at(T, 2.6, 0, 0.5))).symmetry(), (0, 0, 1), (3, 0, 0), T)


def test_a_flat_face_has_no_symmetry_axis():
    asset = asset_of(np.eye(4))
    with pytest.raises(CorrectionError, match="flat"):
        PickedPart(asset, face_at(asset, np.array([1, 0.5, 0.5]))).symmetry()


def test_a_patch_is_the_side_of_a_box_whatever_face_of_it_is_picked():
    asset = asset_of(np.eye(4))
    top = np.flatnonzero((asset.mesh.triangles[:12, :, 2] == 0.5).all(1))
    assert len(CUBE) == 8
    assert len(top) == 2
    for face in top:
        np.testing.assert_array_equal(PickedPart(asset, int(face)).patch(), top)
