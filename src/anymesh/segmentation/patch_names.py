"""Names of patches: those of their nodes and materials that are recognized."""

from __future__ import annotations

import numpy as np
from jaxtyping import Int

from anymesh.geometry.patches import ObjectShape
from anymesh.types import Mesh
from anymesh.vocabulary import is_fixed_name, recognize


def named_groups(mesh: Mesh, whole: ObjectShape) -> tuple[Int[np.ndarray, " P"], tuple[str, ...]]:
    """Return the number of the group of each patch, from 0, and the recognized name of each patch, or "".

    The patches of a node with a recognized name are one group, all others are groups of their own. The material
    of most of the surface names nothing.
    """
    faces = np.split(np.argsort(whole.mesh_patch, kind="stable"), np.cumsum(np.bincount(whole.mesh_patch))[:-1])
    names, key = [""] * len(faces), np.arange(len(faces))
    common = int(np.bincount(mesh.face_material + 1, mesh.face_areas).argmax()) - 1
    for p, mine in enumerate(faces):
        node, material = _most_frequent(mesh.face_node[mine]), _most_frequent(mesh.face_material[mine])
        name = mesh.nodes[node].name
        if recognize(name) is not None or is_fixed_name(name):
            names[p], key[p] = name, len(faces) + node
        elif material not in (-1, common) and recognize(mesh.materials[material].name) is not None:
            names[p] = mesh.materials[material].name  # a material names a patch, but does not show that patches move together
    return np.unique(key, return_inverse=True)[1].reshape(-1), tuple(names)


def _most_frequent(numbers: Int[np.ndarray, " n"]) -> int:
    """Return the most frequent number; -1 stands for none."""
    return int(np.bincount(numbers + 1).argmax()) - 1
