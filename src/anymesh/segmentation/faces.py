"""From labelled points to the faces of parts: whole pieces where these are a part's, clean cuts where they are not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Int
from scipy.spatial import KDTree

from anymesh.config import Config
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.segmentation.cloud import Cloud
from anymesh.segmentation.contacts import Contacts, find_contacts, hanging_on
from anymesh.segmentation.fuse import Counts, Instances
from anymesh.types import Mesh

UNSEEN = -1
ALONE = 0.5  # a component joins the part of so much of its visible surface (the paper's implementation)
SLIVER = 0.02  # share of a piece's surface; of less, seen through a gap, no view tells what it is
CUTTABLE = 0.85  # the same for a piece that may hold several parts, as it is large or was cut out of a fused surface


def face_parts(
    mesh: Mesh, whole: ObjectShape, cloud: Cloud, point_part: Int[np.ndarray, " n"], config: Config | None = None
) -> Int[np.ndarray, " F"]:
    """A part number a face, 0 = the rest. point_part: of every point of the cloud, 0 the rest, -1 where no view tells.

    A piece goes to one part as a whole; one of several parts is cut along the borders of its superpoints. A piece that no
    view sees joins the part that holds it.
    """
    config = config or Config()
    most = int(point_part.max(initial=0)) + 1
    piece = whole.mesh_piece[cloud.faces]
    pieces = int(whole.mesh_piece.max()) + 1
    known = point_part >= 0
    votes = np.bincount(piece[known] * most + point_part[known], minlength=pieces * most).reshape(pieces, most)
    total = votes.sum(1)
    told = total > SLIVER * np.bincount(piece, minlength=pieces)
    winner = np.where(told, votes.argmax(1), UNSEEN)
    share = votes.max(1) / np.maximum(total, 1)
    mixed = told & (share <= np.where(_cuttable(mesh, whole, config), CUTTABLE, ALONE))
    winner = _unseen_joined(whole, winner, config)
    found = winner[whole.mesh_piece]
    for p in np.flatnonzero(mixed):
        mine = np.flatnonzero(piece == p)
        faces, label = _cut(cloud, mine, point_part[mine], most)
        found[faces] = label
    return np.maximum(found, 0)


def _cuttable(mesh: Mesh, whole: ObjectShape, config: Config) -> Bool[np.ndarray, " P"]:
    """Pieces that may hold several parts: parts of a fused surface, and large ones."""
    count = int(whole.mesh_piece.max()) + 1
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, whole.mesh_piece, mesh.triangles.min(1))
    np.maximum.at(high, whole.mesh_piece, mesh.triangles.max(1))
    large = np.linalg.norm(high - low, axis=1) > config.pieces.fused_size * whole.diagonal
    large[whole.shared.reshape(-1)] = True
    return large


def _cut(cloud: Cloud, mine: np.ndarray, part: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Faces of one piece and the part of each: its superpoints vote first, so that a border runs where theirs does.

    mine: points of the piece; part: of each, -1 unknown.
    """
    names, own = np.unique(cloud.superpoint[mine], return_inverse=True)
    own = own.reshape(-1)
    known = part >= 0
    votes = np.bincount(own[known] * most + part[known], minlength=len(names) * most).reshape(-1, most)
    best = np.where(votes.sum(1) > 0, votes.argmax(1), UNSEEN)
    label = best[own]
    lost = label < 0
    if lost.any():  # the nearest point that a view tells about, of the same piece
        nearest = KDTree(cloud.points[mine[~lost]]).query(cloud.points[mine[lost]], workers=-1)[1]
        label[lost] = label[~lost][nearest]
    faces, where = np.unique(cloud.faces[mine], return_inverse=True)
    inside = np.bincount(where.reshape(-1) * most + label, minlength=len(faces) * most).reshape(-1, most)
    return faces, inside.argmax(1)


def _unseen_joined(whole: ObjectShape, part: Int[np.ndarray, " P"], config: Config) -> Int[np.ndarray, " P"]:
    """The part of every piece, those that no view sees included: that of all the seen pieces that it touches, directly or
    through others; else the one that it hangs on or touches more than all else, or is near to and nothing else is."""
    if (part >= 0).all() or part.max() <= 0:
        return part
    contacts = find_contacts(whole, config.segmentation)
    reach = config.grounding.join_component * whole.diagonal
    part = _of_one_body(contacts.body, part)
    for together in (False, True):  # each on its own first; then unseen pieces that touch, a drawer's box, as one
        part = np.where(_goes_on(whole, part), 0, _held(contacts, part, together, reach))
    return part


def _goes_on(whole: ObjectShape, part: np.ndarray) -> Bool[np.ndarray, " P"]:
    """Unseen pieces from which a fused surface goes on into the rest: a strip of the floor behind a drawer's front."""
    found = np.zeros(len(part), bool)
    if len(whole.shared):
        a, b = whole.shared.T
        found[a[part[b] == 0]] = found[b[part[a] == 0]] = True
    return found & (part < 0)


def _of_one_body(body: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Unseen pieces of a body of which all that is seen is one part belong to it: nothing else touches it."""
    least, most = np.full(int(body.max()) + 1, np.iinfo(np.int64).max), np.full(int(body.max()) + 1, UNSEEN)
    np.minimum.at(least, body[part >= 0], part[part >= 0])
    np.maximum.at(most, body, part)
    one = (least == most) & (most >= 0)
    return np.where((part < 0) & one[body], most[body], part)


def _held(contacts: Contacts, part: np.ndarray, together: bool, reach: float) -> Int[np.ndarray, " P"]:
    """Unseen pieces that hang on a part or touch it more than all else; `together`: those that touch each other as one."""
    unseen = part < 0
    if not unseen.any() or not (part == 0).any():
        return part
    count = len(part)
    inner = contacts.touch[unseen[contacts.touch].all(1)] if together else np.zeros((0, 2), np.int64)
    key = np.where(unseen, count + label_connected(count, inner), part)
    _, unit = np.unique(key, return_inverse=True)
    unit = unit.reshape(-1)
    hanging = hanging_on(contacts, unit, int(unit[np.flatnonzero(part == 0)[0]]))
    found = part.copy()
    for k in np.unique(part[part > 0]):
        own = np.flatnonzero(part == k)
        for p in np.flatnonzero(np.isin(unit, hanging[int(unit[own[0]])]) & (found < 0)):
            if _near(contacts, int(p), own, reach):
                found[p] = k
    return _touching_most(contacts, unit, found)


def _touching_most(contacts: Contacts, unit: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Unseen units that touch one part more than all else belong to it: a drawer's box on a runner. Four rounds settle
    chains. (As `with_held`, but what is unseen may be larger than the part: a box behind its front.)"""
    found = part.copy()
    for _ in range(4):
        area = np.zeros((int(unit.max()) + 1, int(found.max()) + 2))  # the first column: of other unseen units
        for (i, j), a in contacts.area.items():
            if found[i] < 0 and unit[i] != unit[j]:
                area[unit[i], found[j] + 1] += a
        best = area.argmax(1)
        joins = (best > 1) & (area.max(1) > area.sum(1) - area.max(1))
        new = (found < 0) & joins[unit]
        if not new.any():
            break
        found[new] = best[unit[new]] - 1
    return found


def _near(contacts: Contacts, piece: int, others: np.ndarray, reach: float) -> bool:
    """Whether the piece's box is within `reach` of the box of one of the others [m]."""
    low, high = contacts.shapes[piece].bounds
    boxes = np.array([contacts.shapes[p].bounds for p in others])
    return bool(((boxes[:, 0] <= high + reach) & (boxes[:, 1] >= low - reach)).all(1).any())


def point_parts(cloud: Cloud, instances: Instances, counts: Sequence[Counts]) -> Int[np.ndarray, " n"]:
    """The part number of every point that a view sees, as its superpoint's: 0 the rest; -1 of those that none sees."""
    seen = np.zeros(len(cloud), bool)
    for c in counts:
        seen[c.points] = True
    return np.where(seen, instances.number[cloud.superpoint], UNSEEN)
