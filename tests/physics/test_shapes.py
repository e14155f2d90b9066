"""Test convex shapes of links: close to the surface, thin for thin surfaces, and replaced by primitives that fit."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import CUBE_FACES, box, cabinet, joint, mesh_of, source

from anymesh.export.links import split_links
from anymesh.export.model import ExportConfig
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.physics.collision import CollisionConfig, collision_shapes
from anymesh.physics.convex import _unit_hulls, as_hull, cut, fitted, hull_of, trimmed, volume
from anymesh.physics.decompose import (
    Resolution,
    component_shapes,
    split_components,
)
from anymesh.physics.inertia import Inertia, link_inertia, physical, raw_inertia
from anymesh.physics.split import split_surface
from anymesh.physics.substances import SUBSTANCES, substance_of
from anymesh.types import Asset, Box, Cylinder, Hull, Part, Segmentation

FINE = Resolution(gap=0.02, wall=0.002, max_pieces=24)


def triangles(vertices, faces):
    return np.asarray(vertices, float)[faces]


def turned(points, seed=4):
    q = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return points @ (q * np.sign(np.linalg.det(q)))


def open_box(size=(0.6, 0.4, 0.5)):
    """Return five single-sided walls; the front (-y) is open."""
    v, f = box((0, 0, 0), size)
    t = v[f]
    return t[~(t[:, :, 1] == 0).all(1)]


def collision_of(asset: Asset, **changes):
    links = split_links(asset)
    config = replace(CollisionConfig(), **changes)
    return collision_shapes(asset, {k.name: k.triangles for k in links}, {k.name: k.origin for k in links}, config)


def inside(shapes, points):
    """Return which points lie in a shape."""
    found = np.zeros(len(points), bool)
    for shape in shapes:
        hull = as_hull(shape)
        t = hull.vertices[hull.faces]
        n = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
        found |= (((points[:, None] - t[None, :, 0]) * n).sum(2) <= 1e-12).all(1)
    return found


@pytest.mark.parametrize("turn", [False, True])
def test_boards_become_boxes_of_the_same_volume(turn):
    asset = cabinet()
    if turn:
        whole = Segmentation(0 * asset.segmentation.face_part, (Part("all", "all"),))
        mesh = replace(asset.mesh, vertices=turned(asset.mesh.vertices))
        asset = replace(asset, mesh=mesh, segmentation=whole, joints=())
    shapes = [s for some in collision_of(asset, rest_gap=0.0).shapes.values() for s in some]
    assert all(isinstance(s, Box) for s in shapes)
    t = asset.mesh.triangles
    exact = np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6
    assert sum(float(s.size.prod()) for s in shapes) == pytest.approx(exact, rel=1e-6)


def test_a_round_bar_is_a_cylinder_and_an_eight_sided_one_is_not():
    for sides, kind in ((48, Cylinder), (8, Hull)):
        mesh = trimesh.creation.cylinder(0.1, 0.5, sections=sides)
        shape = fitted(hull_of(turned(np.asarray(mesh.vertices))))
        assert isinstance(shape, kind)
        if isinstance(shape, Cylinder):
            assert (shape.radius, shape.length) == (pytest.approx(0.1, rel=0.01), pytest.approx(0.5))
            assert np.linalg.det(shape.rotation) == pytest.approx(1)


def test_the_hull_of_a_box_has_the_corners_of_the_box():
    """The box is 2 by 4 by 6, turned by a quarter about z, so that it is 4 by 2 by 6 along the axes."""
    _unit_hulls.cache_clear()  # so that coverage counts this test among those that run it
    quarter = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    hull = as_hull(Box(np.array([1.0, 2, 3]), quarter, np.array([2.0, 4, 6])))
    corners = {(x, y, z) for x in (-1, 3) for y in (1, 3) for z in (0, 6)}
    assert len(hull.vertices) == 8
    assert {tuple(v) for v in hull.vertices.round(9).tolist()} == corners
    assert volume(hull) == pytest.approx(48)


def test_a_cut_keeps_the_volume_of_both_sides():
    whole = hull_of(turned(np.random.default_rng(0).normal(size=(40, 3))))
    normal = np.array([0.6, 0.0, 0.8])
    below, above = trimmed(whole, normal, 0.2), trimmed(whole, -normal, -0.2)
    assert volume(below) + volume(above) == pytest.approx(volume(whole), rel=1e-9)
    surface = whole.vertices[whole.faces]
    parts = cut(surface, normal, 0.2)
    area = [np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum() for t in (surface, *parts)]
    assert area[1] + area[2] == pytest.approx(area[0], rel=1e-9)
    assert (parts[0] @ normal).max() <= 0.2 + 1e-9
    assert (parts[1] @ normal).min() >= 0.2 - 1e-9


@pytest.mark.parametrize("turn", [False, True])
def test_an_open_shell_stays_thin_and_hollow(turn):
    shell = open_box()
    middle = np.array([[0.3, 0.2, 0.25], [0.05, 0.05, 0.05], [0.3, 0.0, 0.25]])
    if turn:
        shell, middle = turned(shell), turned(middle)
    hulls = split_surface(shell, gap=0.02, wall=0.002, max_pieces=24)
    assert not inside(hulls, middle).any()
    for hull in hulls:
        assert distance_to_triangles(hull.vertices, shell).max() <= 0.02
    on_walls = shell.mean(1)
    assert np.min([distance_to_triangles(on_walls, h.vertices[h.faces]) for h in hulls], axis=0).max() <= 0.003


def test_a_solid_with_a_cavity_is_decomposed_and_stays_open():
    outer = trimesh.creation.box((1, 1, 1))
    inner = trimesh.creation.box((0.8, 0.8, 1), at(0, 0, 0.2))
    solid = trimesh.boolean.difference([outer, inner], engine="manifold")
    (component,) = split_components(triangles(solid.vertices, solid.faces), 0.0)
    assert component.solid
    shapes = component_shapes(component, FINE)
    assert len(shapes) > 4
    assert not inside(shapes, np.array([[0, 0, 0.0], [0.35, 0.35, 0.45], [0, 0, 0.49]])).any()
    assert inside(shapes, np.array([[0, 0, -0.45], [0.45, 0, 0], [-0.45, 0.1, 0.2]])).all()
    assert sum(volume(as_hull(s)) for s in shapes) == pytest.approx(float(solid.volume), rel=0.05)


def test_a_component_needs_a_hull_only_if_another_lies_within_its_bounds(monkeypatch):
    made = []
    monkeypatch.setattr("anymesh.physics.decompose.hull_of", lambda corners: made.append(corners.max()) or hull_of(corners))
    pieces = [box((0, 0, 0), (size, size, size)) for size in (3.0, 2.0, 1.0)]
    shifted = [triangles(v + 10 * k, f) for k, (v, f) in enumerate(pieces)]
    assert len(split_components(np.concatenate(shifted), 0.0)) == 3
    assert made == []
    inner, outer = box((8, 8, 8), (9, 9, 9)), box((5, 5, 5), (12, 12, 12))
    assert len(split_components(np.concatenate([shifted[0], triangles(*inner), triangles(*outer)]), 0.0)) == 2
    assert made == [12]  # the largest corner coordinate of the outer one


def test_inside_out_solids_are_turned():
    v, f = box((0, 0, 0), (1, 2, 3))
    (found,) = split_components(v[f[:, ::-1]], 0.0)
    normal = np.cross(found.triangles[:, 1] - found.triangles[:, 0], found.triangles[:, 2] - found.triangles[:, 0])
    assert ((found.triangles.mean(1) - v.mean(0)) * normal).sum(1).min() > 0


def at(*place):
    return trimesh.transformations.translation_matrix(place)


def sliding(gap: float, depth: float = 0.0, wall: float = 0.03) -> Asset:
    """Return a solid case with a tight drawer.

    gap: clearance [m]; depth: penetration of the drawer into the floor [m].
    """
    outer = trimesh.creation.box((0.5, 0.5, 0.3))
    inner = trimesh.creation.box((0.5 - 2 * wall, 0.5, 0.3 - 2 * wall), at(0, -wall, 0))
    case = trimesh.boolean.difference([outer, inner], engine="manifold")
    half = np.array([0.25 - wall - gap, 0.25 - wall / 2 - gap, 0.15 - wall - gap])
    middle = np.array([0, -wall / 2, -depth])
    body = trimesh.creation.box(2 * half, at(*middle))
    scoop = trimesh.creation.box(2 * half - [0.03, 0.03, 0.0], at(*(middle + np.array([0, 0, 0.02]))))
    tray = trimesh.boolean.difference([body, scoop], engine="manifold")
    mesh, part = mesh_of([(case.vertices, case.faces), (tray.vertices, tray.faces)])
    slide = joint("slide", "prismatic", "case", "tray", middle, (0, -1, 0), (0.0, 0.3))
    return Asset("drawer", source(), mesh, Segmentation(part, (Part("case", "case"), Part("tray", "tray"))), (slide,), "")


def test_a_tight_drawer_is_free_and_open_after_clearing():
    coarse = collision_of(sliding(0.002), gaps=(0.3,), rounds=0)
    assert coarse.tight == (("case", "tray"),)  # one hull each fills the case, as this test requires
    found = collision_of(sliding(0.002), gaps=(0.3, 0.006))
    assert found.false_before > 0
    assert found.tight == ()
    assert found.overlapping == ()
    assert not inside(found.shapes["tray"], np.array([[0, -0.015, 0.1], [0.0, -0.1, 0.0]])).any()
    assert inside(found.shapes["case"], np.array([[0.235, 0, 0], [0, 0, -0.135], [0, 0.235, 0]])).all()


def test_links_that_overlap_at_rest_are_listed():
    assert collision_of(sliding(0.002, depth=0.02)).overlapping == (("case", "tray"),)


CONFIG = ExportConfig()


def triangles_of(*pieces):
    return np.concatenate([v[f] for v, f in pieces])


def blob():
    mesh = trimesh.creation.icosphere(2)
    return mesh.vertices[mesh.faces] * (0.1, 0.2, 0.3) + (0.4, -0.2, 0.1)


def assert_equal(a: Inertia, b: Inertia):
    assert a.mass == pytest.approx(b.mass, rel=1e-9)
    np.testing.assert_allclose(a.center, b.center, atol=1e-9)
    np.testing.assert_allclose(a.tensor, b.tensor, rtol=1e-7, atol=1e-12)


def rotation(seed=3):
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.sign(np.linalg.det(q))


def test_box_is_exact():
    found = link_inertia(triangles_of(box((1, 2, 3), (1.2, 2.3, 3.5))), CONFIG)
    mass = CONFIG.density * 0.2 * 0.3 * 0.5
    assert found.mass == pytest.approx(mass)
    np.testing.assert_allclose(found.center, (1.1, 2.15, 3.25))
    sizes = np.array([0.2, 0.3, 0.5]) ** 2
    np.testing.assert_allclose(found.tensor, np.diag(mass / 12 * (sizes.sum() - sizes)), atol=1e-12)


def test_flat_plate_is_an_exact_shell():
    a, b, c, d = np.array([(0, 0, 0), (0.4, 0, 0), (0.4, 0.2, 0), (0, 0.2, 0)], float)
    found = raw_inertia(np.array([[a, b, c], [a, c, d]]), CONFIG)
    mass = CONFIG.shell_density * CONFIG.shell_thickness * 0.08
    assert found.mass == pytest.approx(mass)
    np.testing.assert_allclose(found.tensor, np.diag([0.04, 0.16, 0.2]) * mass / 12, atol=1e-12)


def test_far_away_costs_no_digits():
    near, far = raw_inertia(blob(), CONFIG), raw_inertia(blob() + 1000, CONFIG)
    np.testing.assert_allclose(far.tensor, near.tensor, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize("open_side", [False, True])
def test_turning_and_shifting_moves_the_tensor(open_side):
    triangles, R, shift = blob()[: -5 if open_side else None], rotation(), np.array([0.3, -1, 2])
    found, moved = link_inertia(triangles, CONFIG), link_inertia(triangles @ R.T + shift, CONFIG)
    assert_equal(moved, Inertia(found.mass, R @ found.center + shift, R @ found.tensor @ R.T))


def test_mirror_and_inside_out_keep_the_mass():
    mirror = np.diag([-1.0, 1, 1])
    found = raw_inertia(blob(), CONFIG)
    assert_equal(raw_inertia(blob()[:, ::-1], CONFIG), found)
    mirrored = raw_inertia(blob() @ mirror, CONFIG)
    assert_equal(mirrored, Inertia(found.mass, mirror @ found.center, mirror @ found.tensor @ mirror))


def test_scale_of_a_solid():
    found, big = raw_inertia(blob(), CONFIG), raw_inertia(blob() * 3, CONFIG)
    assert_equal(big, Inertia(found.mass * 27, found.center * 3, found.tensor * 243))


def test_a_link_is_the_sum_of_its_components():
    pieces = [triangles_of(box((0, 0, 0), (0.3, 0.3, 0.3))), blob() + 2]
    a, b = (raw_inertia(p, CONFIG) for p in pieces)
    both = raw_inertia(np.concatenate(pieces), CONFIG)
    mass = a.mass + b.mass
    center = (a.mass * a.center + b.mass * b.center) / mass
    tensor = np.zeros((3, 3))
    for body in (a, b):
        d = body.center - center
        tensor += body.tensor + body.mass * (d @ d * np.eye(3) - np.outer(d, d))
    assert_equal(both, Inertia(mass, center, tensor))


def test_open_and_closed_components_are_told_apart():
    lid = triangles_of(box((0, 0, 1), (0.4, 0.4, 1.4)))[:10]  # a side is missing
    solid = triangles_of(box((0, 0, 0), (0.4, 0.4, 0.4)))
    found = raw_inertia(np.concatenate([lid, solid]), CONFIG)
    expected = CONFIG.density * 0.064 + CONFIG.shell_density * CONFIG.shell_thickness * 0.8
    assert found.mass == pytest.approx(expected, rel=1e-6)


HARD = {
    "point": np.zeros((2, 3, 3)),
    "line": np.array([[[0, 0, 0], [1, 0, 0], [2.0, 0, 0]]]),
    "triangle": np.array([[[0, 0, 0], [1, 0, 0], [0, 1.0, 0]]]),
    "needle": triangles_of(box((0, 0, 0), (1e-5, 1e-5, 1))),
    "grain": triangles_of(box((0, 0, 0), (1e-4, 1e-4, 1e-4))),
    "inside out": box((0, 0, 0), (1, 1, 1))[0][CUBE_FACES[:, ::-1]],
}


@pytest.mark.parametrize("shape", HARD)
def test_what_is_written_is_always_physical(shape):
    found = link_inertia(HARD[shape], CONFIG)
    low, middle, high = np.linalg.eigvalsh(found.tensor)
    assert found.mass >= CONFIG.smallest_mass
    assert low > 0
    assert low + middle >= high
    assert np.isfinite(found.center).all()


def test_a_physical_body_is_left_alone():
    found = raw_inertia(blob(), CONFIG)
    assert_equal(physical(found, CONFIG), found)


def made(name: str, count: int):
    return [substance_of(name)] * count


def test_a_material_by_its_name():
    steel, wood = SUBSTANCES["steel"], SUBSTANCES["wood"]
    for name in ("steel", "Black_Steel.001", "brushedSteel", "wood_STEEL"):
        assert substance_of(name) == steel, name
    assert substance_of("dark wood (matte)") == wood
    assert substance_of("Material.001") is None
    assert substance_of("steeled") is None  # only whole words count


def test_substances_have_physical_numbers():
    for word, s in SUBSTANCES.items():
        assert word == word.lower()
        assert 20 <= s.density <= 20_000
        assert 0 < s.sheet <= 0.02
        assert s.solid_to > s.sheet


def test_a_thin_bar_of_steel_is_solid_and_a_thick_block_is_a_box_of_sheet():
    bar, block = triangles_of(box((0, 0, 0), (0.3, 0.01, 0.01))), triangles_of(box((0, 0, 0), (0.6, 0.6, 0.8)))
    steel = SUBSTANCES["steel"]
    assert link_inertia(bar, CONFIG, made("steel", 12)).mass == pytest.approx(7850 * 0.3 * 0.01 * 0.01)
    area = 2 * (0.36 + 0.48 + 0.48)
    hollow = link_inertia(block, CONFIG, made("steel", 12))
    assert hollow.mass == pytest.approx(7850 * steel.sheet * area)
    np.testing.assert_allclose(hollow.center, (0.3, 0.3, 0.4))
    assert link_inertia(block, CONFIG, made("marble", 12)).mass == pytest.approx(2700 * 0.36 * 0.8)


def test_each_component_has_its_own_substance():
    bar, plate = box((0, 0, 0), (0.3, 0.01, 0.01)), box((1, 0, 0), (1.4, 0.02, 0.3))
    found = link_inertia(triangles_of(bar, plate), CONFIG, made("brass", 12) + made("oak", 12))
    masses = np.array([8500 * 0.3 * 1e-4, 720 * 0.4 * 0.02 * 0.3])
    assert found.mass == pytest.approx(masses.sum())
    assert found.center[0] == pytest.approx((masses * [0.15, 1.2]).sum() / masses.sum())
