"""Windings: whether the faces of a surface agree about its two sides, and which side is the outer one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.connected import label_connected
from anymesh.geometry.sampling import spread_directions, spread_points
from anymesh.geometry.triangle_set import SLANTED, TriangleSet
from anymesh.types.triangles import face_cross

MIN_VOLUME_SHARE = 0.1  # of the volumes between the faces and their middle: a surface around less has no outside
FLAT = 1e-9  # of the area to the power of 1.5: a smaller volume is rounding
LOOKING_POINTS = 1500  # points on open surfaces from which both sides look outside
LOOKS = 8  # directions in which each point looks
MIN_SEEN_MORE = 0.3  # share of these rays by which one side must see more than the other; less is chance


@dataclass(frozen=True, eq=False)
class Winding:
    """How the faces of each component must be wound.

    label: (F,) component of each face; flip: (F,) faces to reverse; two_sided: (c,) components whose faces can agree; sure:
    (F,) faces of components that enclose a volume.
    """

    label: Int[np.ndarray, " F"]
    flip: Bool[np.ndarray, " F"]
    two_sided: Bool[np.ndarray, " c"]
    sure: Bool[np.ndarray, " F"]


def agreeing(
    count: int, pairs: Int[np.ndarray, "m 2"], aligned: Bool[np.ndarray, " m"]
) -> tuple[Int[np.ndarray, " F"], Bool[np.ndarray, " F"], Bool[np.ndarray, " c"]]:
    """Return the component of each face, which faces to reverse so that all of a component agree with its first, and whether
    they can.

    pairs: faces that meet at an edge; aligned: whether they agree. No face of a one-sided component, such as a Moebius strip,
    is reversed.
    """
    label = label_connected(count, pairs)
    components = int(label.max()) + 1
    if aligned.all():
        return label, np.zeros(count, bool), np.ones(components, bool)
    f, g = pairs.T  # each face is two nodes, as it is and reversed
    side = label_connected(2 * count, np.concatenate([np.c_[f, g + count * ~aligned], np.c_[f + count, g + count * aligned]]))
    first = np.unique(label, return_index=True)[1]
    two_sided = side[first] != side[first + count]
    return label, two_sided[label] & (side[:count] != side[first][label]), two_sided


def outward(triangles: Float[np.ndarray, "F 3 3"], pairs: Int[np.ndarray, "m 2"], aligned: Bool[np.ndarray, " m"]) -> Winding:
    """Return how to wind the faces so that each component faces outwards.

    pairs, aligned: as in `agreeing`.

    A component that encloses hardly any volume, such as a flat sheet, is wound as most of its surface is, unless most of the
    other components are inside out.
    """
    label, flip, two_sided = agreeing(len(triangles), pairs, aligned)
    count = len(two_sided)
    faces = np.bincount(label, minlength=count)
    middle = np.stack([np.bincount(label, triangles[:, :, k].mean(1), count) for k in range(3)], 1) / faces[:, None]
    t = triangles - middle[label][:, None]
    cross = face_cross(t)
    volume = np.where(flip, -1, 1) * np.einsum("ij,ij->i", t[:, 0], cross)
    total, enclosed = np.bincount(label, volume, count), np.bincount(label, np.abs(volume), count)
    areas = np.linalg.norm(cross, axis=1)
    area, kept = np.bincount(label, areas, count), np.bincount(label, np.where(flip, -areas, areas), count)
    around = np.abs(total) > np.maximum(MIN_VOLUME_SHARE * enclosed, FLAT * area**1.5)
    inside_out = (np.sign(total) * kept)[around].sum() < 0
    reverse = np.where(around, total < 0, (kept < 0) ^ inside_out) & two_sided
    return Winding(label, flip ^ reverse[label], two_sided, around[label])


def back_to_back(
    triangles: Float[np.ndarray, "F 3 3"], corner: Int[np.ndarray, "F 3"], asked: Bool[np.ndarray, " F"]
) -> tuple[Bool[np.ndarray, " F"], Bool[np.ndarray, " F"]]:
    """Return which of some faces lie in pairs on each other, and which of these to reverse so that each pair is back to back.

    corner: numbers of the corners. In one plane, the first faces of all pairs face the same side, so that a side on which two
    solids lie on each other becomes a side of each.
    """
    rows = np.flatnonzero(asked)
    place, count = np.unique(np.sort(corner[rows], 1), axis=0, return_inverse=True, return_counts=True)[1:]
    place = place.reshape(-1)
    rows, place = rows[count[place] == 2], place[count[place] == 2]
    first, second = rows[np.argsort(place, kind="stable")].reshape(-1, 2).T
    ahead = face_cross(triangles) @ SLANTED > 0
    paired, flip = np.zeros(len(asked), bool), np.zeros(len(asked), bool)
    paired[rows], flip[first], flip[second] = True, ~ahead[first], ahead[second]
    return paired, flip


def seen_from_behind(shape: TriangleSet, label: Int[np.ndarray, " F"], asked: Bool[np.ndarray, " F"]) -> Bool[np.ndarray, " F"]:
    """Return the faces of components that see more of the outside behind them than on the side that they face.

    asked: faces of the components in question. Surfaces are modelled to be seen, so the side that sees the outside is the outer
    one, whatever the winding. A sheet that is seen from both sides stays as it is.
    """
    faces = np.flatnonzero(asked)
    if not len(faces):
        return np.zeros(len(label), bool)
    triangles, normals, areas, scene = shape.triangles[faces], shape.normals[faces], shape.areas[faces], shape.scene
    points, at = spread_points(triangles, areas, LOOKING_POINTS, shape.seed)
    largest = _largest(label[faces], areas)[:LOOKING_POINTS]
    points, at = np.concatenate([points, triangles[largest].mean(1)]), np.concatenate([at, largest])
    ways = spread_directions(LOOKS)
    ahead = normals[at] @ ways.T > 0
    # a little off the surface, on the side that the ray leaves from
    start = points[:, None] + 1e-4 / scene.scale * np.where(ahead, 1.0, -1.0)[:, :, None] * normals[at][:, None]
    rays = np.broadcast_to(ways, start.shape)
    outside = scene.first_hit(start.reshape(-1, 3), rays.reshape(-1, 3)).face.reshape(ahead.shape) < 0
    count = int(label.max()) + 1
    lead = np.bincount(label[faces[at]], (outside & ahead).sum(1) - (outside & ~ahead).sum(1), count)
    cast = np.bincount(label[faces[at]], np.full(len(at), LOOKS / 2), count)
    return asked & (lead < -MIN_SEEN_MORE * cast)[label]


def _largest(label: Int[np.ndarray, " n"], areas: Float[np.ndarray, " n"]) -> Int[np.ndarray, " c"]:
    """Return the largest face of each component, the largest first."""
    order = np.lexsort((-areas, label))
    first = order[np.r_[True, np.diff(label[order]) != 0]]
    return first[np.argsort(-areas[first], kind="stable")]
