"""Words for parts, and their typical motions. Names are matched by whole words, never by substrings."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from anymesh.types.motion import JointType


@dataclass(frozen=True)
class Word:
    """A kind of part.

    motion: its typical joint, None if only geometry can distinguish a hinge from a slide; names: words that name it.
    """

    label: str
    motion: JointType | None
    names: tuple[str, ...]


WORDS = (
    Word("door", JointType.REVOLUTE, ("door", "tuer", "porte", "puerta", "porta", "hatch", "gate", "shutter")),
    Word(
        "lid",
        JointType.REVOLUTE,
        ("lid", "cover", "hood", "bonnet", "trunk", "tailgate", "cap", "deckel", "screen", "display"),
    ),
    Word("flap", JointType.REVOLUTE, ("flap", "aileron", "elevator", "rudder", "slat", "visor", "tilt", "airbrake", "spoiler")),
    Word(
        "drawer",
        JointType.PRISMATIC,
        ("drawer", "schublade", "tiroir", "cajon", "tray", "rack", "basket", "bin", "crisper"),
    ),
    Word("window", None, ("window", "sash", "pane")),
    Word(
        "slider",
        JointType.PRISMATIC,
        ("slider", "slide", "sliding", "rail", "carriage", "piston", "plunger", "bolt", "magazine"),
    ),
    Word("button", JointType.PRISMATIC, ("button", "key", "keycap", "trigger", "push")),
    Word("knob", JointType.CONTINUOUS, ("knob", "dial", "valve", "tap", "chuck", "control")),
    Word(
        "wheel",
        JointType.CONTINUOUS,
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
    Word("bail", JointType.REVOLUTE, ("bail", "swing")),
    Word("lever", None, ("lever", "switch", "pedal", "arm", "toggle", "latch", "joystick", "stick", "brake")),
    Word("handle", None, ("handle", "grip", "griff", "poignee")),
    Word("seat", None, ("seat", "backrest", "recliner")),
)
FIXED = frozenset(
    "base body frame corpus housing case carcass chassis shell panel board wall side back top bottom floor shelf shelves leg "
    "foot feet stand support table plinth fixed static burner screw logo".split()
)
SMALLER = frozenset("toy model mini miniature dollhouse".split())  # of another size and material than the real object
# a side of the object on their own; otherwise only a position: "drawer_top" is a drawer
PLACES = frozenset("side back top bottom".split())
_BY_NAME = {name: word for word in WORDS for name in word.names}
_SIBILANTS = ("ches", "shes", "ses", "xes", "zes")  # the singular of these lacks "es": "switches"; but not "tapes"
CAD_BODY = re.compile(r"Body\d+(?:[\W_]\d+)?")
_SPLIT = re.compile(r"[^A-Za-z]+|(?<=[a-z])(?=[A-Z])")


_UMLAUTS = str.maketrans({c: f"{unicodedata.normalize('NFD', c)[0]}e" for c in "äöüÄÖÜ"} | {"ß": "ss"})


def words_of(name: str) -> list[str]:
    """Return the words of a name, in lower case and without accents and plural endings.

    "LeftDoors_02" gives left, door.
    """
    german = unicodedata.normalize("NFC", name).translate(_UMLAUTS)
    plain = "".join(c for c in unicodedata.normalize("NFKD", german) if not unicodedata.combining(c))
    return [_singular(w.lower()) for w in _SPLIT.split(plain) if w]


def _singular(word: str) -> str:
    """Return a known word unchanged ("chassis"); else its known singular, else the likely one."""
    if word in _BY_NAME or word in FIXED or len(word) <= 3 or not word.endswith("s"):
        return word
    singulars = [word[:-1]]
    if word.endswith(_SIBILANTS):
        singulars.append(word[:-2])
    if word.endswith("ies"):
        singulars.append(f"{word[:-3]}y")
    likely = word if word.endswith(("ss", "us", "is")) else word[:-1]
    return next((w for w in singulars if w in _BY_NAME or w in FIXED), likely)


def named_plurals(name: str) -> set[str]:
    """Return the names of parts whose plural is in a name, as in that of a group of objects ("3Drawers" gives drawer)."""
    words = [w.lower() for w in _SPLIT.split(name) if w]
    return {_singular(w) for w in words if w not in _BY_NAME} & _BY_NAME.keys()


def recognize(name: str) -> Word | None:
    """Return the kind of part that a name means; the last recognized word counts (a "door handle" is a handle)."""
    return _BY_NAME.get(_part_word(name))


def is_fixed_name(name: str) -> bool:
    """Return whether the last recognized word names something that does not move; CAD programs call any solid Body1, Body2."""
    return _part_word(name) in FIXED and CAD_BODY.fullmatch(name) is None


def _part_word(name: str) -> str:
    """Return the last word that names a part, ignoring positions if possible; "" for none."""
    known = [word for word in words_of(name) if word in _BY_NAME or word in FIXED]
    if "sliding" in known and _BY_NAME.get(known[-1], _BY_NAME["sliding"]).motion is JointType.REVOLUTE:
        return "sliding"  # a sliding door turns about nothing
    return next((word for word in reversed(known) if word not in PLACES), known[-1] if known else "")


def typical_motion(label: str) -> JointType | None:
    """Return the typical joint of a label, None if the label is unknown or has no typical one."""
    word = recognize(label)
    return None if word is None else word.motion
