"""Names that are legal as a URDF link, a MuJoCo body, a glTF node and a file on every system; and words for confidences."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

LONGEST = 80  # characters; leaves space for suffixes within the 255 bytes of common file systems
# Reserved by a format or a system: MuJoCo's root body, URDF parsers' base names, the device names of Windows.
RESERVED = frozenset({"world", "con", "prn", "aux", "nul"} | {f"{port}{i}" for port in ("com", "lpt") for i in range(10)})

GIVEN, NAMED = "given", "named"  # words with which the reason of a part begins whose label is a name of the file or of a user
SURE, CHECK = 0.8, 0.5  # confidence from which a part or joint is called sure, and from which a person only needs to check it


def confidence_word(confidence: float) -> str:
    """Return sure, check or guess: the one scale of all pages."""
    return "sure" if confidence >= SURE else "check" if confidence >= CHECK else "guess"


def listed(names: Sequence[str], most: int = 20) -> str:
    """Return names for a message: the first `most` of them, and how many more there are."""
    return ", ".join(names[:most]) + (f", and {len(names) - most} more" if len(names) > most else "")


def legal_name(name: str, *, fallback: str = "part") -> str:
    """Convert a name to `[A-Za-z][A-Za-z0-9_]*`, without accents; return `fallback` if nothing legal is left."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    plain = re.sub(r"[^A-Za-z0-9_]+", "_", plain)
    plain = plain.strip("_") if plain != name else plain
    if not plain.strip("_"):
        return fallback
    if not plain[0].isalpha():
        plain = f"{fallback}_{plain.lstrip('_')}"
    plain = plain[:LONGEST]
    # `door` has the files door_collision.obj and door_collision_1.obj, so no link may have such a name.
    if plain.lower() in RESERVED or re.search(r"_collision(_\d+)?$", plain.lower()):
        plain = f"{plain[: LONGEST - 5]}_{fallback}"
    return plain


def legal_names(names: Sequence[str], *, fallback: str = "part") -> list[str]:
    """Return legal names in the same order, unique ignoring case; names that are legal and unique are unchanged."""
    plain = [legal_name(name, fallback=fallback) for name in names]
    taken = {p.lower() for name, p in zip(names, plain, strict=True) if p == name}
    kept: set[str] = set()
    result = []
    for name, candidate in zip(names, plain, strict=True):
        chosen, number = candidate, 1
        while chosen.lower() in kept or (chosen.lower() in taken and chosen != name):
            number += 1
            chosen = f"{candidate}_{number}"
        kept.add(chosen.lower())
        result.append(chosen)
    return result
