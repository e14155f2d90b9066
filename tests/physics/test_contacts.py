"""Test contacts of collision shapes at given poses, on boxes."""

import numpy as np
import pytest
from assets import box, mesh_of, source
from test_shapes import collision_of
from trimesh.boolean import union
from trimesh.creation import box as solid_box

from anymesh.physics.collision import CollisionConfig
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.convex import cut
from anymesh.physics.split import concave_planes
from anymesh.types import Asset, Box, Part, Segmentation


def cube(x: float) -> Box:
    return Box(np.array([x, 0.0, 0.0]), np.eye(3), np.ones(3))


def test_a_pair_of_shapes_has_one_contact_with_the_depth_of_the_overlap() -> None:
    bench = ContactBench({"a": [cube(0), cube(5)], "b": [cube(0.9), cube(5.8)]})
    poses = {"a": np.eye(4), "b": np.eye(4)}
    found = bench.contacts(poses, 0.01)
    assert [(c.first, c.second) for c in found] == [(("a", 0), ("b", 0)), (("a", 1), ("b", 1))]
    assert [c.depth for c in found] == pytest.approx([0.1, 0.2], abs=1e-6)
    for contact, middle in zip(found, (0.45, 5.4), strict=True):
        np.testing.assert_allclose(contact.normal, (1, 0, 0), atol=1e-9)
        assert contact.point[0] == pytest.approx(middle, abs=1e-6)
    assert [c.depth for c in bench.contacts(poses, 0.15)] == pytest.approx([0.2], abs=1e-6)
    away = np.eye(4)
    away[0, 3] = 0.15
    assert [c.second for c in bench.contacts({**poses, "b": away}, 0.01)] == [("b", 1)]


def test_links_that_are_excluded_do_not_touch() -> None:
    bench = ContactBench({"a": [cube(0)], "b": [cube(0.9)]}, [("a", "b")])
    assert bench.contacts({"a": np.eye(4), "b": np.eye(4)}, 0.0) == []


def test_planes_are_ordered_by_the_length_of_their_concave_edges() -> None:
    """Two bars on a slab, 3 x 0.5 and 1 x 0.4: the top of the slab meets all their sides."""
    pieces = [((4, 4, 1), (0, 0, 0.5)), ((3, 0.5, 1), (0, 1, 1.4)), ((1, 0.4, 1), (0, -1, 1.4))]
    solids = []
    for size, middle in pieces:
        solids.append(solid_box(size))
        solids[-1].apply_translation(middle)
    found = concave_planes(np.asarray(union(solids).triangles, float), 20)
    signed = [(tuple(np.round(np.abs(n), 6).tolist()), round(abs(o), 6)) for n, o in found]
    assert signed[0] == ((0, 0, 1), 1)  # 2 * (3 + 0.5) + 2 * (1 + 0.4)
    assert sorted(signed[1:3]) == [((0, 1, 0), 0.75), ((0, 1, 0), 1.25)]  # 3 each
    assert sorted(signed[3:5]) == [((0, 1, 0), 0.8), ((0, 1, 0), 1.2)]  # 1 each
    assert signed[5:7] == [((1, 0, 0), 1.5)] * 2  # 0.5 each
    assert signed[7:] == [((1, 0, 0), 0.5)] * 2  # 0.4 each


@pytest.mark.parametrize(("share", "count"), [(0.2, 1), (0.4, 2)])
def test_components_below_a_share_of_the_gap_get_no_shape(share: float, count: int) -> None:
    """The diagonal of the small cube, in units of the first gap of about 0.02 of the object's diagonal."""
    gap = CollisionConfig().gaps[0] * np.sqrt(3)
    side = share * gap / np.sqrt(3)
    mesh, part = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0, 0, 1 + 1e-6), (side, side, 1 + 1e-6 + side))])
    asset = Asset("block", source(), mesh, Segmentation(0 * part, (Part("base", "base"),)), (), "")
    assert len(collision_of(asset).shapes["base"]) == count


def test_a_plane_through_a_side_divides_no_triangle() -> None:
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    cube = vertices[faces].astype(float)
    bottom = (cube[:, :, 2] == 0).all(1)
    below, above = cut(cube, np.array([0.0, 0.0, 1.0]), 0.0)
    np.testing.assert_array_equal(below, cube[bottom])
    np.testing.assert_array_equal(above, cube[~bottom])
