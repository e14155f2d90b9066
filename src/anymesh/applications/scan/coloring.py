"""Vertex colours of a surface from the pictures that see it best."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.applications.scan.frames import Frames
from anymesh.runtime import Progress
from anymesh.types.triangles import face_cross

SEEN = 0.012  # share of the depth; largest difference between a visible vertex and the depth map
SHARP = 4  # exponent of a view's weight; emphasizes frontal, near views
UNSEEN = 150  # grey value where no picture shows the surface


def vertex_colors(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], frames: Frames, T: Float[np.ndarray, "4 4"],
    progress: Progress,
) -> UInt8[np.ndarray, "V 3"]:  # fmt: skip
    """Return sRGB colours, averaged over the frames that see a vertex, weighted by viewing angle and distance.

    T: from the world to the vertices' frame.
    """
    cross = face_cross(vertices[faces])
    normal = np.stack([np.bincount(faces.reshape(-1), np.repeat(c, 3), len(vertices)) for c in cross.T], 1)
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    total, weight = np.zeros((len(vertices), 3)), np.zeros(len(vertices))
    for number, frame in enumerate(frames.frames):
        progress("color", frame.name, number, len(frames))
        observation = frame.observe()
        T_camera = np.linalg.inv(T @ frame.T_world_camera)
        p = vertices @ T_camera[:3, :3].T + T_camera[:3, 3]
        facing = -np.einsum("ij,ij->i", normal @ T_camera[:3, :3].T, p) / np.maximum(np.linalg.norm(p, axis=1), 1e-9)
        column, row = frame.depth_camera(observation.depth).pixels(p)
        depth = np.where(column >= 0, observation.depth[row, column], 0)
        rows = np.flatnonzero((depth > 0) & (np.abs(depth - p[:, 2]) < SEEN * p[:, 2]) & (facing > 0.1))
        if len(rows) == 0:
            continue
        height, width = observation.color.shape[:2]
        column, row = frame.camera.resized(width, height).pixels(p[rows])
        rows, column, row = rows[column >= 0], column[column >= 0], row[column >= 0]
        w = (facing[rows] / p[rows, 2]) ** SHARP
        total[rows] += w[:, None] * observation.color[row, column]
        weight[rows] += w
    known = weight > 0
    colors = np.full((len(vertices), 3), float(UNSEEN))
    colors[known] = total[known] / weight[known, None]
    return _spread(colors, known, faces)


def _spread(colors: np.ndarray, known: np.ndarray, faces: np.ndarray) -> UInt8[np.ndarray, "V 3"]:
    """Fill the colours of unseen vertices with the mean of their neighbours, starting from the seen ones."""
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ends = np.concatenate([ends, ends[:, ::-1]])
    for _ in range(30):
        use = known[ends[:, 0]] & ~known[ends[:, 1]]
        if not use.any():
            break
        source, target = ends[use].T
        count = np.bincount(target, minlength=len(colors))
        mean = np.stack([np.bincount(target, colors[source, k], len(colors)) for k in range(3)], 1)
        new = count > 0
        colors[new] = mean[new] / count[new, None]
        known = known | new
    return np.clip(np.rint(colors), 0, 255).astype(np.uint8)
