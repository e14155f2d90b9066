"""Test the exact decomposition of closed solids: pieces cover the solid, stay close to it, and are as few as possible."""

from __future__ import annotations

import subprocess
import sys
from itertools import permutations

import numpy as np
import pytest
from manifold3d import Manifold
from test_decomposer import bracket

from anymesh.geometry.distance_ import distance_to_mesh, winding_number
from anymesh.geometry.triangle_set import sample_surface
from anymesh.physics import solids_
from anymesh.physics.convex import hull_of, planes, volume
from anymesh.physics.solids_ import (
    KERF,
    TOUCH,
    _Budget,
    _candidates,
    _cut,
    _gap,
    _manifold,
    _merge_pieces,
    _pieces,
    _SolidPiece,
    decompose_solid,
)
from anymesh.physics.split import _distinct, concave_planes, solid_mesh

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


@pytest.mark.parametrize("seed", range(4))
def test_random_solids_are_covered(seed):
    vertices, faces = random_solid(seed)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    hulls = decompose_solid(vertices, faces, gap=0.02 * size, wall=0.002 * size, max_pieces=24)
    assert 0 < len(hulls) <= 24
    assert outside_all(sample_surface(vertices[faces], 500, 0).points, hulls).max() < 1e-4 * size


X, Y, Z = np.eye(3)


def block(low, high) -> Manifold:
    return Manifold.cube(tuple(np.subtract(high, low).tolist())).translate(tuple(np.asarray(low, float).tolist()))


def piece(low, high) -> _SolidPiece:
    (found,) = _pieces(block(low, high))
    return found


def bracket_solid() -> Manifold:
    return block((0, 0, 0), (1, 0.2, 0.5)) + block((0, 0, 0), (0.2, 1, 0.5))


def test_a_convex_piece_has_no_gap_and_a_bracket_has_that_of_its_slope() -> None:
    assert piece((0, 0, 0), (1, 1, 1)).gap == 0
    (found,) = _pieces(bracket_solid())
    assert found.gap == pytest.approx(0.4, abs=0.03)
    assert volume(found.hull) == pytest.approx(0.5 * (1 - 0.32))
    assert found.solid is not None


def test_separate_parts_are_pieces_and_flat_ones_are_left_out() -> None:
    assert len(_pieces(block((0, 0, 0), (1, 1, 1)) + block((2, 0, 0), (3, 1, 1)))) == 2
    for thickness, count in ((1e-5, 0), (1e-3, 1)):
        shell = block((0, 0, 0), (1, 1, 1)) - block((thickness, thickness, thickness), (2, 2, 2))
        assert len(_pieces(shell)) == count


@pytest.mark.parametrize(
    ("limit", "least", "most"), [(np.inf, 0.36, 0.5), (0.34, 0.36, 0.5), (0.3, 1 / 3 - 1e-6, 1 / 3 + 1e-6)]
)
def test_the_gap_of_an_open_box_is_that_of_its_missing_side(limit: float, least: float, most: float) -> None:
    """The centers of the halves of that side are a third of a side from the others, and its middle is half a side."""
    whole = piece((0, 0, 0), (1, 1, 1))
    below = whole.triangles[whole.triangles[:, :, 2].min(1) < 1]
    assert least <= _gap(whole.hull, below, limit) <= most
    assert _gap(whole.hull, whole.triangles) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("most", [1, 2, 3, 5])
def test_a_solid_is_cut_into_the_most_pieces_allowed(most: int) -> None:
    vertices, faces = ring(0.7, 1.0, 0.5)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    solid = _manifold(vertices / size, faces)
    assert solid is not None
    found = _cut(solid, concave_planes((vertices / size)[faces], 32), 1e-4, 0.002, most, _Budget())
    assert len(found) == most
    assert sum(p.solid.volume() for p in found if p.solid) == pytest.approx(solid.volume(), rel=1e-3)


def test_a_solid_within_the_gap_is_not_cut() -> None:
    planes = concave_planes(_pieces(bracket_solid())[0].triangles, 32)
    assert len(_cut(bracket_solid(), planes, 0.6, 0.01, 20, _Budget())) == 1
    two = _cut(bracket_solid(), planes, 0.01, 0.01, 20, _Budget())
    assert sorted(round(volume(p.hull), 3) for p in two) == [0.08, 0.1]
    assert all(p.gap == 0 for p in two)


def test_cuts_and_merges_have_a_budget_of_work() -> None:
    """A cut of a piece takes 3,000 faces and two per face of the piece, a merge those of both pieces."""
    planes = concave_planes(_pieces(bracket_solid())[0].triangles, 32)
    faces = len(_pieces(bracket_solid())[0].triangles)
    cut = 3000 + 2 * faces
    two = _cut(bracket_solid(), planes, 0.01, 0.01, 20, _Budget(cut))
    assert len(two) == 2
    with pytest.raises(TimeoutError, match=f"more than {cut - 1:,} faces"):
        _cut(bracket_solid(), planes, 0.01, 0.01, 20, _Budget(cut - 1))
    both = sum(len(p.triangles) for p in two)
    assert len(_merge_pieces(two, 9.0, 1, _Budget(both))) == 1
    with pytest.raises(TimeoutError):
        _merge_pieces(two, 9.0, 1, _Budget(both - 1))


def test_a_solid_that_takes_too_much_work_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    vertices, faces = ring(0.7, 1.0, 0.5)
    limits = {"gap": 0.02, "wall": 0.002, "max_pieces": 24}
    assert len(decompose_solid(vertices, faces, **limits)) > 1
    monkeypatch.setattr(solids_, "FACES_PER_CUT", solids_.MAX_WORK)
    with pytest.raises(TimeoutError):
        decompose_solid(vertices, faces, **limits)


@pytest.mark.parametrize(("smooth", "few"), [(False, 16), (True, 8)])
def test_planes_through_a_piece_are_tried_and_others_if_there_are_none(smooth: bool, few: int) -> None:
    one = piece((0, 0, 0), (1, 1, 1))
    outside = [(X, 2.0), (X, -1.0), (X, 1.0), (X, KERF / 2), (X, 1 - KERF / 2)]
    through = [(X, k / 100) for k in range(5, 45)]
    planes = (outside + through) if smooth else (outside + through[:20])
    found = list(_candidates(one, planes, 0.1))
    assert [o for _, o in found[:few]] == [o for _, o in through[:few]]
    assert (len(found) > few) == smooth
    assert len(list(_candidates(one, outside, 0.1))) > 3
    assert len(list(_candidates(one, [*outside, (X, 0.5)], 0.1))) == 1


def merged(*corners, gap: float = 0.01, most: int = 1) -> list[float]:
    found = _merge_pieces([piece(*c) for c in corners], gap, most, _Budget())
    return sorted(round(volume(p.hull), 6) for p in found)


def test_blocks_whose_common_hull_is_close_are_merged() -> None:
    row = [((k, 0, 0), (k + 1, 1, 1)) for k in (0.0, 1, 2)]
    assert merged(*row, most=9) == [3]
    apart = [((0, 0, 0), (1, 1, 1)), ((1 + 0.9 * TOUCH, 0, 0), (2, 1, 1))]
    assert len(merged(*apart, most=9)) == 1
    apart[1] = ((1 + 1.1 * TOUCH, 0, 0), (2, 1, 1))
    assert len(merged(*apart)) == 2


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
def test_blocks_touch_on_any_side(axis: int, sign: int) -> None:
    for share, count in ((0.9, 1), (1.1, 2)):
        off = sign * (1 + share * TOUCH) * np.eye(3)[axis]
        assert len(merged(((0, 0, 0), (1, 1, 1)), (off, off + 1))) == count


def test_an_l_of_two_blocks_is_merged_only_if_there_are_too_many() -> None:
    blocks = [((0, 0, 0), (1, 0.2, 1)), ((0, 0.2, 0), (0.2, 1, 1))]
    assert merged(*blocks, most=2) == [0.16, 0.2]
    assert merged(*blocks, most=1) == [0.68]
    assert merged(*blocks, gap=0.6, most=2) == [0.68]


def test_pairs_that_add_the_least_volume_are_merged_first() -> None:
    """Of a T in a row, both halves of its bar are merged for nothing; then the leg stays."""
    blocks = [((0, 0, 0), (2, 1, 1)), ((2, 0, 0), (4, 1, 1)), ((1.5, 1, 0), (2.5, 3, 1))]
    assert merged(*blocks, most=2) == [2, 4]
    stairs = [((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (2, 1.5, 1)), ((2, 0, 0), (3, 4, 1))]
    assert merged(*stairs, most=2) == [pytest.approx(2.75), pytest.approx(4)]  # 0.25 rather than 1.25 are added
    assert merged(*stairs, most=3) == [1, 1.5, 4]


@pytest.mark.parametrize("order", permutations(range(3)))
def test_neither_the_size_nor_the_order_of_blocks_decides_which_are_merged(order: tuple[int, ...]) -> None:
    """The middle block and the large one at its right add 0.25, the middle block and the small one at its left 0.5."""
    left, middle, right = ((0, 0, 0), (1, 2, 1)), ((1, 0, 0), (2, 1, 1)), ((2, 0, 0), (6, 1.5, 1))
    blocks = (left, middle, right)
    assert merged(*(blocks[k] for k in order), most=2) == [2, pytest.approx(7.25)]


def test_a_surface_that_is_inside_out_or_open_is_no_solid() -> None:
    vertices, faces = ring(0.7, 1.0, 0.5)
    assert _manifold(vertices, faces) is not None
    assert _manifold(vertices, faces[:, ::-1]) is None
    assert _manifold(vertices, faces[1:]) is None


def test_the_size_of_the_whole_scales_gaps_and_pieces() -> None:
    mesh = bracket_solid().to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, np.int64)
    for scale in (0.01, 100.0):
        for gap, count in ((0.6, 1), (0.2, 2)):
            hulls = solids_.decompose_solid(scale * vertices + 7, faces, gap=gap * scale, wall=0.01 * scale, max_pieces=4)
            assert len(hulls) == count
        assert sum(volume(h) for h in hulls) == pytest.approx(0.18 * scale**3, rel=1e-3)
        assert np.concatenate([h.vertices for h in hulls]).min(0) == pytest.approx([7, 7, 7], abs=1e-3 * scale)


def groove(degrees: float) -> np.ndarray:
    """Return two strips that fold upwards by an angle along the y axis."""
    slope = np.tan(np.deg2rad(degrees))
    right = np.array([[(0, 0, 0), (1, 0, slope), (1, 1, slope)], [(0, 0, 0), (1, 1, slope), (0, 1, 0)]])
    left = np.array([[(0, 0, 0), (0, 1, 0), (-1, 0, 0)], [(0, 1, 0), (-1, 1, 0), (-1, 0, 0)]], float)
    return np.concatenate([right, left])


@pytest.mark.parametrize(("degrees", "count"), [(9.7, 0), (10.3, 2), (-30.0, 0), (60.0, 2)])
def test_a_fold_of_ten_degrees_inwards_is_concave(degrees: float, count: int) -> None:
    found = concave_planes(groove(degrees), 8)
    assert len(found) == count
    for normal, offset in found:
        assert offset == pytest.approx(0)
        assert abs(normal[1]) < 1e-9
    assert len(concave_planes(groove(degrees)[:, ::-1], 8)) == (2 if degrees == -30 else 0)


def test_planes_are_the_same_if_they_are_parallel_and_at_the_same_place() -> None:
    lean = np.array([1, 0.01, 0]) / np.linalg.norm([1, 0.01, 0])
    far = np.array([1, 0.02, 0]) / np.linalg.norm([1, 0.02, 0])
    normals = np.array([X, -X, lean, far, X, X, -X])
    offsets = np.array([3.0, -3, 3, 3, 3 + 0.9e-4, 3 + 1.1e-4, 3])
    weights = np.array([3.0, 1, 1, 2.6, 1, 2.5, 2.4])
    found = _distinct(normals, offsets, weights, 10.0, 9)
    assert [o for _, o in found] == [3, 3, 3 + 1.1e-4, 3]
    assert [n.tolist() for n, _ in found] == [X.tolist(), far.tolist(), X.tolist(), (-X).tolist()]
    assert len(_distinct(normals, offsets, weights, 10.0, 2)) == 3
    assert _distinct(normals[:0], offsets[:0], weights[:0], 10.0, 2) == []


def test_duplicates_add_their_weights() -> None:
    found = _distinct(np.array([Y, X, X]), np.array([0.0, 1, 1]), np.array([3.0, 2, 2]), 1.0, 9)
    assert [n.tolist() for n, _ in found] == [X.tolist(), Y.tolist()]
    whole = hull_of(np.concatenate([np.eye(3), -np.eye(3)]))
    assert whole is not None
    assert concave_planes(whole.vertices[whole.faces], 5) == []
