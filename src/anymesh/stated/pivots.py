"""Origins of nodes that tell about a hinge: artists of game packs put the origin of a door or a lid on the line it turns about.

Most origins say nothing: programs put them into the middle of a box, all at the scene's origin, or at one corner of each box.
The numbers were chosen on the dev packs of `benchmarks/packs.csv`; those called an estimate decide nothing on them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.boxes import OrientedBox, fit_box
from anymesh.types import Mesh

SAME_PLACE_RATIO = 1e-4  # of the diagonal: origins nearer to each other are one; an estimate
MAX_OUTSIDE_RATIO = 0.1  # of the diagonal of a node's box: an origin farther outside of it is not its own; an estimate
OFF_RATIO = 0.5  # of half a side: an origin nearer to the middle is in the middle; hinges of packs begin at .66
END_RATIO = 0.9  # of half a side: an origin farther from the middle is at the end; packs have .91 and more
THIN_RATIO = 0.25  # of the longest side: a shorter one is a thickness, where the origin may lie at any depth
# of half a side: nearer to the middle of the lowest face, a node is placed by what it stands on; an estimate
MIDDLE_RATIO = 0.25
ALIKE_RATIO, MAX_ALIKE_SHARE = 0.1, 0.8  # of half a side; share of the other nodes' area whose origins lie as in their boxes
MAX_EXAMINED = 1000  # nodes; of more, none is looked at

UPWARDS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def with_telling_pivots(mesh: Mesh, up: str | None) -> Mesh:
    """Return a mesh in the coordinates of its file with the pivots that tell about a hinge, and without the others.

    up: axis that points up in the file; None means y.
    """
    if mesh.face_pivot is None:
        return mesh
    telling = set(_telling(mesh, np.array(UPWARDS[up or "y"])))
    kept = (node if k in telling else replace(node, pivot=None) for k, node in enumerate(mesh.nodes))
    return replace(mesh, nodes=tuple(kept))


def _telling(mesh: Mesh, up: Float[np.ndarray, " 3"]) -> Iterator[int]:
    """Yield the nodes whose pivots are their own, unlike those of most other nodes, and at a hinge of their boxes."""
    area = np.bincount(mesh.face_node, mesh.face_areas, len(mesh.nodes))
    nodes = [k for k in np.argsort(-area, kind="stable").tolist() if area[k] > 0 and mesh.nodes[k].pivot is not None]
    if not 1 < len(nodes) <= MAX_EXAMINED:
        return
    order = np.argsort(mesh.face_node, kind="stable")
    first = np.searchsorted(mesh.face_node[order], np.arange(len(mesh.nodes) + 1))
    faces = {k: order[first[k] : first[k + 1]] for k in nodes}
    pivots = np.array([mesh.nodes[k].pivot for k in nodes])
    bounds = np.array([[(t := mesh.triangles[faces[k]]).min((0, 1)), t.max((0, 1))] for k in nodes])
    place = (pivots - bounds.mean(1)) / np.maximum(np.ptp(bounds, axis=1) / 2, 1e-12 * mesh.diagonal)
    taken = np.zeros((1, 3))  # by the scene and by larger nodes
    for row, k in enumerate(nodes):
        own = np.linalg.norm(taken - pivots[row], axis=1).min() > SAME_PLACE_RATIO * mesh.diagonal
        taken = np.concatenate([taken, pivots[row : row + 1]])
        alike = (np.abs(place - place[row]) < ALIKE_RATIO).all(1)
        others = area[nodes] * (np.arange(len(nodes)) != row)
        if own and others[alike].sum() <= MAX_ALIKE_SHARE * others.sum():
            mine = faces[k]
            box = fit_box(mesh.triangles[mine].reshape(-1, 3), mesh.face_normals[mine], mesh.face_areas[mine])
            if at_hinge(box, pivots[row], up):
                yield k


def at_hinge(box: OrientedBox, pivot: Float[np.ndarray, " 3"], up: Float[np.ndarray, " 3"]) -> bool:
    """Return whether a point lies where a hinge of a box may be: at an edge, or at the end of a plate or a rod.

    The middle of a side, a corner of a block and the middle of the lowest face are where programs put origins.
    """
    half = np.maximum(box.half, 1e-12 * box.diagonal)
    local = box.local(pivot[None])[0]
    if np.linalg.norm(np.maximum(np.abs(local) - half, 0)) > MAX_OUTSIDE_RATIO * box.diagonal:
        return False
    place = local / half
    off: Bool[np.ndarray, " 3"] = np.abs(place) > OFF_RATIO
    thin = half < THIN_RATIO * half.max()
    upright = int(np.abs(box.axes @ up).argmax())
    across = np.abs(np.delete(place, upright)).max()
    stands = place[upright] * np.sign(box.axes[upright] @ up) < -END_RATIO and across < MIDDLE_RATIO
    corner = not thin.any() and np.abs(place).min() > END_RATIO
    return bool((off & ~thin).any() and (off.sum() > 1 or thin.any()) and not stands and not corner)
