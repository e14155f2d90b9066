"""Densities by the words of a material's name.

Steel, aluminium, brass, bronze, copper, iron, glass, stone, concrete, rubber, water and oak are within the ranges of the table
of mass densities in Gere, Mechanics of Materials (5th edition). The others are rounded typical values, and vary by a tenth and
more. The maximum thickness of solid components, and the wall thickness of thicker ones, are estimates from typical household
objects.
"""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Substance:
    """Density and wall thickness of a material.

    density [kg/m^3]; solid_to: a closed component with a greater mean thickness [m] is hollow; sheet: thickness of the walls of
    hollow components and open shells [m].
    """

    density: float
    solid_to: float
    sheet: float


METAL, PLASTIC, WOOD, CERAMIC = (0.015, 0.0012), (0.012, 0.003), (0.08, 0.016), (0.04, 0.006)
SOLID = (float("inf"), 0.01)
SUBSTANCES = {
    "steel": Substance(7850.0, *METAL),
    "stainless": Substance(7900.0, *METAL),
    "inox": Substance(7900.0, *METAL),
    "iron": Substance(7200.0, *METAL),
    "metal": Substance(7850.0, *METAL),
    "chrome": Substance(7850.0, *METAL),
    "aluminium": Substance(2700.0, *METAL),
    "aluminum": Substance(2700.0, *METAL),
    "brass": Substance(8500.0, *METAL),
    "bronze": Substance(8800.0, *METAL),
    "copper": Substance(8900.0, *METAL),
    "zinc": Substance(7140.0, *METAL),
    "silver": Substance(10490.0, *METAL),
    "gold": Substance(19300.0, *METAL),
    "glass": Substance(2500.0, 0.012, 0.004),
    "mirror": Substance(2500.0, 0.012, 0.004),
    "ceramic": Substance(2300.0, *CERAMIC),
    "porcelain": Substance(2400.0, *CERAMIC),
    "clay": Substance(1900.0, *CERAMIC),
    "tile": Substance(2200.0, *CERAMIC),
    "stone": Substance(2600.0, *SOLID),
    "marble": Substance(2700.0, *SOLID),
    "granite": Substance(2700.0, *SOLID),
    "concrete": Substance(2400.0, *SOLID),
    "brick": Substance(1900.0, *SOLID),
    "wood": Substance(650.0, *WOOD),
    "oak": Substance(720.0, *WOOD),
    "pine": Substance(510.0, *WOOD),
    "walnut": Substance(640.0, *WOOD),
    "beech": Substance(720.0, *WOOD),
    "birch": Substance(650.0, *WOOD),
    "maple": Substance(700.0, *WOOD),
    "bamboo": Substance(700.0, *WOOD),
    "plywood": Substance(600.0, *WOOD),
    "mdf": Substance(750.0, *WOOD),
    "chipboard": Substance(680.0, *WOOD),
    "cork": Substance(200.0, *SOLID),
    "plastic": Substance(1050.0, *PLASTIC),
    "abs": Substance(1050.0, *PLASTIC),
    "acrylic": Substance(1180.0, *PLASTIC),
    "pvc": Substance(1380.0, *PLASTIC),
    "nylon": Substance(1140.0, *PLASTIC),
    "rubber": Substance(1100.0, 0.02, 0.004),
    "leather": Substance(860.0, 0.004, 0.002),
    "fabric": Substance(300.0, *SOLID),
    "cloth": Substance(300.0, *SOLID),
    "foam": Substance(40.0, *SOLID),
    "cushion": Substance(60.0, *SOLID),
    "paper": Substance(750.0, *SOLID),
    "cardboard": Substance(690.0, 0.01, 0.004),
    "water": Substance(1000.0, *SOLID),
    "ice": Substance(917.0, *SOLID),
}


def substance_of(name: str) -> Substance | None:
    """Return the substance of a material from the last known word of its name ("Black_Steel.001" is steel), else None."""
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)
    known = [SUBSTANCES[w.lower()] for w in words if w.lower() in SUBSTANCES]
    return known[-1] if known else None
