"""What careless modelling and exports do to a mesh, though it looks the same or nearly so in a viewer that draws both sides."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Bool

from anymesh.evaluation.ground_truth import EvalSample
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Mesh
from anymesh.types.triangles import bounds_of

CRACK = 1e-5  # of the diagonal: how far corners of neighbouring faces are apart, as where pieces are rounded on their own
OFF = 0.003  # of the diagonal: how far components that are placed by eye are off along each axis, at most
FIT = (4e-4, 5e-3)  # of the diagonal: from more than a touch to the widest clearance of a fit
FITTING = 0.01  # minimum share of a part's surface with such a clearance
ENLARGED = (0.7, 1.3)  # clearances by which the sides of a tight part are moved outwards, but at least 1
PROBES = 3000  # points on a part, at which its clearance is measured


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
        probes = sample_surface(mesh.triangles[own], PROBES, int(rng.integers(2**31)))
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
        corner_normal=None if normal is None else flip(np.where(which[:, None, None], -normal, normal)),
    )
