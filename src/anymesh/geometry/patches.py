"""The object as both stages use it: a surface in patches, the smallest elements of parts, simplified where it is dense."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from jaxtyping import Int

from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types.triangles import normals_and_areas

MAX_FACES = 8000  # denser meshes are simplified for questions of shape and motion, never in the output
# maximum number of faces added for small patches, relative to the number of faces kept of a dense mesh
SMALL_PATCH_FACES_RATIO = 3
KEPT_PATCH_FACES = 60  # minimum number of faces kept of a patch
MIN_PATCH_FACES = 20  # the same if there are very many patches


@dataclass(frozen=True, eq=False)
class ObjectShape:
    """The object as both stages use it. Dense meshes are simplified, each patch separately.

    shape: R faces; patch: (R,) patch of each face, numbered from 0; source: (R,) for each face a mesh face in the same
    patch; mesh_patch: (F,) patch of every mesh face; shared: (k, 2) patches that share edges; diagonal [m].
    """

    shape: TriangleSet
    patch: Int[np.ndarray, " R"]
    source: Int[np.ndarray, " R"]
    mesh_patch: Int[np.ndarray, " F"]
    shared: Int[np.ndarray, "k 2"]
    diagonal: float

    def of(self, faces: Int[np.ndarray, " n"]) -> TriangleSet:
        """Return some of the R faces."""
        return self.shape.take(faces)


@dataclass(frozen=True, eq=False)
class DividedSurface:
    """The faces of a mesh, oriented and divided into patches, before dense meshes are simplified.

    shape: all F faces; copy: (F,) face that each one copies, itself for most (`without_copies`); patch, shared, diagonal: as
    in `ObjectShape`.
    """

    shape: TriangleSet
    copy: Int[np.ndarray, " F"]
    patch: Int[np.ndarray, " F"]
    shared: Int[np.ndarray, "k 2"]
    diagonal: float

    def simplified(self, labels: Int[np.ndarray, " F"] | None = None) -> ObjectShape:
        """Leave out copies of faces and simplify each patch.

        labels: (F,) parts that are kept apart, each with its own copy of a face.
        """
        label = np.zeros(len(self.patch), np.int64) if labels is None else labels
        rows = np.flatnonzero((self.copy == np.arange(len(self.copy))) | (label != label[self.copy]))
        group = self.patch * (int(label.max()) + 1) + label
        shape, source = _simplified(self.shape.take(rows), group[rows])
        source = rows[source]
        return ObjectShape(shape.prepared(), self.patch[source], source, self.patch, self.shared, self.diagonal)


def _simplified(shape: TriangleSet, group: Int[np.ndarray, " F"]) -> tuple[TriangleSet, Int[np.ndarray, " R"]]:
    """Simplify each group in proportion to its faces; small groups are left unchanged."""
    count = len(group)
    if count <= MAX_FACES:
        return replace(shape, faces=np.arange(count)), np.arange(count)
    order = np.argsort(group, kind="stable")
    bounds = np.flatnonzero(np.r_[True, np.diff(group[order]) != 0, True])
    least = int(np.clip(SMALL_PATCH_FACES_RATIO * MAX_FACES / (len(bounds) - 1), MIN_PATCH_FACES, KEPT_PATCH_FACES))
    kept, source = [], []
    for a, b in pairwise(bounds):
        mine = order[a:b]
        few = simplify(shape.triangles[mine], max(least, int(MAX_FACES * len(mine) / count)))
        kept.append(few)
        source.append(mine if len(few) == len(mine) else np.full(len(few), mine[0]))
    reduced, where = np.concatenate(kept), np.concatenate(source)
    return TriangleSet(reduced, normals_and_areas(reduced)[0], shape.solid[where], np.arange(len(reduced)), shape.seed), where
