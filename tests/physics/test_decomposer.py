"""Test that a failed division of a component falls back to another method for it, with a warning in the asset."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from assets import box, cabinet

from anymesh.export.links import split_links
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.physics.collision import collision_shapes
from anymesh.physics.convex import as_hull
from anymesh.physics.decompose import (
    Component,
    Decomposer,
    Method,
    Resolution,
    divide_here,
)
from anymesh.runtime import Deadline

FINE = Resolution(gap=0.01, wall=0.002, max_pieces=24)


def triangles(*pieces) -> np.ndarray:
    return np.concatenate([v[f] for v, f in pieces])


def bracket() -> Component:
    """Return an L of two blocks, 1 x 1 x 0.2 and 1 x 0.2 x 1, closed, extruded from one outline."""
    outline = np.array([[0, 0], [1, 0], [1, 0.2], [0.2, 0.2], [0.2, 1], [0, 1]], float)
    n = len(outline)
    low, high = (np.c_[np.full(n, x), outline] for x in (0.0, 1.0))
    cap = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    faces = np.concatenate([cap[:, ::-1], cap + n, np.stack([i, j, j + n], 1), np.stack([i, j + n, i + n], 1)])
    return Component(np.concatenate([low, high])[faces], True)


class FakePool(ChildPool):
    """Fails for some methods like a child process, and divides in this process for the others."""

    def __init__(self, *failing: Method, failure: Failure = Failure.CRASH) -> None:
        super().__init__(2)
        self.failing, self.failure, self.calls, self.seconds = failing, failure, [], []

    def run(self, module, function, arguments, *, seconds):
        self.seconds.append(seconds)
        self.calls.append((arguments["method"], len(arguments["batch"])))
        if arguments["method"] in self.failing:
            raise ChildError(self.failure, "signal 11")
        return divide_here(**arguments)


def test_children_divide_as_this_process_does_and_keep_the_order():
    components = [bracket(), Component(triangles(box((0, 0, 0), (1, 2, 3))), True)]
    with ChildPool(2, ChildLimits(60.0)) as pool:
        found = Decomposer(pool, None, 30.0).divide(components, [FINE, FINE])
    assert [len(d.shapes) for d in found] == [2, 1]
    assert [d.fallback for d in found] == [None, None]


def test_pieces_do_not_depend_on_the_number_of_threads():
    turn = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    x, y = np.cos(turn), np.sin(turn)
    wall = [(1.0, 0.0), (1.0, 1.0), (0.9, 1.0), (0.9, 0.1)]  # of a cup, radius and height
    rings = [np.c_[r * x, r * y, np.full(12, h)] for r, h in wall]
    i, j = np.arange(12), (np.arange(12) + 1) % 12
    sides = [np.concatenate([np.stack([a[i], a[j], b[j]], 1), np.stack([a[i], b[j], b[i]], 1)]) for a, b in pairwise(rings)]
    ends = [
        np.stack([np.tile([0, 0, h], (12, 1)), ring[a], ring[b]], 1)
        for ring, h, a, b in ((rings[0], 0, j, i), (rings[3], 0.1, i, j))
    ]
    cup = Component(np.concatenate([*sides, *ends]), True)
    made = []
    for size in (1, 2):
        with ChildPool(size, ChildLimits(60.0)) as pool:
            made.append(Decomposer(pool, None, 30.0).divide([cup], [FINE])[0])
    assert len(made[0].shapes) > 4
    assert made[0].fallback is None
    for a, b in zip(made[0].shapes, made[1].shapes, strict=True):
        np.testing.assert_array_equal(as_hull(a).vertices, as_hull(b).vertices)


@pytest.mark.parametrize(
    ("failing", "used"),
    [
        ((Method.SOLID,), Method.CLEANED.value),
        ((Method.SOLID, Method.CLEANED), Method.SURFACE.value),
        (tuple(Method), "one convex hull"),
    ],
)
def test_a_crash_costs_one_component_its_way_of_division(failing, used):
    components = [bracket(), Component(triangles(box((0, 0, 0), (1, 2, 3))), True)]
    found = Decomposer(FakePool(*failing), None, 30.0).divide(components, [FINE, FINE])
    assert found[0].fallback.used == used
    assert [reason.split(":")[0] for reason in found[0].fallback.reasons] == [method.value for method in failing]
    assert "crash: signal 11" in found[0].fallback.reasons[0]
    assert all(d.shapes for d in found)


def test_what_takes_too_long_is_cut_by_planes_at_once():
    pool = FakePool(Method.SOLID, failure=Failure.TIME)
    (found,) = Decomposer(pool, None, 30.0).divide([bracket()], [FINE])
    assert [method for method, _ in pool.calls] == [Method.SOLID, Method.SURFACE]
    assert found.fallback.used == Method.SURFACE.value


def test_what_a_fallback_made_is_not_kept(tmp_path):
    Decomposer(FakePool(Method.SOLID), tmp_path, 30.0).divide([bracket()], [FINE])
    assert not list(tmp_path.glob("*.npz"))
    pool = FakePool()
    for _ in range(2):
        (found,) = Decomposer(pool, tmp_path, 30.0).divide([bracket()], [FINE])
        assert found.fallback is None
    assert pool.calls == [(Method.SOLID, 1)]  # the second result comes from the cache


def test_copies_are_divided_once():
    pool, shift = FakePool(), np.array([3.1, -0.7, 0.2])
    moved = replace(bracket(), triangles=bracket().triangles + shift)
    one, other = Decomposer(pool, None, 30.0).divide([bracket(), moved], [FINE, FINE])
    assert pool.calls == [(Method.SOLID, 1)]
    for a, b in zip(one.shapes, other.shapes, strict=True):
        np.testing.assert_allclose(as_hull(a).vertices + shift, as_hull(b).vertices, atol=1e-8)


def test_the_asset_names_the_link_whose_collision_fell_back():
    asset = cabinet()
    links = split_links(asset)
    where = {k.name: k.triangles for k in links}, {k.name: k.origin for k in links}
    plain = collision_shapes(asset, *where, pool=FakePool())
    fallen = [collision_shapes(asset, *where, pool=FakePool(Method.SOLID)) for _ in range(2)]
    assert plain.warnings == ()
    assert {w.split(":")[0] for w in fallen[0].warnings} == {f"link {name}" for name in plain.shapes}
    assert all("exact cuts of the cleaned solid, since" in w and "crash: signal 11" in w for w in fallen[0].warnings)
    assert fallen[0].warnings == fallen[1].warnings
    for link, shapes in fallen[0].shapes.items():
        again = fallen[1].shapes[link]
        assert [as_hull(s).vertices.tobytes() for s in shapes] == [as_hull(s).vertices.tobytes() for s in again]


def test_past_the_deadline_components_get_one_hull_each():
    asset = cabinet()
    links = split_links(asset)
    late = Deadline(1e-9)
    pool = FakePool()
    found = collision_shapes(
        asset, {k.name: k.triangles for k in links}, {k.name: k.origin for k in links}, deadline=late, pool=pool
    )
    assert pool.calls == []
    assert all(found.shapes.values())
    assert any("one convex hull per component" in w for w in found.warnings)
