"""Tool trolleys and serving carts, and the castors and leaves that other furniture shares with them."""

from __future__ import annotations

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, rod
from training.kinds.wheels import caster


def castors(m: Model, x: Span, y: Span, high: float, still: bool = True) -> None:
    """Put four castors under a box: all swivel, two swivel, none swivels but all roll, or none moves."""
    how, r = m.pick("all", "all", "two", "two", "rolling", "still" if still else "all"), high / 2.5
    inset = 1.2 * r + 0.01
    for k, (a, b) in enumerate((a, b) for a in shrunk(x, inset) for b in shrunk(y, inset)):
        if how == "still":
            m.add(BASE, rod((a - 0.3 * r, b, r), (a + 0.3 * r, b, r), r, 12), rod((a, b, r), (a, b, high), 0.35 * r, 8))
        else:
            caster(m, f"castor_{k}", (a, b, high), r, how == "all" or (how == "two" and a < middle(x)))
