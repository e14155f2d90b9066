"""Test the exact decomposition of closed solids: pieces cover the solid, stay close to it, and are as few as possible."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from test_decomposer import bracket

from anymesh.geometry.distance_ import distance_to_mesh, winding_number
from anymesh.geometry.triangle_set import sample_surface
from anymesh.physics.convex import planes, volume
from anymesh.physics.solids_ import decompose_solid
from anymesh.physics.split import solid_mesh

TURNS = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def ring(inner: float, outer: float, height: float) -> tuple[np.ndarray, np.ndarray]:
    """Return a closed ring around the z axis."""
    section = [(inner, 0.0), (outer, 0.0), (outer, height), (inner, height)]
    vertices = np.concatenate([np.c_[r * np.cos(TURNS), r * np.sin(TURNS), np.full(24, z)] for r, z in section])
    i = np.arange(24)
    j = (i + 1) % 24
    quads = [(24 * a, 24 * b) for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
    faces = [f for a, b in quads for f in (np.c_[a + i, b + j, b + i], np.c_[a + i, a + j, b + j])]
    return vertices, np.concatenate(faces)


def box_with_slots() -> tuple[np.ndarray, np.ndarray]:
    """Return a block with two deep slots in its top, as of a toaster."""
    from manifold3d import Manifold

    block = Manifold.cube((3.0, 2.0, 2.0))
    for y in (0.4, 1.2):
        block -= Manifold.cube((2.0, 0.4, 1.5)).translate((0.5, y, 0.6))
    mesh = block.to_mesh()
    return np.asarray(mesh.vert_properties, float)[:, :3], np.asarray(mesh.tri_verts, np.int64)


def outside_all(points, hulls) -> np.ndarray:
    """Return by how much each point lies outside the nearest hull."""
    return np.min([(points @ p[:, :3].T + p[:, 3]).max(1) for p in map(planes, hulls)], axis=0)


SOLIDS = {"bracket": lambda: solid_mesh(bracket().triangles), "ring": lambda: ring(0.7, 1.0, 0.5), "slots": box_with_slots}


@pytest.fixture(params=SOLIDS, scope="module")
def solid(request):
    vertices, faces = SOLIDS[request.param]()
    assert np.einsum("ij,ij->", vertices[faces][:, 0], np.cross(vertices[faces][:, 1], vertices[faces][:, 2])) > 0
    return vertices, faces


@pytest.fixture(scope="module")
def coarse(solid):
    """The convex pieces of a solid, few and loose."""
    return decompose_solid(*solid, gap=0.05, wall=0.005, max_pieces=24)


def test_pieces_cover_the_solid_within_the_gap(solid):
    vertices, faces = solid
    gap = 0.02 * float(np.linalg.norm(np.ptp(vertices, axis=0)))
    hulls = decompose_solid(vertices, faces, gap=gap, wall=0.002, max_pieces=24)
    assert 1 < len(hulls) <= 24
    kerf = 1e-4 * float(np.linalg.norm(np.ptp(vertices, axis=0)))
    assert outside_all(sample_surface(vertices[faces], 2000, 0).points, hulls).max() < kerf
    for hull in hulls:
        points = sample_surface(hull.vertices[hull.faces], 500, 1).points
        outside = points[winding_number(points, vertices, faces) < 0.5]  # cut faces lie inside the solid
        assert distance_to_mesh(outside, vertices, faces)[0].max(initial=0.0) < 1.3 * gap


def test_a_bracket_becomes_its_two_blocks():
    hulls = decompose_solid(*solid_mesh(bracket().triangles), gap=0.01, wall=0.002, max_pieces=16)
    assert len(hulls) == 2
    assert sum(volume(h) for h in hulls) == pytest.approx(0.36, rel=1e-3)


def test_slots_stay_open_with_few_pieces():
    vertices, faces = box_with_slots()
    hulls = decompose_solid(vertices, faces, gap=0.05, wall=0.005, max_pieces=24)
    assert len(hulls) <= 8
    assert outside_all(np.array([[1.5, 0.6, 1.5], [1.5, 1.4, 1.0]]), hulls).min() > 0.1  # the middles of both slots


def test_the_maximum_number_of_pieces_holds():
    hulls = decompose_solid(*ring(0.7, 1.0, 0.5), gap=1e-4, wall=0.002, max_pieces=5)
    assert len(hulls) == 5


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_scale_and_place_hardly_change_the_pieces(solid, coarse, scale):
    vertices, faces = solid
    other = decompose_solid(vertices * scale + scale, faces, gap=0.05 * scale, wall=0.005 * scale, max_pieces=24)
    total = [sum(volume(h) for h in hulls) for hulls in (coarse, other)]
    assert total[1] / scale**3 == pytest.approx(total[0], rel=0.02)
    assert abs(len(coarse) - len(other)) <= 1


def test_the_same_solid_gives_the_same_hulls(solid, coarse):
    other = decompose_solid(*solid, gap=0.05, wall=0.005, max_pieces=24)
    assert [h.vertices.tobytes() for h in coarse] == [h.vertices.tobytes() for h in other]


def test_an_open_surface_gives_no_pieces():
    vertices, faces = box_with_slots()
    assert decompose_solid(vertices, faces[1:], gap=0.05, wall=0.005, max_pieces=24) == []


def test_without_manifold3d_the_module_loads_and_the_division_says_what_is_missing() -> None:
    program = (
        "import sys; sys.modules['manifold3d'] = None; import numpy as np;"
        "from anymesh.physics.solids_ import decompose_solid;"
        "decompose_solid(np.eye(3), np.array([[0, 1, 2]]), gap=1.0, wall=1.0, max_pieces=1)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stderr.splitlines()[-1].startswith("anymesh.errors.MissingExtraError: manifold3d is missing")


def random_solid(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest component of a few blocks, cones and balls, united or subtracted."""
    from manifold3d import Manifold

    rng = np.random.default_rng(seed)

    def primitive() -> Manifold:
        x, y, z = rng.uniform(0.1, 1, 3)
        kind = rng.integers(3)
        if kind == 0:
            made = Manifold.cube((x, y, z), True)
        elif kind == 1:
            made = Manifold.cylinder(x, y / 2, z / 2, int(rng.integers(3, 24)), True)
        else:
            made = Manifold.sphere(x / 2, 12)
        return made.rotate(tuple(rng.uniform(0, 360, 3))).translate(tuple(rng.uniform(-0.4, 0.4, 3)))

    solid = primitive()
    for _ in range(4):
        solid = solid + primitive() if rng.random() < 0.6 else solid - primitive()
    mesh = max(solid.decompose(), key=lambda part: part.volume()).to_mesh()
    return np.asarray(mesh.vert_properties, float)[:, :3], np.asarray(mesh.tri_verts, np.int64)


@pytest.mark.parametrize("seed", range(8))
def test_random_solids_are_covered(seed):
    vertices, faces = random_solid(seed)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    hulls = decompose_solid(vertices, faces, gap=0.02 * size, wall=0.002 * size, max_pieces=24)
    assert 0 < len(hulls) <= 24
    assert outside_all(sample_surface(vertices[faces], 500, 0).points, hulls).max() < 1e-4 * size
