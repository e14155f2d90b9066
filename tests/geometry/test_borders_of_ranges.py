"""Test creases of curved surfaces, shared edges and the border of the connecting area."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from assets import box, mesh_of

from anymesh.config import PatchConfig
from anymesh.geometry.creases import convex_regions
from anymesh.geometry.topology import components
from anymesh.motion.part_context import connecting_area


def test_points_at_the_threshold_are_not_closer_than_it() -> None:
    near, far, used = connecting_area(np.array([0.5, 1.0]), np.array([1.0, 0.99]), 1.0)
    assert (near.tolist(), far.tolist(), used) == ([True, False], [False, True], 1.0)
    assert connecting_area(np.array([1.0]), np.array([3.0]), 1.0)[2] == 2.0


@pytest.mark.parametrize("degrees", [20.0, 45.0, 80.0])
def test_wedges_that_share_an_edge_stay_apart(degrees: float) -> None:
    """Two wedges meet at the z axis only."""

    def wedge(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
        flat = np.array([(0, 0), (np.cos(a), np.sin(a)), (np.cos(b), np.sin(b))])
        v = np.concatenate([np.c_[flat, np.zeros(3)], np.c_[flat, np.ones(3)]])
        quads = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
        f = [(0, 2, 1), (3, 4, 5), *(t for a, b, c, d in quads for t in ((a, b, c), (a, c, d)))]
        return v, np.array(f)

    angle = np.deg2rad(degrees)
    mesh, piece = mesh_of([wedge(0, angle), wedge(angle + 0.2, 2 * angle + 0.2)])
    found = components(mesh.vertices, mesh.faces)
    assert (found.label == piece).all()
    assert found.solid.tolist() == [True, True]
    assert not found.flip.any()


def test_a_ball_on_a_plate_is_a_region_of_its_own() -> None:
    """Its surface near the crease is curved, so that mean normals are shorter than 1."""
    ball, plate = trimesh.creation.icosphere(3, 0.3), trimesh.creation.box((1.2, 1.2, 0.2))
    ball.apply_translation((0, 0, 0.3))
    whole = trimesh.boolean.union([ball, plate])
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(whole.vertices, whole.faces, 0.06))
    triangles = np.asarray(fine.triangles, float)
    region = convex_regions(triangles, 1.8, PatchConfig())
    z = triangles[:, :, 2]
    assert set(region[(z > 0.2).all(1)]).isdisjoint(region[(z < 0).any(1)])
    assert len(set(region[(z > 0.2).all(1)])) == 1


def test_a_rounded_box_is_one_region() -> None:
    rounded = trimesh.creation.capsule(0.6, 0.3)
    assert len(set(convex_regions(np.asarray(rounded.triangles, float), 1.5, PatchConfig()))) == 1
    assert len(set(convex_regions(box((0, 0, 0), (1, 1, 1))[0][box((0, 0, 0), (1, 1, 1))[1]], 1.7, PatchConfig()))) == 1
