"""Test that collision shapes keep round openings: most of a ball in each stays free, by few pieces."""

from __future__ import annotations

import json

import numpy as np
import pytest
from manifold3d import CrossSection, Manifold

import anymesh
from anymesh.errors import OptionError
from anymesh.physics.collision import merged_hulls
from anymesh.physics.convex import as_hull, hull_of
from anymesh.physics.decompose import Component, Resolution, component_shapes
from anymesh.physics.openings import NONE, Openings, openings_of
from anymesh.types import Hull


def triangles_of(solid: Manifold) -> np.ndarray:
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts, np.int64)]


def rod(radius: float, length: float, sides: int) -> Manifold:
    return Manifold.cylinder(length, radius, radius, sides, True)


def tube(sides: int) -> Manifold:
    return rod(0.05, 0.1, sides) - rod(0.04, 0.3, sides)


def bored_plate(sides: int) -> Manifold:
    return Manifold.cube((0.2, 0.15, 0.02), True) - rod(0.04, 1, sides)


def torus(sides: int) -> Manifold:
    return CrossSection.circle(0.03, 16).translate((0.07, 0)).revolve(sides)


def mug(sides: int) -> Manifold:
    return rod(0.05, 0.1, sides) - rod(0.04, 0.1, sides).translate((0, 0, 0.01))


def turned(triangles: np.ndarray) -> np.ndarray:
    a, b = np.cos(0.5), np.sin(0.5)
    return triangles @ np.array([[1, 0, 0], [0, a, b], [0, -b, a]]) @ np.array([[a, b, 0], [-b, a, 0], [0, 0, 1]]) + [3, -2, 1]


def divided(triangles: np.ndarray, solid: bool = True) -> tuple[list, Openings]:
    """The hulls of a component, and its openings."""
    gap = 0.02 * float(np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0)))
    hull = hull_of(triangles.reshape(-1, 3))
    assert hull is not None
    shapes = component_shapes(Component(triangles, solid), Resolution(gap, gap / 10, 24))
    return [as_hull(shape) for shape in shapes], openings_of(triangles, hull, gap, solid=solid)


@pytest.mark.parametrize("sides", [8, 12, 33, 128])
@pytest.mark.parametrize("shape", [tube, bored_plate, torus, mug])
def test_a_ball_of_nine_tenths_of_a_bore_stays_free_by_few_pieces(shape, sides) -> None:
    hulls, openings = divided(turned(triangles_of(shape(sides))))
    middle = np.argmax(openings.radii)
    assert 0.97 <= openings.radii[middle] / (0.04 * np.cos(np.pi / sides)) < 1.2  # wider above the middle of a torus
    assert openings.round[middle]
    free = min(openings.distances(hull)[middle] for hull in hulls)
    assert free > 0.9 * min(0.04, float(openings.radii[middle]))
    assert len(hulls) <= 11 + (shape is mug)


def test_a_long_pipe_and_a_wide_plate_keep_narrow_bores() -> None:
    pipe = rod(0.025, 1.0, 48) - rod(0.02, 2.0, 48)
    plate = Manifold.cube((1.0, 0.8, 0.02), True) - rod(0.04, 1, 48)
    for solid in (pipe, plate):
        hulls, openings = divided(triangles_of(solid))
        assert openings.round.any()
        assert openings.share_kept(hulls) > 0.9
        assert 7 <= len(hulls) <= 11


def test_several_bores_are_kept_each() -> None:
    solid = Manifold.cube((0.3, 0.3, 0.02), True)
    places = [(x, y, 0.0) for x in (-0.08, 0.08) for y in (-0.08, 0.08)]
    for place in places:
        solid -= rod(0.03, 1, 48).translate(place)
    hulls, openings = divided(triangles_of(solid))
    assert {tuple(c) for c in np.round(openings.centers[:, :2], 2).tolist()} == {place[:2] for place in places}
    assert max(float(openings.lost(hull).max()) for hull in hulls) < 0.02
    assert len(hulls) <= 40


def test_a_sheet_rolled_to_a_tube_stays_open() -> None:
    turn = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    low, high = (np.c_[0.04 * np.cos(turn), 0.04 * np.sin(turn), np.full(48, z)] for z in (0.0, 0.1))
    a, b, c, d = low, np.roll(low, -1, 0), np.roll(high, -1, 0), high
    hulls, openings = divided(np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]), solid=False)
    assert openings.share_kept(hulls) > 0.9


def test_convex_solids_and_boxes_with_walls_have_no_round_openings() -> None:
    box = triangles_of(Manifold.cube((1, 1, 1), True))
    assert divided(box)[1] is NONE
    drawer = Manifold.cube((1, 1, 0.5), True) - Manifold.cube((0.9, 0.9, 0.5), True).translate((0, 0, 0.05))
    hulls, openings = divided(triangles_of(drawer))
    assert not openings.round.any()
    assert openings.share_kept(hulls) == pytest.approx(1, abs=1e-3)
    assert len(hulls) == 5


def test_the_same_solid_gives_the_same_pieces() -> None:
    first, second = (divided(triangles_of(tube(40)))[0] for _ in range(2))
    assert all(np.array_equal(a.vertices, b.vertices) for a, b in zip(first, second, strict=True))


def test_merged_hulls_take_least_of_the_openings() -> None:
    hulls, openings = divided(triangles_of(Manifold.cube((0.2, 0.15, 0.02), True) - rod(0.04, 1, 48)))
    shares = [openings.share_kept(merged_hulls(hulls, openings, most)) for most in (1, 2, 4, 6, len(hulls))]
    assert shares == sorted(shares)
    assert shares[0] == 0
    assert shares[2] > 0.5
    assert shares[-1] > 0.9
    apart = [Hull(hulls[0].vertices + np.array([k, 0, 0]), hulls[0].faces) for k in range(30)]
    assert [len(merged_hulls(apart, NONE, most)) for most in (1, 7, 30, 40)] == [1, 7, 30, 30]


def test_shapes_of_each_link_are_limited_and_the_kept_share_is_stated(tmp_path) -> None:
    path = tmp_path / "tube.obj"
    corners = triangles_of(tube(32)).reshape(-1, 3).tolist()
    faces = [f"f {k} {k + 1} {k + 2}" for k in range(1, len(corners), 3)]
    path.write_text("\n".join([*(f"v {x} {y} {z}" for x, y, z in corners), *faces]))
    for most, kept in ((None, None), (3, 0.9), (9, 1.0)):
        out = tmp_path / str(most)
        anymesh.articulate(path, out, parts="none", up="z", scale="1", formats="urdf", hulls=most)
        record = json.loads((out / "asset.json").read_text())
        part = record["parts"][0]
        assert record.get("hulls") == most
        assert sum(part["collision"].values()) <= (most or 10)
        assert ("openings" in part) == (most is not None)
        assert any("--hulls" in text for text in record["warnings"]) == (most == 3)
        assert kept is None or part["openings"] <= kept
    with pytest.raises(OptionError, match="--hulls"):
        anymesh.articulate(path, tmp_path / "no", hulls=-1)
