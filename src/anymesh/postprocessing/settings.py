"""Numbers of Stage C's shape completion, once, with their units."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ShapeConfig:
    """The built-in shape completer (paper, 3.4). Lengths are shares of the object's diagonal unless said."""

    watertight: bool = True  # also close what no motion ever lays open
    wall: float = 0.02  # thickness given to open shells, inwards; boards of furniture have 1.5 %, walls of appliances 2 to 4 %
    sheet: float = 0.001  # the same where both sides are seen: the surface that is seen must not move
    clearance: float = 0.002  # left between parts that move against each other
    plate: float = 0.35  # thickness over width of a door, drawer front, lid or board at most; others are shells
    flat: float = 0.02  # share of its size by which a hole's border may leave a plane
    shown: float = 0.1  # share of its points in sight from which a side, or the cover of a hole, is seen
    drawer_height: float = 0.8  # of a drawer's box, as a share of the height that is free behind its front
    drawer_keep: float = 0.1  # share of a drawer's depth that stays in when it is out
