"""Assignment of patches that no view shows to the parts that support them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from jaxtyping import Bool, Int

from anymesh.config import Config
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.segmentation.contacts import Contacts, dominated_by, find_contacts
from anymesh.types.triangles import boxes_meet

UNSEEN = -1
StaysFree = Callable[[Int[np.ndarray, " R"], Int[np.ndarray, " R"], int], bool]
"""Return whether a part opens as far with unseen patches as without.

Arguments: the part index per face of the object's shape without and with the unseen patches, and the part.
"""


def join_unseen(
    whole: ObjectShape, part: Int[np.ndarray, " P"], config: Config, stays_free: StaysFree | None = None
) -> Int[np.ndarray, " P"]:
    """Assign unseen patches (part -1) to the parts that support them, the others to the base.

    A part does not gain patches that would limit its motion, such as the walls of a cavity behind its door.
    """
    joined = np.maximum(_joined(whole, part, config), 0)
    gaining = np.unique(joined[(part < 0) & (joined > 0)])
    if stays_free is None:
        return joined
    for k in gaining:
        without = np.where((part < 0) & (joined == k), 0, joined)
        if not stays_free(without[whole.patch], joined[whole.patch], int(k)):
            joined = without
    return joined


def _joined(whole: ObjectShape, part: Int[np.ndarray, " P"], config: Config) -> Int[np.ndarray, " P"]:
    """Return the part of every patch, including unseen ones.

    An unseen patch takes the part of all visible patches that it touches, directly or through others. Otherwise it takes the
    part on which it depends, that it touches more than all others, or that alone is near.
    """
    if (part >= 0).all() or part.max() <= 0:
        return part
    contacts = find_contacts(whole, config.segmentation)
    reach = config.grounding.join_component * whole.diagonal
    part = _single_part_components(contacts.touching_group, part)
    for together in (False, True):  # first one by one, then connected patches (a drawer's box) as one
        part = np.where(_goes_on(whole, part), 0, _supported_by(contacts, part, together, reach))
    return part


def _goes_on(whole: ObjectShape, part: np.ndarray) -> Bool[np.ndarray, " P"]:
    """Return unseen patches that continue a fused surface into the base, such as a strip of floor behind a drawer's panel."""
    adjoins_base = np.zeros(len(part), bool)
    if len(whole.shared):
        a, b = whole.shared.T
        adjoins_base[a[part[b] == 0]] = adjoins_base[b[part[a] == 0]] = True
    return adjoins_base & (part < 0)


def _single_part_components(component: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Assign unseen patches to the only visible part of their component."""
    least, most = np.full(int(component.max()) + 1, np.iinfo(np.int64).max), np.full(int(component.max()) + 1, UNSEEN)
    np.minimum.at(least, component[part >= 0], part[part >= 0])
    np.maximum.at(most, component, part)
    one = (least == most) & (most >= 0)
    return np.where((part < 0) & one[component], most[component], part)


def _supported_by(contacts: Contacts, part: np.ndarray, together: bool, reach: float) -> Int[np.ndarray, " P"]:
    """Assign unseen patches that depend on a part or touch it more than all others.

    together: treat unseen patches that touch each other as one.
    """
    unseen = part < 0
    if not unseen.any() or not (part == 0).any():
        return part
    count = len(part)
    inner = contacts.touch[unseen[contacts.touch].all(1)] if together else np.zeros((0, 2), np.int64)
    key = np.where(unseen, count + label_connected(count, inner), part)
    _, unit = np.unique(key, return_inverse=True)
    unit = unit.reshape(-1)
    dominated = dominated_by(contacts, unit, int(unit[np.flatnonzero(part == 0)[0]]))
    assigned_part = part.copy()
    for k in np.unique(part[part > 0]):
        own = np.flatnonzero(part == k)
        for u in dominated[int(unit[own[0]])]:
            free = np.flatnonzero((unit == u) & (assigned_part < 0))
            if any(_near(contacts, int(p), own, reach) for p in free):
                assigned_part[free] = k
    return _largest_contact(contacts, unit, assigned_part)


def _largest_contact(contacts: Contacts, group: np.ndarray, part: np.ndarray) -> Int[np.ndarray, " P"]:
    """Assign unseen groups to the part that they touch more than all others, such as a drawer's box on a runner.

    Four rounds resolve chains. An unseen group may be larger than the part: a box behind its panel.
    """
    assigned_part = part.copy()
    for _ in range(4):
        # the first column counts contact with other unseen groups
        area = np.zeros((int(group.max()) + 1, int(assigned_part.max()) + 2))
        for (i, j), a in contacts.area.items():
            if assigned_part[i] < 0 and group[i] != group[j]:
                area[group[i], assigned_part[j] + 1] += a
        best = area.argmax(1)
        joins = (best > 1) & (area.max(1) > area.sum(1) - area.max(1))
        new = (assigned_part < 0) & joins[group]
        if not new.any():
            break
        assigned_part[new] = best[group[new]] - 1
    return assigned_part


def _near(contacts: Contacts, patch: int, others: np.ndarray, reach: float) -> bool:
    """Return whether the patch's box is within `reach` [m] of the box of one of the others."""
    low, high = contacts.shapes[patch].bounds
    boxes = np.array([contacts.shapes[p].bounds for p in others])
    return bool(boxes_meet(boxes[:, 0], boxes[:, 1], low - reach, high + reach).any())
