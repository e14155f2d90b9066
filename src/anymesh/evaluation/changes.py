"""Deliberate changes to a mesh, as made by scans, generators and careless exports, with ground truth carried over."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from enum import StrEnum
from functools import partial
from types import MappingProxyType

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.errors import OptionError
from anymesh.evaluation.details import detailed, floored, furnished
from anymesh.evaluation.fused_ import joined, wrapped
from anymesh.evaluation.ground_truth import EvalSample, of_parts
from anymesh.evaluation.posing import ajar
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface, spread_directions
from anymesh.loading.upright import infer_up, up_of
from anymesh.prompted.grounding.cloud import point_colors
from anymesh.types import Mesh, Node
from anymesh.types.triangles import bounds_of, normals_and_areas, unshared

CRACK = 1e-5  # of the diagonal: how far corners of neighbouring faces are apart, as where pieces are rounded on their own
OFF = 0.003  # of the diagonal: how far components that are placed by eye are off along each axis, at most
FIT = (4e-4, 5e-3)  # of the diagonal: from more than a touch to the widest clearance of a fit
FITTING = 0.01  # minimum share of a part's surface with such a clearance
ENLARGED = (0.7, 1.3)  # clearances by which the sides of a tight part are moved outwards, but at least 1
GAP_PROBES = 3000  # points on a part, at which its clearance is measured
Change = Callable[[EvalSample, np.random.Generator], EvalSample]
TILT = 5.0  # [deg] tilt from level, as in a scan
SCALES = (0.01, 100.0)  # confusion of centimetres and metres, in both directions
ROUGHEST = 60  # minimum number of faces of a decimated component; a box has 12 and cannot be reduced
PROBES = 20_000  # points on the surface that determine which faces are visible, besides the centroid of every face
DIRECTIONS = 128  # directions from which each point is viewed
FINE, COARSE = 256, 128  # cells along the longest side of an object that is fused to one surface
FUSED_FACES = 50_000  # of that surface; generated meshes have about as many


def doubled(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Add a copy of every face at the same place."""
    twice = np.tile(np.arange(len(sample.mesh.faces)), 2)
    return replace(sample, mesh=sample.mesh.subset(twice), labels=sample.labels[twice])


def two_sided(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Add the back of every face, as modellers do whose viewer draws one side only."""
    both = doubled(sample, rng)
    return replace(both, mesh=_reversed(both.mesh, np.arange(len(both.labels)) >= len(sample.labels)))


def inside_out(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Reverse every face."""
    return replace(sample, mesh=_reversed(sample.mesh, np.ones(len(sample.labels), bool)))


def mixed(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Reverse about half of the faces, each by chance."""
    return replace(sample, mesh=_reversed(sample.mesh, rng.random(len(sample.labels)) < 0.5))


def cracked(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Move every corner of every face a little, so that no two faces share a corner."""
    mesh = sample.mesh
    corners = mesh.triangles.reshape(-1, 3)
    corners = corners + rng.uniform(-1, 1, corners.shape) * CRACK / 2 * mesh.diagonal
    return replace(sample, mesh=replace(mesh, vertices=corners, faces=np.arange(len(corners)).reshape(-1, 3)))


def misplaced(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Move every component a little, so that some that touched are sunk into each other and others apart."""
    mesh = sample.mesh
    label = components(mesh.vertices, mesh.faces).label
    shift = rng.uniform(-OFF, OFF, (int(label.max()) + 1, 3)) * mesh.diagonal
    corners = (mesh.triangles + shift[label][:, None]).reshape(-1, 3)
    return replace(sample, mesh=replace(mesh, vertices=corners, faces=np.arange(len(corners)).reshape(-1, 3)))


def tight(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Enlarge each movable part until it touches what it fits into, as modelled by those who need not move it."""
    mesh, corners = sample.mesh, sample.mesh.triangles.copy()
    factor = max(1.0, rng.uniform(*ENLARGED))
    for part in range(1, len(sample.truth.parts)):
        own = sample.labels == part
        if not own.any() or own.all():
            continue
        probes = sample_surface(mesh.triangles[own], GAP_PROBES, int(rng.integers(2**31)))
        gap = distance_to_mesh(probes.points, mesh.vertices, mesh.faces[~own])[0] / mesh.diagonal
        fits = (gap > FIT[0]) & (gap < FIT[1])
        if fits.mean() > FITTING:
            low, high = bounds_of(corners[own].reshape(-1, 3))
            center, half = (low + high) / 2, np.maximum((high - low) / 2, FIT[0] * mesh.diagonal)
            outwards = factor * float(np.quantile(gap[fits], 0.25)) * mesh.diagonal
            corners[own] = center + (corners[own] - center) * (1 + outwards / half)
    faces = np.arange(3 * len(corners)).reshape(-1, 3)
    return replace(sample, mesh=replace(mesh, vertices=corners.reshape(-1, 3), faces=faces))


def _reversed(mesh: Mesh, which: Bool[np.ndarray, " F"]) -> Mesh:
    """Return the mesh with some faces seen from behind."""

    def flip(rows: np.ndarray | None) -> np.ndarray | None:
        return None if rows is None else np.where(which.reshape(-1, *[1] * (rows.ndim - 1)), rows[:, ::-1], rows)

    normal = mesh.corner_normal
    return replace(
        mesh,
        faces=flip(mesh.faces),
        corner_uv=flip(mesh.corner_uv),
        corner_color=flip(mesh.corner_color),
        corner_more_uv=flip(mesh.corner_more_uv),
        corner_normal=None if normal is None else flip(np.where(which[:, None, None], -normal, normal)),
    )


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
    return resurfaced(sample, *unshared(np.concatenate(made)), nodes=True)


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
    return resurfaced(sample, *unshared(few))


def _joined(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Return the exact union of all closed components, as from a CAD export or a boolean; open ones stay unchanged."""
    mesh = sample.mesh
    mesh_components = components(mesh.vertices, mesh.faces)
    triangles = np.where(mesh_components.flip[:, None, None], mesh.triangles[:, ::-1], mesh.triangles)
    solids = [triangles[mesh_components.label == c] for c in np.flatnonzero(mesh_components.solid)]
    open_ones = triangles[~mesh_components.solid[mesh_components.label]]
    return resurfaced(sample, *unshared(np.concatenate([joined(solids), open_ones]) if solids else open_ones))


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
    labels = sample.labels[kept]
    there = np.bincount(labels, minlength=len(sample.truth.parts)) > 0
    there[0] = True
    truth, number = of_parts(sample.truth, np.flatnonzero(there))
    return replace(sample, truth=truth, mesh=sample.mesh.subset(kept), labels=number[labels])


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


class UpSource(StrEnum):
    """Where the up direction of a mesh comes from."""

    MESH = "mesh"  # its z axis, which a change such as `spun` makes wrong
    GIVEN = "given"  # the true direction, as a user may give it by --up
    INFER = "infer"  # inferred from the shape alone, without a usual axis


def placed_by(source: UpSource, sample: EvalSample) -> EvalSample:
    """Rotate the sample so that the direction of this source points along z."""
    if source is UpSource.MESH:
        return sample
    up = up_of(sample.up) if source is UpSource.GIVEN else infer_up(sample.mesh, None)
    T = np.eye(4)
    T[:3, :3] = up.to_z
    return moved(sample, T)
