"""Fitted kitchens: runs of base units with a sink and a dishwasher."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.shells import Room
from training.kinds.solids import Span, box


def cell(m: Model, x: Span, deep: float, z: Span, t: float) -> Room:
    """One unit of boards without a top; its room."""
    m.add(BASE, *(box(s, (0.0, deep), z) for s in ((x[0], x[0] + t), (x[1] - t, x[1]))))
    m.add(BASE, box((x[0] + t, x[1] - t), (0.0, deep), (z[0], z[0] + t)), box(x, (deep - 0.006, deep), z))
    return (x[0] + t, x[1] - t), (z[0] + t, z[1] - 0.004)
