"""What links are made of: by the words of a material's name, else by the kind of the part or of the object.

The values are in `substances.json` (of kinds of objects in `kinds/kinds.json`), their sources in docs/substances.md.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from importlib.resources import files

from anymesh.vocabulary import words_of


@dataclass(frozen=True)
class Substance:
    """A material of links.

    density [kg/m^3]; solid_to: a closed component with a greater mean thickness [m] is hollow; sheet: thickness of the walls of
    hollow components and open shells [m]; spread: of the density, relative; friction and restitution: of two surfaces of it.
    """

    name: str
    density: float
    solid_to: float
    sheet: float
    spread: float
    static_friction: float
    dynamic_friction: float
    restitution: float


_DATA = json.loads(files("anymesh.physics").joinpath("substances.json").read_text(encoding="utf-8"))
SUBSTANCES = {n: Substance(n, float(d), **f["values"]) for f in _DATA["families"] for n, d in f["densities"].items()}
_OF_PART = {word: SUBSTANCES[name] for name, words in _DATA["parts"].items() for word in words.split()}


def substance_of(name: str) -> Substance | None:
    """Return the substance of a material from the last known word of its name ("Black_Steel.001" is steel), else None."""
    return _last(SUBSTANCES, [w.lower() for w in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)])


def usual_substance(part: str) -> Substance | None:
    """Return what such a part usually is made of, whatever it belongs to, from the last known word of its name, else None."""
    return _last(_OF_PART, words_of(part))


def _last(table: dict[str, Substance], words: list[str]) -> Substance | None:
    return next((table[w] for w in reversed(words) if w in table), None)
