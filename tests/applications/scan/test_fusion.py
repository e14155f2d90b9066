"""Fusion, cleaning and smoothing, each by what must hold for shapes that are known."""

import numpy as np
import pytest
import trimesh

from anymesh.applications.scan.cleaning_ import (
    Surface,
    border_vertices,
    close_small,
    cut_floor,
    decimate,
    drop_bits,
    loops,
    neighbours,
    smooth,
)
from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame
from anymesh.applications.scan.fusion_ import extract, fuse, place_blocks
from anymesh.errors import InputError, OptionError
from anymesh.geometry.topology import components
from anymesh.runtime import silent

CAMERA = Pinhole(100.0, 100.0, 40.0, 30.0, 80, 60)
BOUNDS = np.array([[-0.2, -0.2, 0.8], [0.2, 0.2, 1.2]])


def wall(depth: float, count: int = 3, noise: float = 0.0) -> Frames:
    """Frames that look at a plane across their axis."""
    rng = np.random.default_rng(0)

    def frame(k: int) -> RgbdFrame:
        seen = (depth + noise * rng.normal(size=(60, 80))).astype(np.float32)
        return RgbdFrame(str(k), CAMERA, np.eye(4), lambda: Observation(np.zeros((60, 80, 3), np.uint8), seen))

    return Frames(tuple(frame(k) for k in range(count)), "test")


def surface(frames: Frames, voxel: float = 0.01) -> tuple[np.ndarray, np.ndarray]:
    grid = place_blocks(frames, np.eye(4), BOUNDS, voxel, 4 * voxel, 5.0, silent)
    return extract(fuse(frames, np.eye(4), grid, 4 * voxel, 1.0, 5.0, silent), 0.5)


def test_a_plane_is_where_its_depth_says_and_faces_the_camera() -> None:
    vertices, faces = surface(wall(1.003))
    np.testing.assert_allclose(vertices[:, 2], 1.003, atol=1e-4)
    cross = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    assert (cross[:, 2] < 0).all()


def test_the_mean_of_noisy_frames_is_nearer_than_one_of_them() -> None:
    one, many = (np.abs(surface(wall(1.0, n, 0.004))[0][:, 2] - 1).mean() for n in (1, 16))
    assert many < 0.5 * one


def test_depth_beyond_the_limit_says_nothing() -> None:
    with pytest.raises(InputError, match="no frame shows a surface"):
        place_blocks(wall(1.0), np.eye(4), BOUNDS, 0.01, 0.04, 0.9, silent)


def test_too_fine_a_voxel_is_refused_with_one_that_would_do() -> None:
    with pytest.raises(OptionError, match="too fine"):
        place_blocks(wall(1.0), np.eye(4), BOUNDS, 0.0001, 0.0004, 5.0, silent)


def sheet(count: int = 20) -> Surface:
    """A flat square of 1 m, facing up, with count squares a side."""
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).reshape(-1)
    n = count + 1
    faces = np.concatenate([np.stack([a, a + n, a + n + 1], 1), np.stack([a, a + n + 1, a + 1], 1)])
    return Surface(np.stack([x, y, np.zeros_like(x)], 2).reshape(-1, 3), faces)


def ball() -> Surface:
    """A closed sphere of 1280 faces."""
    made = trimesh.creation.icosphere(3)
    return Surface(np.array(made.vertices), np.array(made.faces).astype(np.int64))


def test_a_hole_is_found_the_right_way_round_and_closed() -> None:
    whole = ball()
    cut = whole.keeping(np.arange(len(whole.faces)) > 3)
    assert len(loops(whole.faces)) == 0
    assert len(loops(cut.faces)) >= 1
    closed, large, count = close_small(cut, 0.1)
    assert count >= 1
    assert large == ()
    found = components(closed.vertices, closed.faces)
    assert found.solid.all()
    assert not found.flip.any()


def test_a_large_flat_hole_is_closed_and_told() -> None:
    whole = ball()
    upper = whole.keeping(whole.vertices[whole.faces][:, :, 2].min(1) > -1e-9)
    closed, large, _ = close_small(upper, 0.001)
    assert len(large) == 1
    assert large[0].closed
    assert large[0].area == pytest.approx(np.pi, rel=0.05)
    assert components(closed.vertices, closed.faces).solid.all()


def test_a_large_bent_hole_stays_open() -> None:
    whole = ball()
    centers = whole.vertices[whole.faces].mean(1)
    part = whole.keeping(~((centers[:, 0] > 0) & (centers[:, 2] > 0)))
    _, large, _ = close_small(part, 0.001)
    assert [h.closed for h in large] == [False]


def test_what_stands_on_the_floor_reaches_down_to_it() -> None:
    whole = ball()
    lifted = Surface(whole.vertices * [1, 1, 1] + [0, 0, 0.95], whole.faces)
    cut = cut_floor(lifted, 0.05)
    border = border_vertices(cut.faces, len(cut.vertices))
    assert border.any()
    np.testing.assert_allclose(cut.vertices[border, 2], 0)


def test_floating_bits_go() -> None:
    whole, bit = ball(), ball()
    both = Surface(
        np.concatenate([whole.vertices, 0.02 * bit.vertices + 3]),
        np.concatenate([whole.faces, bit.faces + len(whole.vertices)]),
    )
    kept, count = drop_bits(both)
    assert count == 1
    assert len(kept.faces) == len(whole.faces)


def test_smoothing_takes_noise_off_and_leaves_a_crease() -> None:
    flat = sheet()
    bent = flat.vertices.copy()
    bent[:, 2] = np.maximum(0, 3 * (bent[:, 0] - 0.5))  # a crease of 72 degrees at x = .5
    noisy = bent + np.random.default_rng(0).normal(size=bent.shape) * [0, 0, 0.004]
    done = smooth(noisy, flat.faces, 0.05)
    true = normals(bent, flat.faces)
    before, after = (np.degrees(np.arccos(np.clip((normals(v, flat.faces) * true).sum(1), -1, 1))) for v in (noisy, done))
    assert np.median(after) < 0.3 * np.median(before)
    crease = ~border_vertices(flat.faces, len(bent)) & (np.abs(bent[:, 0] - 0.5) < 0.01)
    assert np.abs(done - bent)[crease, 2].mean() < 0.005


def normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    cross = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    return cross / np.linalg.norm(cross, axis=1, keepdims=True)


def test_no_vertex_moves_further_than_told() -> None:
    flat = sheet()
    noisy = flat.vertices + np.random.default_rng(0).normal(size=flat.vertices.shape) * 0.02
    assert np.linalg.norm(smooth(noisy, flat.faces, 0.003) - noisy, axis=1).max() <= 0.003 + 1e-12


def test_faces_that_share_an_edge_are_neighbours() -> None:
    assert len(neighbours(ball().faces)) == 1280 * 3 // 2


def test_decimation_keeps_a_closed_surface_closed() -> None:
    few = decimate(ball(), 300)
    assert len(few.faces) <= 320
    assert components(few.vertices, few.faces).solid.all()


def test_folded_faces_are_taken_out() -> None:
    whole = ball()
    a, b, c = whole.faces[0]
    folded = Surface(
        np.concatenate([whole.vertices, [[0, 0, 3.0]]]),
        np.concatenate([whole.faces, [[a, b, 642], [b, a, 642]], [[c, b, 642], [b, c, 642]]]),
    )
    found = decimate(folded, 10_000)
    assert components(found.vertices, found.faces).solid.all()
    assert components(found.vertices, found.faces).count == 1
