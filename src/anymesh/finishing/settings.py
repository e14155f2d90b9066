"""Settings of Stage C's shape completion, with their units."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ShapeConfig:
    """Settings of the built-in shape completer (paper, 3.4). Lengths are shares of the object's diagonal unless stated."""

    watertight: bool = True  # also close surfaces that no motion uncovers
    wall: float = 0.02  # thickness given to open shells, inwards; furniture boards have 1.5 %, appliance walls 2 to 4 %
    sheet: float = 0.001  # the same if both sides are visible: the visible surface must not move
    clearance: float = 0.002  # left between parts that move against each other
    plate: float = 0.35  # maximum thickness over width of a door, drawer front, lid or board; others are shells
    flat: float = 0.02  # share of its size by which a hole's border may leave a plane
    shown: float = 0.1  # minimum share of visible points for a side, or for the cover of a hole, to count as visible
    drawer_height: float = 0.8  # of a drawer's box, as a share of the free height behind its front
    drawer_keep: float = 0.1  # share of a drawer's depth that stays inside when it is open
