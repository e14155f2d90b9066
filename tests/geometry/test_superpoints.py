"""Test superpoints, and regions bounded by soft creases."""

import numpy as np
import trimesh

from anymesh.config import PatchConfig
from anymesh.geometry.creases import convex_regions
from anymesh.geometry.superpoints import superpoints


def grid(size: int) -> np.ndarray:
    index = np.arange(size * size).reshape(size, size)
    return np.concatenate([np.c_[index[:, :-1].ravel(), index[:, 1:].ravel()], np.c_[index[:-1].ravel(), index[1:].ravel()]])


def energy(signal: np.ndarray, label: np.ndarray, edges: np.ndarray, strength: float) -> float:
    spread = sum(((signal[label == k] - signal[label == k].mean(0)) ** 2).sum() for k in np.unique(label))
    return float(spread + strength * (label[edges[:, 0]] != label[edges[:, 1]]).sum())


def test_noisy_patches_are_found_exactly() -> None:
    size = 40
    y, x = np.mgrid[:size, :size]
    truth = ((x > 15) + 2 * (y > 25)).ravel()
    clean = np.array([[0, 0, 1.0], [1, 0, 0], [0, 1, 0], [0, 0, -1]])[truth]
    signal = clean + np.random.default_rng(0).normal(scale=0.15, size=clean.shape)
    edges = grid(size)
    label = superpoints(signal, np.ones(len(signal)), edges, np.ones(len(edges)), 0.3)
    assert label.max() + 1 == 4
    assert all(len(np.unique(label[truth == k])) == 1 for k in range(4))
    for other in (np.zeros_like(label), np.arange(len(label)), (x > 15).ravel().astype(int)):
        assert energy(signal, label, edges, 0.3) < energy(signal, other, edges, 0.3)


def test_a_constant_signal_is_one_superpoint_and_islands_stay_apart() -> None:
    edges = grid(10)
    signal = np.ones((200, 2))
    label = superpoints(signal, np.ones(200), np.concatenate([edges, edges + 100]), np.ones(2 * len(edges)), 0.05)
    assert label.tolist() == [0] * 100 + [1] * 100


def test_superpoints_are_connected_and_the_same_every_time() -> None:
    rng = np.random.default_rng(3)
    signal, weight, edges = rng.normal(size=(400, 3)), rng.uniform(0.5, 2, 400), grid(20)
    label = superpoints(signal, weight, edges, np.ones(len(edges)), 0.5)
    assert (label == superpoints(signal, weight, edges, np.ones(len(edges)), 0.5)).all()
    assert 1 < label.max() + 1 < 400
    inner = edges[label[edges[:, 0]] == label[edges[:, 1]]]
    assert trimesh.graph.connected_component_labels(inner, node_count=400).max() == label.max()


def soft(mesh: trimesh.Trimesh) -> np.ndarray:
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(mesh.vertices, mesh.faces, 0.03))
    fine.merge_vertices()
    trimesh.smoothing.filter_taubin(fine, iterations=10)
    return fine.triangles


def test_a_soft_concave_crease_bounds_a_region_and_a_convex_one_does_not() -> None:
    low, high = trimesh.creation.box((1, 1, 0.3)), trimesh.creation.box((0.4, 0.4, 0.4))
    high.apply_translation((0, 0, 0.3))
    triangles = soft(trimesh.boolean.union([low, high]))
    region = convex_regions(triangles, 1.5, PatchConfig())
    top = triangles.mean(1)[:, 2] > 0.25
    block, plate = np.bincount(region[top]).argmax(), np.bincount(region[~top]).argmax()
    assert block != plate
    assert (region[top] == block).mean() > 0.95
    assert (region[~top] == plate).mean() > 0.95


def test_the_inside_of_a_bowl_stays_whole() -> None:
    ball, hole = trimesh.creation.icosphere(4, 0.5), trimesh.creation.icosphere(4, 0.45)
    lid = trimesh.creation.box((2, 2, 1))
    lid.apply_translation((0, 0, 0.5))
    bowl = trimesh.boolean.difference([ball, hole, lid])
    triangles = bowl.triangles
    region = convex_regions(triangles, float(np.linalg.norm(bowl.extents)), PatchConfig())
    radius = np.linalg.norm(triangles.mean(1), axis=1)
    inside = radius < 0.46
    area = bowl.area_faces
    main = np.bincount(region[inside], area[inside]).argmax()
    assert area[inside & (region == main)].sum() > 0.95 * area[inside].sum()
