"""What the bodies of an object are made of where no material tells, and whether they are hollow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from anymesh.kinds.usual import Kind, doubts, kind_of
from anymesh.physics.substances import SUBSTANCES, Substance
from anymesh.types import Asset
from anymesh.vocabulary import recognize

CLOSED_TO = SUBSTANCES["wood"].solid_to  # [m] mean thickness above which bodies of closed furniture and appliances are hollow
CASE, FRONTS = SUBSTANCES["chipboard"], ("door", "drawer")  # of an unknown object with such parts, which is furniture
LARGEST_CASE = 2.7  # [m] longest side of furniture, as of a wardrobe; larger things with doors are buildings and gates


@dataclass(frozen=True)
class UsualBodies:
    """What is usual for an object.

    kind: as in the table of kinds, None if unknown; closed: its solid bodies are hollow; wall: of bodies of the substance, None
    for that of the substance [m].
    """

    kind: Kind | None
    closed: bool
    substance: Substance | None
    wall: float | None = None

    @classmethod
    def of(cls, asset: Asset) -> UsualBodies:
        kind, longest = kind_of(asset.category, asset.name), float(max(asset.mesh.extents))
        if kind is not None:
            size = 1.0 if kind.usual is None else min(1.0, longest / kind.usual)  # walls of small models are thin
            return cls(kind, kind.closed, SUBSTANCES.get(kind.substance), None if kind.wall is None else kind.wall * size)
        words = (recognize(part.label) for part in asset.segmentation.parts)
        closed = longest <= LARGEST_CASE and any(word is not None and word.label in FRONTS for word in words)
        return cls(None, closed, CASE if closed else None)

    def walled(self, substance: Substance | None) -> Substance | None:
        """Return a substance as the object's bodies have it: hollow if they are thick, with the walls of the kind."""
        if substance is None or not self.closed:
            return substance
        walled = self.wall is not None and self.substance is not None and substance.density == self.substance.density
        sheet = self.wall if self.wall is not None and walled else substance.sheet
        return replace(substance, solid_to=min(substance.solid_to, CLOSED_TO), sheet=sheet)

    def doubts(self, asset: Asset, masses: Sequence[tuple[str, float]], *, given: bool) -> tuple[str, ...]:
        """Return warnings about an implausible size or mass; masses, given: as of `usual.doubts`."""
        return doubts(self.kind, asset.mesh.extents, masses, given=given)


def usual_bodies(asset: Asset) -> UsualBodies:
    """Return how the bodies of an object usually are."""
    return UsualBodies.of(asset)
