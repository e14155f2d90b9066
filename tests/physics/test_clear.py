"""Test which contacts are false, their order, and what is trimmed or refined, on cubes at hand-worked depths."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from assets import box
from scipy.spatial.transform import Rotation

from anymesh.physics.clear import ComponentShapes, ContactScene, LinkSurface, clear, placed_hull
from anymesh.physics.contacts_ import ContactBench
from anymesh.physics.convex import as_hull, fitted, hull_of, volume
from anymesh.physics.decompose import Component
from anymesh.types import Box, Shape

X = np.eye(3)[0]


def cube(x: float, y: float = 0.0, size: float = 1.0) -> Box:
    return Box(np.array([x, y, 0.0]), np.eye(3), np.full(3, size))


def at(x: float = 0.0, turn=(0, 0, 0)) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[0, 3] = Rotation.from_rotvec(np.deg2rad(turn)).as_matrix(), x
    return T


def tiny(link: str) -> LinkSurface:
    """Return a surface far away from those of other links, in the middle of no cube."""
    v, f = box(*(np.full(3, 50.0 + 10 * ord(link) + d) for d in (0, 0.1)))
    return LinkSurface(v[f])


def surface(x: float, size: float = 1.0) -> LinkSurface:
    v, f = box((x - size / 2, -size / 2, -size / 2), (x + size / 2, size / 2, size / 2))
    return LinkSurface(v[f])


def piece(link: str, *shapes: Shape, level: int = 0) -> ComponentShapes:
    v, f = box((0, 0, 0), (1, 1, 1))
    return ComponentShapes(link, Component(v[f], True), level, shapes)


def scene_of(*poses: dict[str, np.ndarray], surfaces: dict[str, LinkSurface] | None = None) -> ContactScene:
    return ContactScene({name: tiny(name) for name in poses[0]} | (surfaces or {}), poses, 1e-4, 1e-3)


def test_false_contacts_are_the_deepest_of_each_pair_of_shapes_deepest_first() -> None:
    rest = {"a": at(), "b": at(), "c": at()}
    scene = scene_of(rest, rest | {"b": at(-0.05)}, rest | {"b": at(0.01)})
    pieces = [piece("a", cube(-9), cube(0)), piece("c", cube(1.7)), piece("b", cube(0.9))]
    found = scene.faults(pieces)
    assert [(f.first, f.second) for f in found.found] == [((2, 0), (1, 0)), ((0, 1), (2, 0))]
    assert [f.depth for f in found.found] == pytest.approx([0.21, 0.15], abs=1e-6)
    assert found.found[0].pose is scene.poses[2]
    assert found.found[1].pose is scene.poses[1]
    assert found.found[1].normal == pytest.approx(X, abs=1e-9)
    assert found.poses == (0, 1, 2)
    some = scene.faults(pieces, [2])
    assert [f.depth for f in some.found] == pytest.approx([0.21, 0.09], abs=1e-6)
    assert some.poses == (2,)
    calls = iter([False, True])
    assert scene.faults(pieces, None, lambda: next(calls)).poses == (0,)


def test_contacts_where_surfaces_cross_or_overlap_at_rest_are_not_false() -> None:
    rest = {"a": at(), "b": at(5)}
    scene = scene_of(rest, {"a": at(), "b": at(0.9)}, surfaces={"a": surface(0), "b": surface(0, 0.9)})
    pieces = [piece("a", cube(0)), piece("b", cube(0))]
    assert scene.overlapping == ()
    assert scene.faults(pieces).found == []
    apart = replace(scene, surfaces={"a": surface(0), "b": surface(0, 0.7)})
    assert [f.depth for f in apart.faults(pieces).found] == pytest.approx([0.1], abs=1e-6)
    inside = replace(apart, poses=[rest | {"b": at(0.6)}, *scene.poses])
    assert inside.overlapping == (("a", "b"),)
    assert inside.faults(pieces).found == []


@pytest.mark.parametrize(("crossing", "found"), [(0.04, True), (0.06, False)])
def test_links_overlap_if_their_surfaces_penetrate_by_more_than_the_crossing_depth(crossing: float, found: bool) -> None:
    v, f = box((0.45, 0.2, -0.1), (0.8, 0.4, 0.1))  # beside the diagonals of the cube's sides
    surfaces = {"z": surface(0), "m": LinkSurface(v[f]), "k": surface(7)}
    scene = ContactScene(surfaces, [dict.fromkeys("zmk", at())], 1e-4, crossing)
    assert scene.overlapping == ((("m", "z"),) if found else ())


def cleared(pieces: list[ComponentShapes], *poses, levels: int = 1, rounds: int = 4, refine=None):
    found = clear(scene_of(*poses), pieces, refine or (lambda some, to: pytest.fail("refined")), levels=levels, rounds=rounds)
    volumes = [sum(volume(as_hull(s)) for s in p.shapes) for p in found.pieces]
    return found, volumes


REST = {"a": at(), "b": at()}


@pytest.mark.parametrize(("overlap", "levels"), [(0.14, 2), (0.69, 1)])
def test_shapes_are_trimmed_if_they_lose_little_or_at_the_last_level(overlap: float, levels: int) -> None:
    """15 % at first, 70 % at last."""
    found, volumes = cleared([piece("a", cube(0)), piece("b", cube(1 - overlap))], REST, levels=levels)
    assert volumes == pytest.approx([1 - overlap, 1], abs=5e-4)  # the first one of two that lose the same
    assert (found.before, found.left) == (1, ())


def test_a_contact_deeper_than_seven_tenths_stays() -> None:
    found, volumes = cleared([piece("b", cube(0)), piece("a", cube(0.28))], REST)
    assert volumes == pytest.approx([1, 1])
    assert (found.before, found.left) == (1, (("a", "b"),))


@pytest.mark.parametrize(("rounds", "volumes", "left"), [(1, [1, 1], 1), (2, [0.8, 1], 0)])
def test_a_round_refines_both_components_and_the_next_one_trims_them(rounds: int, volumes: list, left: int) -> None:
    asked = []

    def refine(components, levels):
        asked.append((len(components), list(levels)))
        return [(cube(0),), (cube(0.8),)]

    pieces = [piece("a", cube(0)), piece("b", cube(0.8))]
    found, after = cleared(pieces, REST, levels=2, rounds=rounds, refine=refine)
    assert asked == [(2, [1, 1])]
    assert [p.level for p in found.pieces] == [1, 1]
    assert after == pytest.approx(volumes, abs=5e-4)
    assert len(found.left) == left


def test_only_components_below_the_last_level_are_refined() -> None:
    asked = []

    def refine(components, levels):
        asked.append((len(components), list(levels)))
        return [(cube(0.8, size=0.1),)]

    pieces = [piece("a", cube(0), level=1), piece("b", cube(0.8))]
    found, after = cleared(pieces, REST, levels=2, refine=refine)
    assert asked == [(1, [1])]
    assert [p.level for p in found.pieces] == [1, 1]
    assert len(after) == 2


@pytest.mark.parametrize("turn", [(0, 0, 0), (0, 0, 90), (90, 0, 0), (0, 180, 0)])
@pytest.mark.parametrize("swapped", [False, True])
def test_turned_links_are_trimmed_where_they_touch(turn, swapped: bool) -> None:
    """A plate at x = 1.4 touches a cube of a turned link, which reaches to 1.5."""
    own = Rotation.from_rotvec(np.deg2rad(turn)).inv().apply(X)
    bar, plate = piece("a", Box(own, np.eye(3), np.ones(3))), piece("b", Box(2.4 * X, np.eye(3), np.array([2.0, 9, 9])))
    pose = {"a": at(0, turn), "b": at()}
    found, volumes = cleared([plate, bar] if swapped else [bar, plate], pose)
    moved, kept = volumes[::-1] if swapped else volumes
    assert (moved, kept) == (pytest.approx(1), pytest.approx(162 * (1 - 0.05), rel=1e-4)) or (moved, kept) == (
        pytest.approx(0.9, abs=2e-4),
        pytest.approx(162),
    )
    shapes = {p.link: list(p.shapes) for p in found.pieces}
    assert ContactBench(shapes).contacts(pose, 1e-4) == []
    ends = placed_hull(shapes["a"][0], pose["a"]) @ X, placed_hull(shapes["b"][0], pose["b"]) @ X
    assert 0 <= ends[1].min() - ends[0].max() < 5e-4


def test_each_pose_and_each_shape_is_cleared() -> None:
    poses = [REST, REST | {"b": at(-0.05)}, REST | {"b": at(0, (0, 0, 180))}]
    pieces = [piece("a", cube(-1.9), cube(0)), piece("b", cube(0.96))]
    found, _ = cleared(pieces, *poses)
    shapes = {p.link: list(p.shapes) for p in found.pieces}
    assert found.before == 2
    assert found.left == ()
    for pose in poses:
        assert ContactBench(shapes).contacts(pose, 1e-4) == []
    assert sum(volume(as_hull(s)) for some in shapes.values() for s in some) > 3 * 0.85


def test_false_contacts_stay_after_the_deadline() -> None:
    pieces, asked = [piece("a", cube(0)), piece("b", cube(0.9))], []

    def late() -> bool:
        asked.append(1)
        return len(asked) > 1

    found = clear(scene_of(REST), pieces, lambda some, to: [], levels=1, rounds=4, late=late)
    assert (found.before, found.left) == (1, (("a", "b"),))
    assert found.pieces[0].shapes == pieces[0].shapes
    hull = hull_of(np.concatenate([as_hull(cube(0)).vertices, [[0, 0, 0.9]]]))
    assert hull is not None
    assert not isinstance(fitted(hull), Box)


def test_no_components_give_no_faults() -> None:
    found = scene_of({"a": at()}).faults([])
    assert (found.found, found.poses) == ([], ())


BIG, SMALL = ((0, 0, 0), (1, 1, 1)), ((0.4, 0.4, 0.98), (0.6, 0.6, 1.18))


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
