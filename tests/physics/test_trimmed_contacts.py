"""Test which shapes are trimmed or refined to remove a false contact, on two cubes."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box

from anymesh.physics.clear import ComponentShapes, ContactScene, LinkSurface, clear
from anymesh.physics.convex import as_hull, fitted, hull_of, volume
from anymesh.physics.decompose import Component


def solid(low, high) -> np.ndarray:
    v, f = box(low, high)
    return v[f]


def cleared(first: tuple, second: tuple, levels: int = 1, rounds: int = 3, refined: list | None = None):
    """Clear a contact of two boxes of links whose surfaces do not cross."""
    surfaces = {"a": LinkSurface(solid((0, 0, 0), (0.1, 0.1, 0.1))), "b": LinkSurface(solid((9, 9, 9), (9.1, 9.1, 9.1)))}
    scene = ContactScene(surfaces, [dict.fromkeys("ab", np.eye(4))], 1e-4, 1e-3)
    cubes = {"a": solid(*first), "b": solid(*second)}
    shapes = [ComponentShapes(n, Component(t, True), 0, (fitted(hull_of(t.reshape(-1, 3))),)) for n, t in cubes.items()]

    def refine(components, to):
        assert refined is not None
        refined.append(list(to))
        return [(fitted(hull_of(c.triangles.reshape(-1, 3) * 0.5)),) for c in components]

    found = clear(scene, shapes, refine, levels=levels, rounds=rounds)
    return found, [sum(volume(as_hull(s)) for s in p.shapes) for p in found.pieces]


BIG, SMALL = ((0, 0, 0), (1, 1, 1)), ((0.4, 0.4, 0.98), (0.6, 0.6, 1.18))


@pytest.mark.parametrize("swapped", [False, True])
def test_of_two_shapes_in_contact_the_one_that_loses_less_is_trimmed(swapped: bool) -> None:
    """Two centimetres are 2 % of the large cube and a tenth of the small one."""
    found, (a, b) = cleared(*((SMALL, BIG) if swapped else (BIG, SMALL)))
    large, small = (b, a) if swapped else (a, b)
    assert small == pytest.approx(0.008)
    assert large == pytest.approx(0.98, abs=0.002)
    assert (found.before, found.left) == (1, ())


def test_a_contact_that_would_cost_much_refines_its_components_first_and_is_trimmed_at_the_last_level() -> None:
    """Both cubes would lose a fifth."""
    deep = ((0, 0, 0.8), (1, 1, 1.8))
    refined: list = []
    _, volumes = cleared(BIG, deep, levels=2, refined=refined)
    assert refined[0] == [1, 1]
    _, last = cleared(BIG, deep, levels=1)
    assert sorted(last) == pytest.approx([0.8, 1.0], abs=0.002)
    kept, _ = cleared(BIG, deep, levels=1, rounds=0)
    assert (kept.before, kept.left) == (1, (("a", "b"),))
    assert len(volumes) == 2
