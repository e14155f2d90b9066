"""What artists' models have besides their links: small things on a surface, loose things that stand on one, and a floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.sampling import SurfacePoints, sample_surface
from anymesh.types import Mesh

# lengths relative to the object's diagonal
COUNTS = (5, 60)  # range of the number of small things, by its logarithm
DESIGNS = 4  # shapes of these on an object
SIDES, DEPTHS = (0.003, 0.03), (0.0005, 0.004)  # ranges of their sides
GAPS = (-0.0005, 0.003)  # range of their distances from the surface; below 0 they are sunk into it
FLOOR_SIDES, FLOOR_DEPTH = (1.0, 2.0), 0.01
LOOSE_COUNTS = (2, 16)
LOOSE_SIDES, LOOSE_HEIGHTS = (0.02, 0.12), (0.02, 0.2)
CORNERS = (4, 12)  # of the outlines of boxes and of round things
TRIES = 40  # points on the surface for each thing, of which those with room for it are used
SUNK = 0.002  # what things stand on may be this uneven
MIN_LEVEL_COSINE = 0.99  # minimum cosine between the vertical and the normal of a surface that things stand on

Shape = tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]


def detailed(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Add labels, screws and the like on what is seen or a little in front of it, each a part of the link behind it."""
    mesh = sample.mesh
    s = sample_surface(mesh.triangles, TRIES * COUNTS[1], int(rng.integers(2**31)))
    ahead, behind = (_free(mesh, s.points, way * s.normals, 2.0) for way in (1, -1))
    outward = np.where(ahead, 1, -1)[:, None] * s.normals
    chosen = rng.permutation(np.flatnonzero(ahead | behind))[: _count(COUNTS, rng)]
    designs = [_thing(rng, SIDES, DEPTHS, rng.uniform(*GAPS)) for _ in range(DESIGNS)]
    return _with(sample, s, chosen, outward, [designs[k] for k in rng.integers(DESIGNS, size=len(chosen))])


def furnished(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Stand loose things on level surfaces where there is room, inside too, each a part of the link below it."""
    mesh, count = sample.mesh, _count(LOOSE_COUNTS, rng)
    s = sample_surface(mesh.triangles, TRIES * LOOSE_COUNTS[1], int(rng.integers(2**31)))
    upward = np.sign(s.normals @ sample.up)[:, None] * s.normals
    chosen: list[int] = []
    shapes: list[Shape] = []
    for k in rng.permutation(np.flatnonzero(upward @ sample.up > MIN_LEVEL_COSINE)):
        apart = all(np.linalg.norm(s.points[k] - s.points[j]) > LOOSE_SIDES[1] * mesh.diagonal for j in chosen)
        if apart and len(chosen) < count:
            shape = _thing(rng, LOOSE_SIDES, LOOSE_HEIGHTS, 0.0)
            if _stands(mesh, s.points[k], upward[k], shape[0]):
                chosen.append(int(k))
                shapes.append(shape)
    return _with(sample, s, np.array(chosen, int), upward, shapes)


def _stands(mesh: Mesh, at: Float[np.ndarray, " 3"], up: Float[np.ndarray, " 3"], corners: Float[np.ndarray, "V 3"]) -> bool:
    """Return whether a surface is below each lower corner of a thing, and nothing is within it."""
    ring = mesh.diagonal * corners[: len(corners) // 2] @ _frame(up)
    height = mesh.diagonal * float(corners[:, 2].max()) * up
    levels = [at + share * height for share in (0.02, 0.5, 0.98)]
    scene = RayScene(mesh.vertices, mesh.faces)

    def free(starts: np.ndarray, ways: np.ndarray) -> bool:
        return bool((scene.first_hit(starts, ways, 1.0).face < 0).all())

    around = all(
        free(np.tile(level, (len(ring), 1)), ring) and free(level + ring, np.roll(ring, -1, 0) - ring) for level in levels
    )
    upright = free(levels[0] + ring, np.tile(height, (len(ring), 1)))
    below = (
        scene.first_hit(levels[0] + ring, np.tile(-2 * SUNK * mesh.diagonal * up - 0.02 * height, (len(ring), 1)), 1.0).face
        >= 0
    )
    return around and upright and bool(below.all())


def floored(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Put a square slab under the object, as a part of its root."""
    mesh = sample.mesh
    frame = _frame(sample.up)
    local = mesh.vertices @ frame.T
    middle = np.append((local.min(0)[:2] + local.max(0)[:2]) / 2, local[:, 2].min())
    slab = _prism(min(CORNERS), np.full(2, np.sqrt(0.5) * rng.uniform(*FLOOR_SIDES)), -FLOOR_DEPTH, 0.0)
    under = SurfacePoints(middle[None] @ frame, sample.up[None], np.flatnonzero(sample.labels == 0)[:1])
    return _with(sample, under, np.zeros(1, int), sample.up[None], [slab])


def _count(span: tuple[int, int], rng: np.random.Generator) -> int:
    return round(float(np.exp(rng.uniform(*np.log(span)))))


def _free(mesh: Mesh, points: np.ndarray, ways: np.ndarray, reach: float) -> Bool[np.ndarray, " n"]:
    """Return for which points nothing lies ahead within a reach, relative to the diagonal."""
    start = points + 1e-5 * mesh.diagonal * ways
    return RayScene(mesh.vertices, mesh.faces).first_hit(start, reach * mesh.diagonal * ways, 1.0).face < 0


def _frame(z: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """Return three axes, as rows, of which z is the last."""
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(z, x), z])


def _with(
    sample: EvalSample, s: SurfacePoints, chosen: Int[np.ndarray, " n"], normals: np.ndarray, shapes: Sequence[Shape]
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
