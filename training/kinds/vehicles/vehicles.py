"""Cars, trucks and buses: sides with doors cut out of one outline, wheels, bonnets, tailgates, tipping beds."""

from __future__ import annotations

from shapely.geometry import MultiPolygon, Polygon
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, prism, rod
from training.kinds.wheels import beam


def prisms(outline: Polygon | MultiPolygon, axis: str, depth: Span) -> list[Trimesh]:
    """Push every piece of an outline along an axis; slivers are left out."""
    pieces = getattr(outline, "geoms", [outline])
    return [prism(p, axis, depth) for p in pieces if p.geom_type == "Polygon" and p.area > 1e-6]


def side_door(m: Model, part: str, outline: Polygon, side: int, x: float, thick: float, window: Polygon | None, slides: bool):
    """A door in the side of a vehicle: hinged at its front edge, or sliding to the rear; x: the outer face, positive."""
    low_y, low_z, high_y, high_z = outline.bounds
    faces = sorted((side * x, side * (x - thick)))
    m.add(part, *prisms(outline.difference(window) if window else outline, "x", (faces[0], faces[1])))
    if window and m.chance(0.6):
        m.add(part, *prisms(window.buffer(0.003), "x", (side * (x - 0.6 * thick), side * (x - 0.4 * thick))))
    at = high_y - 0.18 * (high_y - low_y), low_z + 0.52 * (high_z - low_z)
    style = m.pick("bar", "none", "box")
    if style == "bar":
        m.add(part, beam((side * (x + 0.03), at[0] - 0.08, at[1]), (side * (x + 0.03), at[0] + 0.08, at[1]), 0.02, 0.02))
        m.add(part, *(rod((side * x, at[0] + c, at[1]), (side * (x + 0.03), at[0] + c, at[1]), 0.01, 6) for c in (-0.06, 0.06)))
    elif style == "box":
        m.add(part, box((side * x, side * (x + 0.02)), (at[0] - 0.1, at[0] + 0.05), (at[1] - 0.02, at[1] + 0.02)))
    if slides:
        m.slide(part, (0, 1, 0), 0.9 * (high_y - low_y))
    else:
        m.hinge(
            part, (side * (x - m.pick(0.0, 0.5, 1.0) * thick), low_y, middle((low_z, high_z))), (0, 0, -side), m.pick(60, 75)
        )
