"""Deliberate changes to a mesh, as made by scans, generators and careless exports, with ground truth carried over."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.errors import OptionError
from anymesh.evaluation.careless import cracked, doubled, inside_out, misplaced, mixed, tight, two_sided
from anymesh.evaluation.details import detailed, floored, furnished
from anymesh.evaluation.fused_ import joined, wrapped
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.posing import ajar
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface, spread_directions
from anymesh.prompted.grounding.cloud import point_colors
from anymesh.types import Mesh, Node
from anymesh.types.triangles import normals_and_areas

Change = Callable[[EvalSample, np.random.Generator], EvalSample]

TILT = 5.0  # [deg] tilt from level, as in a scan
SCALES = (0.01, 100.0)  # confusion of centimetres and metres, in both directions
ROUGHEST = 60  # minimum number of faces of a decimated component; a box has 12 and cannot be reduced
PROBES = 20_000  # points on the surface that determine which faces are visible, besides the centroid of every face
DIRECTIONS = 128  # directions from which each point is viewed
FINE, COARSE = 256, 128  # cells along the longest side of an object that is fused to one surface
FUSED_FACES = 50_000  # of that surface; generated meshes have about as many


def changed(name: str, sample: EvalSample, seed: int = 0) -> EvalSample:
    """Apply one of CHANGES to the sample; equal seeds and samples give equal results."""
    if name not in CHANGES:
        raise OptionError(f"change {name!r}; valid are {', '.join(CHANGES)}")
    return CHANGES[name](sample, np.random.default_rng([seed, *name.encode(), *sample.truth.name.encode()]))


def moved(sample: EvalSample, T: Float[np.ndarray, "4 4"]) -> EvalSample:
    """Move the sample by a rigid motion with a scale; its lengths remain relative to the size of its original box."""
    scale = float(np.cbrt(np.linalg.det(T[:3, :3])))
    mesh, up = sample.mesh.transformed(T), T[:3, :3] @ sample.up / scale
    return replace(sample, mesh=mesh, T=T @ sample.T, diagonal=2 * sample.unit * scale, up=up)


def rotation(axis: Float[np.ndarray, " 3"], angle: float) -> Float[np.ndarray, "4 4"]:
    """Return the rotation by `angle` [rad] about a unit axis through the origin (Rodrigues)."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    T = np.eye(4)
    T[:3, :3] += np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    return T


def _turned(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    return moved(sample, rotation(np.array([0, 0, 1.0]), rng.uniform(0, 2 * np.pi)))


def _tilted(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    way = rng.uniform(0, 2 * np.pi)
    return moved(sample, rotation(np.array([np.cos(way), np.sin(way), 0]), np.deg2rad(TILT)))


def _lying(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Lay the object on one of four sides, as if another axis had been taken for up."""
    return moved(sample, rotation(np.eye(3)[rng.integers(2)], rng.choice([-1, 1]) * np.pi / 2))


def _overturned(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    return moved(sample, rotation(np.eye(3)[rng.integers(2)], np.pi))


def _spun(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Rotate the sample uniformly over all rotations."""
    w, x, y, z = (q := rng.normal(size=4)) / np.linalg.norm(q)
    sine = max(float(np.linalg.norm([x, y, z])), 1e-300)
    return moved(sample, rotation(np.array([x, y, z]) / sine, 2 * np.arctan2(sine, w)))


def _scaled(sample: EvalSample, rng: np.random.Generator, *, factor: float) -> EvalSample:
    return moved(sample, np.diag([factor, factor, factor, 1.0]))


def _noisy(sample: EvalSample, rng: np.random.Generator, *, share: float) -> EvalSample:
    """Add Gaussian noise of `share` diagonals to every welded corner, so that no seam opens."""
    mesh = sample.mesh
    corner = weld(mesh.vertices)
    shift = rng.normal(size=(int(corner.max()) + 1, 3)) * share * mesh.diagonal
    return replace(sample, mesh=replace(mesh, vertices=mesh.vertices + shift[corner], corner_normal=None))


def _decimated(sample: EvalSample, rng: np.random.Generator, *, share: float) -> EvalSample:
    """Decimate every connected component to this share of its faces, by quadric error."""
    mesh = sample.mesh
    label = components(mesh.vertices, mesh.faces).label
    made = [
        simplify(mesh.triangles[mine], max(ROUGHEST, round(share * len(mine))))
        for mine in np.split(np.argsort(label, kind="stable"), np.cumsum(np.bincount(label))[:-1])
    ]
    corners = np.concatenate(made).reshape(-1, 3)
    return resurfaced(sample, corners, np.arange(len(corners)).reshape(-1, 3), nodes=True)


def _unseen_gone(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Remove the faces that are invisible from outside, for any winding; partly visible faces stay."""
    mesh = sample.mesh
    s = sample_surface(mesh.triangles, PROBES, int(rng.integers(2**31)), at_least=1)
    middles = SurfacePoints(mesh.triangles.mean(1), mesh.face_normals, np.arange(len(mesh.faces)))
    seen = np.zeros(len(mesh.faces), bool)
    for probe in (middles, s):
        seen[probe.faces[_seen(mesh, probe)]] = True
    return _only(sample, seen)


def _seen(mesh: Mesh, probe: SurfacePoints) -> Bool[np.ndarray, " n"]:
    """Return which points are visible from far away, in one of DIRECTIONS."""
    scene = RayScene(mesh.vertices, mesh.faces)
    seen = np.zeros(len(probe), bool)
    for way in spread_directions(DIRECTIONS):
        left = np.flatnonzero(~seen)
        side = np.where(probe.normals[left] @ way < 0, -1.0, 1.0)[:, None] * probe.normals[left]
        start = probe.points[left] + 1e-5 * mesh.diagonal * side
        blocked = scene.first_hit(start, np.repeat(way[None] * 2 * mesh.diagonal, len(left), 0), 1.0).face >= 0
        seen[left[~blocked]] = True
    return seen


def _fused(sample: EvalSample, rng: np.random.Generator, *, cells: int) -> EvalSample:
    """Replace the object by one closed surface around it, as from voxel fusion and generators.

    Gaps below two cells become grooves, and what lies behind them is removed. Colours are kept, names are not.
    """
    t = sample.mesh.triangles
    vertices, faces = wrapped(t, float(sample.mesh.extents.max()) / cells)
    few = simplify(vertices[faces], FUSED_FACES)
    return resurfaced(sample, few.reshape(-1, 3), np.arange(3 * len(few)).reshape(-1, 3))


def _joined(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Return the exact union of all closed components, as from a CAD export or a boolean; open ones stay unchanged."""
    mesh = sample.mesh
    mesh_components = components(mesh.vertices, mesh.faces)
    triangles = np.where(mesh_components.flip[:, None, None], mesh.triangles[:, ::-1], mesh.triangles)
    solids = [triangles[mesh_components.label == c] for c in np.flatnonzero(mesh_components.solid)]
    open_ones = triangles[~mesh_components.solid[mesh_components.label]]
    corners = np.concatenate([joined(solids), open_ones] if solids else [open_ones]).reshape(-1, 3)
    return resurfaced(sample, corners, np.arange(len(corners)).reshape(-1, 3))


def resurfaced(
    sample: EvalSample, vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], *, nodes: bool = False
) -> EvalSample:
    """Replace the surface of the sample.

    Each face takes the label, and each corner the colour, of the nearest point of the old surface. nodes: whether the faces
    keep their nodes; else they form one node.
    """
    mesh = sample.mesh
    _, first, inverse = np.unique(weld(vertices), return_index=True, return_inverse=True)
    vertices, faces = vertices[first], inverse.reshape(-1)[faces]
    faces = faces[normals_and_areas(vertices[faces])[1] > 0]
    nearest = distance_to_mesh(vertices[faces].mean(1), mesh.vertices, mesh.faces)[1]
    _, face, point = distance_to_mesh(vertices, mesh.vertices, mesh.faces)
    color = point_colors(mesh, SurfacePoints(point, mesh.face_normals[face], face))
    color = np.concatenate([color, np.full((len(color), 1), 255, np.uint8)], 1)
    made = Mesh(
        vertices=vertices,
        faces=faces,
        face_node=mesh.face_node[nearest] if nodes else np.zeros(len(faces), np.int64),
        nodes=mesh.nodes if nodes else (Node("object"),),
        face_material=np.full(len(faces), -1),
        corner_color=color[faces],
    )
    return _only(replace(sample, mesh=made, labels=sample.labels[nearest]), np.ones(len(faces), bool))


def _only(sample: EvalSample, kept: Bool[np.ndarray, " F"]) -> EvalSample:
    """Return the sample with only these faces.

    Parts without faces are removed from the ground truth; their child parts get the nearest remaining ancestor as parent.
    """
    truth, labels = sample.truth, sample.labels[kept]
    there = np.bincount(labels, minlength=len(truth.parts)) > 0
    there[0] = True
    number = np.cumsum(there) - 1
    parts = tuple(p for p, here in zip(truth.parts, there, strict=True) if here)
    names = {p.name for p in parts}
    parent = {j.child: j.parent for j in truth.joints}

    def carrier(name: str) -> str:
        while name not in names and name in parent:
            name = parent[name]
        return name

    joints = tuple(replace(j, parent=carrier(j.parent)) for j in truth.joints if j.child in names)
    return replace(
        sample, truth=replace(truth, parts=parts, joints=joints), mesh=sample.mesh.subset(kept), labels=number[labels]
    )


CHANGES: Mapping[str, Change] = MappingProxyType(
    {
        "none": lambda sample, rng: sample,
        "turned": _turned,  # about the vertical, by any angle
        "tilted": _tilted,
        "lying": _lying,
        "overturned": _overturned,
        "spun": _spun,
        "shrunk": partial(_scaled, factor=SCALES[0]),
        "grown": partial(_scaled, factor=SCALES[1]),
        "noise.0001": partial(_noisy, share=1e-4),
        "noise.0005": partial(_noisy, share=5e-4),
        "noise.001": partial(_noisy, share=1e-3),
        "half-faces": partial(_decimated, share=0.5),
        "quarter-faces": partial(_decimated, share=0.25),
        "unseen-gone": _unseen_gone,
        "doubled": doubled,  # every face is there twice
        "two-sided": two_sided,
        "inside-out": inside_out,
        "mixed": mixed,  # about half of the faces are reversed
        "cracked": cracked,
        "misplaced": misplaced,  # every component a little
        "tight": tight,  # movable parts without clearance
        "detailed": detailed,  # with screws, labels and the like
        "furnished": furnished,  # with loose things on it and in it
        "floored": floored,
        "ajar": ajar,  # some joints at other positions of their ranges
        "joined": _joined,
        "fused": partial(_fused, cells=FINE),
        "fused-coarse": partial(_fused, cells=COARSE),
    }
)
