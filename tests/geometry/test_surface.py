"""Test that neither the winding of faces, nor copies of them, nor cracks change what a surface is."""

import numpy as np
import pytest
from assets import box, mesh_of
from rigid import apply, move
from test_triangle_set import outwardness

from anymesh.geometry.surface import ground_faces, mesh_surface, plain_triangles, without_copies
from anymesh.geometry.topology import MAX_AROUND, components, edge_pairs
from anymesh.physics.inertia import InertiaConfig, raw_inertia
from anymesh.types import Mesh

CUBE, FACES = box((0, 0, 0), (1, 1, 1))
OPEN = FACES[2:]  # without the first side


def some_reversed(faces: np.ndarray, seed: int) -> np.ndarray:
    return np.where(np.random.default_rng(seed).random(len(faces))[:, None] < 0.5, faces[:, ::-1], faces)


def apart(vertices: np.ndarray, faces: np.ndarray, crack: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return faces with corners of their own, each moved by up to a crack."""
    corners = vertices[faces].reshape(-1, 3)
    moved = corners + np.random.default_rng(seed).uniform(-0.5, 0.5, corners.shape) * crack / np.sqrt(3)
    return moved, np.arange(len(corners)).reshape(-1, 3)


@pytest.mark.parametrize("seed", range(6))
def test_a_solid_is_solid_and_faces_outwards_however_each_face_is_wound(seed: int) -> None:
    found = components(apply(move(seed), CUBE), some_reversed(FACES, seed))
    assert found.solid.tolist() == [True]
    assert found.flip.tolist() == (some_reversed(FACES, seed) != FACES).any(1).tolist()


@pytest.mark.parametrize(
    ("low", "inverted"),
    [((1, 1, 0), (0,)), ((1, 1, 0), (1,)), ((1, 1, 0), (0, 1)), ((1, 0, 0), (0, 1))],
    ids=["edge", "edge, the second", "edge, both", "side, both"],
)
def test_solids_that_touch_stay_apart_inside_out(low: tuple[int, int, int], inverted: tuple[int, ...]) -> None:
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box(low, np.add(low, 1))])
    reversed_faces = np.isin(piece, inverted)
    found = components(mesh.vertices, np.where(reversed_faces[:, None], mesh.faces[:, ::-1], mesh.faces))
    assert found.label.tolist() == piece.tolist()
    assert found.solid.all()
    assert found.flip.tolist() == reversed_faces.tolist()


FRAME = [box((0, 0, 0), (1, 5, 1)), box((1, 0, 0), (4, 1, 1)), box((4, 0, 0), (5, 5, 1)), box((1, 4, 0), (4, 5, 1))]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    "solids",
    [[box((0, 0, 0), (1, 1, 1)), box((1, 1, 0), (2, 2, 1))], [box((k, 0, 0), (k + 1, 1, 1)) for k in range(3)], FRAME],
    ids=["edge", "sides", "frame"],
)
def test_solids_that_touch_stay_apart_however_each_face_is_wound(solids: list, seed: int) -> None:
    mesh = mesh_of(solids)[0]
    faces = some_reversed(mesh.faces, seed)
    found = components(mesh.vertices, faces)
    assert (found.count, found.solid.all()) == (len(solids), True)
    wound = np.where(found.flip[:, None], faces[:, ::-1], faces)
    t = mesh.vertices[wound]
    volume = np.bincount(found.label, np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])) / 6)
    assert volume.tolist() == pytest.approx([float(np.prod(np.ptp(v, axis=0))) for v, _ in solids])


def test_a_moebius_strip_is_one_sided() -> None:
    turn = np.linspace(0, np.pi, 12, endpoint=False)
    rim = [np.stack([(2 + s * np.cos(turn)) * np.cos(2 * turn), (2 + s * np.cos(turn)) * np.sin(2 * turn), s * np.sin(turn)], 1)
           for s in (-0.5, 0.5)]  # fmt: skip
    a = np.arange(12)
    b, c, d = a + 1, a + 12, a + 13
    b[-1], d[-1] = 12, 0  # the rims meet after one turn
    found = components(np.concatenate(rim), np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)]))
    assert found.count == 1
    assert not found.solid.any()
    assert not found.flip.any()


@pytest.mark.parametrize("seed", range(4))
def test_cracks_between_faces_are_closed_and_gaps_between_solids_are_not(seed: int) -> None:
    diagonal = np.sqrt(3)
    found = components(*apart(CUBE, FACES, 4e-5 * diagonal, seed))
    assert (found.count, found.solid.tolist()) == (1, [True])
    assert components(*apart(CUBE, FACES, 4e-3 * diagonal, seed)).count > 1
    gap = 1e-5
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box((1 + gap, 0, 0), (2, 1, 1))])
    found = components(mesh.vertices, mesh.faces)
    assert found.label.tolist() == piece.tolist()
    assert found.solid.all()


def test_an_edge_of_very_many_faces_takes_little_memory() -> None:
    """Comparing all of 30,000 faces around an edge with each other took 20 GB."""
    count = 30 * MAX_AROUND
    turn = np.linspace(0, 6, count)
    corners = np.concatenate([[[0, 0, 0], [0, 0, 1]], np.stack([np.cos(turn), np.sin(turn), np.full(count, 0.5)], 1)])
    faces = np.stack([np.zeros(count, int), np.ones(count, int), np.arange(count) + 2], 1)
    assert len(edge_pairs(corners, faces).faces) == 0


def copied(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return for each face the one that it copies, and check that the components are of the others."""
    first, parts = without_copies(vertices, faces)
    assert (first[first] == first).all()
    assert len(parts.label) == len(np.unique(first))
    return first


def test_a_face_with_the_same_corners_and_winding_is_a_copy() -> None:
    faces = np.concatenate([FACES, np.roll(FACES, 1, axis=1), FACES[:3]])
    expected = [*range(12), *range(12), 0, 1, 2]
    assert copied(CUBE, faces).tolist() == expected
    assert copied(CUBE[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)).tolist() == expected


@pytest.mark.parametrize("order", [slice(None), slice(None, None, -1)], ids=["in order", "reversed"])
def test_the_back_of_a_sheet_and_of_a_solid_is_a_copy(order: slice) -> None:
    for front in (FACES, OPEN, FACES[:1]):
        faces = np.concatenate([front, front[:, ::-1]])[order]
        first = copied(CUBE, faces)
        assert len(np.unique(first)) == len(front)
        assert np.sort(faces[first], 1).tolist() == np.sort(faces, 1).tolist()


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("times", [2, 3])
def test_what_is_there_several_times_is_there_once_however_it_is_wound(times: int, seed: int) -> None:
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 1)), box((1, 1, 0), (2, 2, 1))])
    order = np.random.default_rng(seed).permutation(times * len(piece))
    faces = some_reversed(np.tile(mesh.faces, (times, 1)), seed)[order]
    first, parts = without_copies(mesh.vertices, faces)
    assert np.sort(faces[first], 1).tolist() == np.sort(faces, 1).tolist()
    assert (parts.count, parts.solid.tolist(), len(parts.label)) == (2, [True, True], len(piece))


def quads(turn: int) -> np.ndarray:
    """Return the triangles of the sides of a cube; turn: which diagonal divides them."""
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    turned = [side[turn:] + side[:turn] for side in sides]
    return np.array([[side[0], side[k], side[k + 1]] for side in turned for k in (1, 2)])


CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])


@pytest.mark.parametrize("sides", [1, 5, 6])
def test_a_back_that_is_divided_along_other_diagonals_is_a_copy(sides: int) -> None:
    front, back = quads(0)[: 2 * sides], quads(1)[: 2 * sides, ::-1]
    first, parts = without_copies(CORNERS, np.concatenate([front, back]))
    assert first[: 2 * sides].tolist() == list(range(2 * sides))
    assert (first[2 * sides :] // 2).tolist() == (np.arange(2 * sides) // 2).tolist()  # of the same side
    assert (parts.count, parts.solid.tolist()) == (1, [sides == 6])


def around_one() -> list[tuple[np.ndarray, np.ndarray]]:
    """Return a cube with six others around it."""
    cubes = [box((0, 0, 0), (1, 1, 1))]
    for axis in range(3):
        for side in (-1, 1):
            low = np.zeros(3)
            low[axis] = side
            cubes.append(box(low, low + 1))
    return cubes


ROW = [box((k, 0, 0), (k + 1, 1, 1)) for k in range(4)]


@pytest.mark.parametrize("solids", [ROW, around_one()], ids=["a row", "one amid six"])
def test_sides_on_which_solids_lie_on_each_other_are_no_copies(solids: list) -> None:
    mesh, piece = mesh_of(solids)
    assert copied(mesh.vertices, mesh.faces).tolist() == list(range(len(mesh.faces)))
    for both in (np.concatenate([mesh.faces, mesh.faces[:, ::-1]]), np.tile(mesh.faces, (2, 1))):
        first, parts = without_copies(mesh.vertices, both)
        assert len(parts.label) == len(piece)
        assert (parts.count, parts.solid.all()) == (len(solids), True)
        np.testing.assert_allclose(mesh.vertices[both[first]].mean(1), mesh.vertices[both].mean(1))


@pytest.mark.parametrize("seed", range(3))
def test_small_parts_have_no_cracks_of_the_size_of_those_of_the_object(seed: int) -> None:
    """The link is a twentieth of its object, whose cracks are 1e-5 of it."""
    vertices, faces = box((0, 0, 0), (0.03, 0.03, 0.03))
    soup, _ = apart(vertices, faces, 1e-5, seed)
    found, kept = plain_triangles(soup.reshape(-1, 3, 3), 1.0)
    assert kept.tolist() == list(range(12))
    assert components(found.reshape(-1, 3), np.arange(36).reshape(-1, 3)).solid.tolist() == [True]
    assert raw_inertia(found, InertiaConfig()).mass == pytest.approx(0.03**3 * 500, rel=2e-3)


def test_a_corner_that_no_face_uses_does_not_count() -> None:
    far = np.concatenate([CUBE, [[3e4, 0, 0]]])
    assert components(far, OPEN).solid.tolist() == [False]


@pytest.mark.parametrize("turned", [False, True])
def test_cavities_are_found_in_an_object_that_is_inside_out(turned: bool) -> None:
    vertices, faces = box((0.2, 0.2, 0.2), (0.8, 0.8, 0.8))
    mesh, _ = mesh_of([box((0, 0, 0), (1, 1, 1)), (vertices, faces[:, ::-1])])
    faces = mesh.faces[:, ::-1] if turned else mesh.faces
    found = mesh_surface(Mesh(mesh.vertices, faces, mesh.face_node, mesh.nodes, mesh.face_material))
    assert found.void.tolist() == [False, True]


def cupboard() -> tuple[Mesh, np.ndarray]:
    """Return a case open in front, a door of one sheet before it, and a solid within."""
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    front = (vertices[faces][:, :, 1] == 0).all(1)
    door = vertices - [0, 0.01, 0], faces[front]
    return mesh_of([(vertices, faces[~front]), door, box((0.3, 0.3, 0.3), (0.7, 0.7, 0.7))])


@pytest.mark.parametrize("seed", range(4))
def test_a_surface_is_the_same_however_it_is_wound_and_doubled(seed: int) -> None:
    mesh, piece = cupboard()
    plain = mesh_surface(mesh)
    assert (outwardness(plain.shape.take(piece == 0)) > 0).all()
    assert (plain.shape.normals[piece == 1] @ [0, -1, 0] > 0.99).all()
    assert plain.shape.solid.tolist() == (piece == 2).tolist()
    both = np.concatenate([mesh.faces, mesh.faces[:, ::-1]])
    for faces in (mesh.faces[:, ::-1], some_reversed(mesh.faces, seed), both, np.concatenate([both, both[::-1]])):
        count = len(faces)
        other = mesh_surface(
            Mesh(mesh.vertices, faces, np.zeros(count, int), mesh.nodes, np.full(count, -1))
        )  # fmt: skip
        assert other.components.label.tolist() == piece.tolist()
        assert other.shape.solid.tolist() == plain.shape.solid.tolist()
        np.testing.assert_allclose(other.shape.normals, plain.shape.normals)
        assert other.components.edges.aligned.all()
        np.testing.assert_allclose(other.shape.triangles[other.row].mean(1), mesh.vertices[faces].mean(1))


CABINET = [box((-0.3, -0.2, 0), (0.3, 0.2, 0.8)), box((-0.3, -0.22, 0), (0, -0.2, 0.8))]


def ground(*shapes: tuple[np.ndarray, np.ndarray]) -> list[int]:
    """Return the shapes of which all faces are ground, and check that no other face is."""
    mesh = mesh_of(list(shapes))[0]
    faces = ground_faces(mesh).reshape(len(shapes), -1)
    assert (faces.all(1) == faces.any(1)).all()
    return np.flatnonzero(faces.all(1)).tolist()


@pytest.mark.parametrize(("low", "high"), [((-1, -1, -0.02), (1, 1, 0)), ((-0.37, -0.3, -0.02), (0.37, 0.3, 0.01))])
def test_a_slab_that_reaches_beyond_a_cabinet_is_its_ground(low: tuple, high: tuple) -> None:
    assert ground(*CABINET, box(low, high)) == [2]


@pytest.mark.parametrize(
    ("low", "high"),
    [
        ((-0.3, -0.22, -0.02), (0.3, 0.2, 0)),  # a plinth as wide as the cabinet
        ((-1, -0.22, -0.02), (1, 0.2, 0)),  # a shelf that is no deeper
        ((-0.1, -0.1, -0.02), (1.9, 1.9, 0)),  # beside it
        ((-1, -1, -0.2), (1, 1, 0)),  # a pedestal
        ((-1, -1, 0.8), (1, 1, 0.82)),  # a table top
    ],
)
def test_what_is_as_small_thick_or_high_is_no_ground(low: tuple, high: tuple) -> None:
    assert ground(*CABINET, box(low, high)) == []


def test_an_object_of_one_component_has_no_ground() -> None:
    assert ground(box((-1, -1, 0), (1, 1, 0.02))) == []
