"""Test laws of mass, center and inertia."""

import numpy as np
import pytest
import trimesh
from assets import CUBE_FACES, box

from anymesh.export.model import ExportConfig
from anymesh.physics.inertia import SUBSTANCES, Inertia, link_inertia, physical, raw_inertia, substance_of

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
