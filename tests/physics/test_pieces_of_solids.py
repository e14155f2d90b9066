"""Test how pieces of solids are cut and merged, and concave planes, against values worked out by hand."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from manifold3d import Manifold
from test_solids import ring

from anymesh.physics import solids_
from anymesh.physics.convex import hull_of, volume
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
from anymesh.physics.split import _distinct, concave_planes

X, Y, Z = np.eye(3)


def block(low, high) -> Manifold:
    return Manifold.cube(tuple(np.subtract(high, low).tolist())).translate(tuple(np.asarray(low, float).tolist()))


def piece(low, high) -> _SolidPiece:
    (found,) = _pieces(block(low, high))
    return found


def bracket() -> Manifold:
    return block((0, 0, 0), (1, 0.2, 0.5)) + block((0, 0, 0), (0.2, 1, 0.5))


def test_a_convex_piece_has_no_gap_and_a_bracket_has_that_of_its_slope() -> None:
    assert piece((0, 0, 0), (1, 1, 1)).gap == 0
    (found,) = _pieces(bracket())
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
    planes = concave_planes(_pieces(bracket())[0].triangles, 32)
    assert len(_cut(bracket(), planes, 0.6, 0.01, 20, _Budget())) == 1
    two = _cut(bracket(), planes, 0.01, 0.01, 20, _Budget())
    assert sorted(round(volume(p.hull), 3) for p in two) == [0.08, 0.1]
    assert all(p.gap == 0 for p in two)


def test_cuts_and_merges_have_a_budget_of_work() -> None:
    """A cut of a piece takes 3,000 faces and two per face of the piece, a merge those of both pieces."""
    planes = concave_planes(_pieces(bracket())[0].triangles, 32)
    faces = len(_pieces(bracket())[0].triangles)
    cut = 3000 + 2 * faces
    two = _cut(bracket(), planes, 0.01, 0.01, 20, _Budget(cut))
    assert len(two) == 2
    with pytest.raises(TimeoutError, match=f"more than {cut - 1:,} faces"):
        _cut(bracket(), planes, 0.01, 0.01, 20, _Budget(cut - 1))
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
    mesh = bracket().to_mesh64()
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
