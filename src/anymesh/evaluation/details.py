"""What artists' models have besides their links: small things on a surface, loose things that stand on one, and a floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface

# lengths relative to the object's diagonal
COUNTS = (5, 60)  # range of the number of small things, by its logarithm
DESIGNS = 4  # shapes of these on an object
SIDES, DEPTHS = (0.003, 0.03), (0.0005, 0.004)  # ranges of their sides and thicknesses
GAPS = (-0.0005, 0.003)  # range of their distances from the surface; below 0 they are sunk into it
FLOOR_SIDES, FLOOR_DEPTH = (1.0, 2.0), 0.01  # range of its sides, and its thickness
LOOSE_COUNTS = (2, 16)  # range of the number of loose things, by its logarithm
LOOSE_SIDES, LOOSE_HEIGHTS = (0.02, 0.12), (0.02, 0.2)  # ranges of their sides and heights
CORNERS = (4, 12)  # of the outlines of boxes and of round things
TRIES = 40  # points on the surface for each thing, of which those with room for it are used
SUNK = 0.002  # depth below a small thing within which the surface must lie
UNEVEN = 0.1  # of its height: depth below a loose thing within which the surface must lie
MIN_LEVEL_COSINE = 0.99  # minimum cosine between the vertical and the normal of a surface that things stand on

Shape = tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]


def detailed(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Add labels, screws and the like on what is seen or a little in front of it, each a part of the link behind it."""
    mesh = sample.mesh
    s = sample_surface(mesh.triangles, TRIES * COUNTS[1], int(rng.integers(2**31)))
    scene = RayScene(mesh.vertices, mesh.faces)
    starts = [(s.points + way * 1e-5 * mesh.diagonal, 2 * mesh.diagonal * way) for way in (s.normals, -s.normals)]
    ahead, behind = (scene.first_hit(*start, 1.0).face < 0 for start in starts)
    outward = np.where(ahead, 1, -1)[:, None] * s.normals
    designs, count = [_thing(rng, SIDES, DEPTHS, rng.uniform(*GAPS)) for _ in range(DESIGNS)], _count(COUNTS, rng)
    chosen: list[int] = []
    shapes: list[Shape] = []
    for k in rng.permutation(np.flatnonzero(ahead | behind)):
        if len(chosen) == count:
            break
        shape = designs[int(rng.integers(DESIGNS))]
        if _lies(sample, scene, (s.points[k], outward[k]), shape[0], int(s.faces[k])):
            chosen.append(int(k))
            shapes.append(shape)
    return _with(sample, s, chosen, outward, shapes)


def _lies(sample: EvalSample, scene: RayScene, at: tuple[np.ndarray, np.ndarray], corners: np.ndarray, face: int) -> bool:
    """Return whether the link of a face is right below all corners of a thing. at: its place and the outward normal there."""
    tops = at[0] + sample.mesh.diagonal * corners[len(corners) // 2 :] @ _frame(at[1])
    reach = (float(corners[:, 2].max()) + SUNK) * sample.mesh.diagonal
    below = scene.first_hit(tops, np.tile(-reach * at[1], (len(tops), 1)), 1.0).face
    return bool((below >= 0).all() and (sample.labels[below] == sample.labels[face]).all())


def furnished(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Stand loose things on level surfaces where there is room, inside too, each a part of the link below it."""
    mesh, count = sample.mesh, _count(LOOSE_COUNTS, rng)
    s = sample_surface(mesh.triangles, TRIES * LOOSE_COUNTS[1], int(rng.integers(2**31)))
    scene = RayScene(mesh.vertices, mesh.faces)
    upward = np.sign(s.normals @ sample.up)[:, None] * s.normals
    chosen: list[int] = []
    shapes: list[Shape] = []
    for k in rng.permutation(np.flatnonzero(upward @ sample.up > MIN_LEVEL_COSINE)):
        if len(chosen) == count:
            break
        if all(np.linalg.norm(s.points[k] - s.points[j]) > LOOSE_SIDES[1] * mesh.diagonal for j in chosen):
            shape = _thing(rng, LOOSE_SIDES, LOOSE_HEIGHTS, 0.0)
            if _stands(scene, s.points[k], upward[k], mesh.diagonal * shape[0]):
                chosen.append(int(k))
                shapes.append(shape)
    return _with(sample, s, chosen, upward, shapes)


def _stands(scene: RayScene, at: Float[np.ndarray, " 3"], up: Float[np.ndarray, " 3"], corners: np.ndarray) -> bool:
    """Return whether a surface is below each lower corner of a thing, and nothing in it. corners: relative to `at` [m]."""
    ring = corners[: len(corners) // 2] @ _frame(up)
    height = float(corners[:, 2].max()) * up
    levels = [at + share * height for share in (0.02, 0.5, 0.98)]

    def free(starts: np.ndarray, ways: np.ndarray) -> bool:
        return bool((scene.first_hit(starts, ways, 1.0).face < 0).all())

    around = all(free(np.tile(p, (len(ring), 1)), ring) and free(p + ring, np.roll(ring, -1, 0) - ring) for p in levels)
    upright = free(levels[0] + ring, np.tile(height, (len(ring), 1)))
    below = scene.first_hit(levels[0] + ring, np.tile(-UNEVEN * height, (len(ring), 1)), 1.0).face >= 0
    return around and upright and bool(below.all())


def floored(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Put a square slab under the object, as a part of its root."""
    mesh = sample.mesh
    frame = _frame(sample.up)
    local = mesh.vertices @ frame.T
    middle = np.append((local.min(0)[:2] + local.max(0)[:2]) / 2, local[:, 2].min())
    slab = _prism(min(CORNERS), np.full(2, np.sqrt(0.5) * rng.uniform(*FLOOR_SIDES)), -FLOOR_DEPTH, 0.0)
    under = SurfacePoints(middle[None] @ frame, sample.up[None], np.zeros(1, np.int64))
    made = _with(sample, under, [0], sample.up[None], [slab])
    return replace(made, labels=np.where(np.arange(len(made.labels)) < len(sample.labels), made.labels, 0))


def _count(span: tuple[int, int], rng: np.random.Generator) -> int:
    return round(float(np.exp(rng.uniform(*np.log(span)))))


def _frame(z: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """Return three axes, as rows, of which z is the last."""
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])


def _with(
    sample: EvalSample, s: SurfacePoints, chosen: Sequence[int], normals: np.ndarray, shapes: Sequence[Shape]
) -> EvalSample:
    """Add one shape at each chosen point, with the link, node and material of the face there."""
    mesh = sample.mesh
    corners, faces, like = [mesh.vertices], [mesh.faces], [np.arange(len(mesh.faces))]
    for k, (points, triangles) in zip(chosen, shapes, strict=True):
        faces.append(triangles + sum(map(len, corners)))
        corners.append(s.points[k] + mesh.diagonal * points @ _frame(normals[k]))
        like.append(np.full(len(triangles), s.faces[k]))
    old = np.concatenate(like)
    made = replace(mesh.subset(old), vertices=np.concatenate(corners), faces=np.concatenate(faces), corner_normal=None)
    return replace(sample, mesh=made, labels=sample.labels[old])


def _thing(rng: np.random.Generator, sides: tuple[float, float], heights: tuple[float, float], low: float) -> Shape:
    """Return a box or a disc that stands on the plane z = low, with sides and height in these ranges."""
    corners = int(rng.choice(CORNERS))
    boxy = corners == min(CORNERS)
    radii = np.sqrt(0.5) * rng.uniform(*sides, 2) if boxy else np.full(2, rng.uniform(*sides) / 2)
    return _prism(corners, radii, low, low + rng.uniform(*heights))


def _prism(corners: int, radii: Float[np.ndarray, " 2"], low: float, high: float) -> Shape:
    """Return an upright prism about the z axis; radii: of the ellipse along x and y on which the corners of its outline lie."""
    angle = (np.arange(corners) + 0.5) * 2 * np.pi / corners
    outline = np.stack([np.cos(angle), np.sin(angle)], 1) * radii
    k, after = np.arange(corners), (np.arange(corners) + 1) % corners
    fan = np.stack([np.zeros(corners - 2, int), k[1:-1], k[2:]], 1)
    around = [np.stack([k, after, corners + after], 1), np.stack([k, corners + after, corners + k], 1)]
    points = np.concatenate([np.insert(outline, 2, z, 1) for z in (low, high)])
    return points, np.concatenate([fan[:, ::-1], fan + corners, *around])
