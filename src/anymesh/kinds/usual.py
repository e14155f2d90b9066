"""What is usual for a kind of object: its size, its mass and what it is made of. The values are in `kinds.json`.

A kind is named by the last known word or phrase of a category or of a name, as a table lamp is a lamp. Toys and models in
another scale are not of the kind that they show.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.vocabulary import SMALLER, recognize, words_of

FACTOR = 3.0  # sizes and masses within this factor of the usual range are plausible
LONGEST_PHRASE = 3  # words
PAIRS = frozenset(("scissors", "pliers", "glasses", "eyeglasses"))
LIGHTEST, HEAVIEST = 0.5, 9000.0  # [kg/m3] of the box around any object: a frame of thin sheet; copper
Range = tuple[float, float]


@dataclass(frozen=True)
class Kind:
    """A kind of object.

    name, first: it and the first name of its row in the table; usual: longest side [m]; longest, height: usual range [m];
    mass: usual range [kg]; substance: name; wall: of its hollow bodies of that substance [m]; closed: solid bodies of it are
    hollow; wikidata: item. None or "" for what is not known.
    """

    name: str
    first: str = ""
    usual: float | None = None
    longest: Range | None = None
    height: Range | None = None
    mass: Range | None = None
    substance: str = ""
    wall: float | None = None
    closed: bool = False
    wikidata: str = ""

    @property
    def words(self) -> str:
        """Return the name with its article."""
        name = self.name.replace("_", " ")
        name = f"pair of {name}" if name in PAIRS else name
        return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _floats(pair: list[Any]) -> Range:
    return float(pair[0]), float(pair[1])


def _kinds(rows: Sequence[dict[str, Any]]) -> dict[tuple[str, ...], Kind]:
    kinds = dict[tuple[str, ...], Kind]()
    for row in rows:
        names = row["words"].split()
        values: dict[str, Any] = {
            k: _floats(v) if isinstance(v, list) else v for k, v in row.items() if k not in ("words", "source")
        }
        kinds |= {tuple(words_of(name)): Kind(name, names[0], **values) for name in names}
    return kinds


_DATA = json.loads(files("anymesh.kinds").joinpath("kinds.json").read_text(encoding="utf-8"))
KINDS = _kinds(_DATA["kinds"])
ONE_WORD = frozenset(words[0] for words in KINDS if len(words) == 1)
ROOMS = tuple(_DATA["rooms"].split())
PARTS: dict[str, float] = {label: float(mass) for label, mass in _DATA["parts"].items()}


def kind_of(*texts: str | None) -> Kind | None:
    """Return the kind that the first of some texts names that names one, such as a category and a name; None without one."""
    known = [[part for word in words_of(text) for part in _apart(word)] for text in texts if text]
    smaller = any(SMALLER & set(words) for words in known)
    return next((kind for words in known if (kind := _last(words, smaller=smaller)) is not None), None)


def _apart(word: str) -> list[str]:
    """Return a room and a kind that are written as one word ("kitchencabinet") apart."""
    for room in ROOMS:
        rest = word.removeprefix(room)
        if rest != word not in ONE_WORD and (rest in ONE_WORD or (room, rest) in KINDS):
            return [room, rest]
    return [word]


def _last(words: list[str], *, smaller: bool) -> Kind | None:
    for end in range(len(words), 0, -1):
        for phrase in (tuple(words[max(end - n, 0) : end]) for n in range(LONGEST_PHRASE, 0, -1)):
            if phrase in KINDS and (not smaller or SMALLER & set(phrase)):
                return KINDS[phrase]
    return None


def usual_size(words: str) -> tuple[str, float] | None:
    """Return the kind named by a category or a file's name, and its usual longest side [m]; None if no kind is known."""
    kind = kind_of(words)
    return None if kind is None or kind.usual is None else (kind.name, kind.usual)


def doubts(
    kind: Kind | None, extents: Float[np.ndarray, " 3"], masses: Sequence[tuple[str, float]], *, given: bool = False
) -> tuple[str, ...]:
    """Return warnings about a size or a mass that is implausible for an object.

    extents: of its box, z up [m]; masses: label or name, and mass [kg] of each part, () if they are not known; given: its mass
    was given, and is not doubted.
    """
    total, known = sum(mass for _, mass in masses), bool(masses) and not given
    problems, usual, remedies = list[str](), list[str](), list[str]()
    if kind is not None and kind.mass is not None and known and _is_off(total, kind.mass):
        problems.append(f"mass {_number(total)} kg")
        usual.append(f"has {_range(kind.mass)} kg")
        remedies.append("--mass KG")
    factor = FACTOR if not problems else 1.0  # an unusual size may be why the mass is off
    off = [(range_, size, word) for range_, size, word in _sizes(kind, extents) if _is_off(size, range_, factor)]
    for range_, size, word in off[:1]:
        problems.append(f"{word} {_number(size)} m")
        usual.append(f"is {_range(range_)} m {'high' if word == 'height' else 'long'}")
        remedies.append("--scale" if kind is None or kind.usual is None else f"--scale {kind.usual:g}:longest")
    if problems and kind is not None:
        return (f"{' and '.join(problems)}; {kind.words} usually {' and '.join(usual)}; say {' or '.join(remedies)}",)
    return (*_absurd(extents, total if known else 0.0), *(_doubted_parts(kind, masses) if known else ()))


def _sizes(kind: Kind | None, extents: Float[np.ndarray, " 3"]) -> list[tuple[Range, float, str]]:
    if kind is None:
        return []
    sizes = ((kind.longest, float(max(extents)), "longest side"), (kind.height, float(extents[2]), "height"))
    return [(range_, size, word) for range_, size, word in sizes if range_ is not None]


def _absurd(extents: Float[np.ndarray, " 3"], mass: float) -> tuple[str, ...]:
    volume = float(np.prod(np.maximum(extents, 0.01 * np.linalg.norm(extents))))
    if mass <= 0 or LIGHTEST <= mass / volume <= HEAVIEST:
        return ()
    like = "denser than metal" if mass > volume else "lighter than foam"
    return (f"mass {_number(mass)} kg in a box of {volume:.3g} m3 is {like}; say --mass KG or --scale",)


def _doubted_parts(kind: Kind | None, masses: Sequence[tuple[str, float]]) -> tuple[str, ...]:
    """Return a warning about the part that is heaviest for its label; none about toys."""
    if kind is not None and SMALLER & set(words_of(kind.name)):
        return ()
    labelled = ((mass, word.label) for name, mass in masses if (word := recognize(name)) is not None)
    heavy = [(mass / PARTS[label], label, mass) for mass, label in labelled if mass > FACTOR * PARTS.get(label, np.inf)]
    if not heavy:
        return ()
    _, label, mass = max(heavy)
    return (
        f"mass {_number(mass)} kg of a {label}, which usually has up to {_number(PARTS[label])} kg; say --mass KG or --scale",
    )


def _is_off(value: float, usual: Range, factor: float = FACTOR) -> bool:
    return not usual[0] / factor <= value <= factor * usual[1]


def _range(usual: Range) -> str:
    return f"{_number(usual[0])} to {_number(usual[1])}"


def _number(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"
