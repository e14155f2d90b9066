"""Test shares and thicknesses of shapes at other sizes than 1 m."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box
from test_trimmed_contacts import BIG, SMALL

from anymesh.physics.clear import ComponentShapes, ContactScene, LinkSurface, clear
from anymesh.physics.convex import as_hull, fitted, hull_of, volume
from anymesh.physics.decompose import Component, smallest_box
from anymesh.physics.split import cutting_planes


@pytest.mark.parametrize("scale", [0.05, 1.0, 20.0])
@pytest.mark.parametrize("swapped", [False, True])
def test_the_smaller_share_is_trimmed_at_any_size(scale: float, swapped: bool) -> None:
    """Two centimetres of a cube of 1 m and of one of 0.2 m, all of them scaled."""
    cubes = [np.asarray(v * scale)[f] for v, f in (box(*corners) for corners in ((SMALL, BIG) if swapped else (BIG, SMALL)))]
    far = [LinkSurface(scale * (0.1 * cubes[0] / scale + shift)) for shift in (0.0, 9.0)]
    scene = ContactScene(dict(zip("ab", far, strict=True)), [dict.fromkeys("ab", np.eye(4))], 1e-4 * scale, 1e-3 * scale)
    shapes = [
        ComponentShapes(name, Component(t, True), 0, (fitted(hull_of(t.reshape(-1, 3))),))
        for name, t in zip("ab", cubes, strict=True)
    ]
    found = clear(scene, shapes, lambda components, levels: [], levels=1, rounds=3)
    large, small = sorted((sum(volume(as_hull(s)) for s in p.shapes) / scale**3 for p in found.pieces), reverse=True)
    assert small == pytest.approx(0.008)
    assert large == pytest.approx(0.98, abs=0.002)


def test_the_smallest_box_is_around_the_link_and_as_thick_as_a_wall() -> None:
    point = as_hull(smallest_box(np.full((1, 3, 3), 5.0), 0.002)).vertices
    assert point.min(0) == pytest.approx([4.999] * 3)
    assert point.max(0) == pytest.approx([5.001] * 3)
    line = as_hull(smallest_box(np.array([[[0.0, 0, 0], [2, 0, 0], [1, 0, 0]]]), 0.5)).vertices
    assert np.stack([line.min(0), line.max(0)]) == pytest.approx(np.array([[0, -0.25, -0.25], [2, 0.25, 0.25]]))


@pytest.mark.parametrize("scale", [0.1, 10.0])
def test_cutting_planes_are_between_the_inner_corners_too(scale: float) -> None:
    """A step in the middle of a bar gives a plane at the step."""
    v, f = box((0, 0, 0), (1, 0.2, 0.2))
    step, g = box((0, 0, 0.2), (0.4, 0.2, 0.4))
    triangles = scale * np.concatenate([v[f], step[g]])
    found = [abs(o) / scale for n, o in cutting_planes(triangles, 0.01 * scale) if abs(n[0]) > 0.9]
    assert sorted(round(o, 6) for o in set(found)) == [0.01, 0.4, 0.5, 0.99]
    for n, offset in cutting_planes(triangles, 0.01 * scale):
        along = triangles.reshape(-1, 3) @ n
        assert along.min() + 0.0099 * scale < offset < along.max() - 0.0099 * scale
