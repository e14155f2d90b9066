"""Words for parts, and how such parts usually move. Free names are matched by their words, never by substrings."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from enum import StrEnum


class TypicalMotion(StrEnum):
    """How a kind of part usually moves."""

    HINGE = "hinge"
    PRISMATIC = "slide"
    SPIN = "spin"
    TWO_PIVOT = "bail"
    PRESS = "press"
    LEVER = "lever"  # a hinge or a slide: geometry decides
    NONE = "none"  # belongs to what it is fixed to


@dataclass(frozen=True)
class Word:
    """One kind of part."""

    label: str
    motion: TypicalMotion
    names: tuple[str, ...]


WORDS = (
    Word("door", TypicalMotion.HINGE, ("door", "tuer", "porte", "puerta", "porta", "hatch", "gate", "shutter")),
    Word(
        "lid",
        TypicalMotion.HINGE,
        ("lid", "cover", "hood", "bonnet", "trunk", "tailgate", "cap", "deckel", "screen", "display"),
    ),
    Word(
        "flap", TypicalMotion.HINGE, ("flap", "aileron", "elevator", "rudder", "slat", "visor", "tilt", "airbrake", "spoiler")
    ),
    Word(
        "drawer",
        TypicalMotion.PRISMATIC,
        ("drawer", "schublade", "tiroir", "cajon", "tray", "rack", "basket", "bin", "crisper"),
    ),
    Word("window", TypicalMotion.LEVER, ("window", "sash", "pane")),
    Word(
        "slider",
        TypicalMotion.PRISMATIC,
        ("slider", "slide", "sliding", "rail", "carriage", "piston", "plunger", "bolt", "magazine"),
    ),
    Word("button", TypicalMotion.PRESS, ("button", "key", "keycap", "trigger", "push")),
    Word("knob", TypicalMotion.SPIN, ("knob", "dial", "valve", "tap", "chuck", "control")),
    Word(
        "wheel",
        TypicalMotion.SPIN,
        (
            "wheel",
            "tire",
            "tyre",
            "caster",
            "castor",
            "roller",
            "rotor",
            "propeller",
            "fan",
            "gear",
            "steering",
            "turntable",
            "blade",
            "hub",
            "crank",
            "pulley",
            "spinner",
        ),
    ),
    Word("bail", TypicalMotion.TWO_PIVOT, ("bail", "swing")),
    Word("lever", TypicalMotion.LEVER, ("lever", "switch", "pedal", "arm", "toggle", "latch", "joystick", "stick", "brake")),
    Word("handle", TypicalMotion.LEVER, ("handle", "grip", "griff", "poignee")),
    Word("seat", TypicalMotion.LEVER, ("seat", "backrest", "recliner")),
)
FIXED = frozenset(
    "base body frame corpus housing case carcass chassis shell panel board wall side back top bottom floor shelf shelves leg "
    "foot feet stand support table plinth fixed static burner hinge screw logo".split()
)
PLACES = frozenset("side back top bottom".split())  # a side of the object by themselves, but "drawer_top" is a drawer
_BY_NAME = {name: word for word in WORDS for name in word.names}
_SIBILANTS = ("ches", "shes", "ses", "xes", "zes")  # their singular lacks "es": "switches"; but not "tapes"
_SPLIT = re.compile(r"[^A-Za-z]+|(?<=[a-z])(?=[A-Z])")


def words_of(name: str) -> list[str]:
    """The words of a free name, lower case, accents and plural endings off: "LeftDoors_02" gives left, door."""
    plain = "".join(c for c in unicodedata.normalize("NFKD", name) if not unicodedata.combining(c))
    return [_singular(w.lower()) for w in _SPLIT.split(plain) if w]


def _singular(word: str) -> str:
    """A word that is known stays ("chassis"); else the singular that is known, else the likely one."""
    if word in _BY_NAME or word in FIXED or len(word) <= 3 or not word.endswith("s"):
        return word
    singulars = [word[:-1]]
    if word.endswith(_SIBILANTS):
        singulars.append(word[:-2])
    if word.endswith("ies"):
        singulars.append(f"{word[:-3]}y")
    likely = word if word.endswith(("ss", "us", "is")) else word[:-1]
    return next((w for w in singulars if w in _BY_NAME or w in FIXED), likely)


def recognize(name: str) -> Word | None:
    """Return the kind of part that a name speaks of; the last telling word counts (a "door handle" is a handle)."""
    return _BY_NAME.get(_telling(name))


def is_fixed_name(name: str) -> bool:
    """Return whether the last telling word names something that does not move."""
    return _telling(name) in FIXED


def _telling(name: str) -> str:
    """Return the last word that names a part, before those that say where it is; "" for none."""
    told = [word for word in words_of(name) if word in _BY_NAME or word in FIXED]
    return next((word for word in reversed(told) if word not in PLACES), told[-1] if told else "")


def typical_motion(label: str) -> TypicalMotion | None:
    """The usual motion of a label, None when it is unknown."""
    word = recognize(label)
    return None if word is None else word.motion
