"""An object of a collection to annotate: its name, the location of its mesh, and its own options."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Any

from anymesh.errors import InputError

OBJAVERSE = "objaverse:"  # prefix of the source of an object that is fetched by id
READABLE = 60  # characters of a name that are kept in its folder's name
DIGEST = 12  # hex digits that distinguish folders; with 48 bits, two of a million names collide with probability .002
# Options of single objects, and the types of their values in a table.
OPTIONS: dict[str, type] = {
    "parts": str, "up": str, "scale": str, "root": str, "base": str, "formats": str, "drives": str, "category": str,
    "parts_list": str, "at_least": int, "seed": int, "time_limit": float,
}  # fmt: skip


@dataclass(frozen=True)
class ObjectRequest:
    """An object. name: unique in its collection; source: path of the mesh, or `objaverse:UID`; options: its own, of OPTIONS.

    refusal: why it cannot be attempted, "" if it can; size: [bytes] and modified: [ns], to detect changes of the file.
    """

    name: str
    source: str
    options: Mapping[str, Any] = field(default_factory=dict)
    refusal: str = ""
    size: int = 0
    modified: int = 0

    @property
    def folder(self) -> str:
        """Relative folder of the object in the output: readable, legal on every system, and unique by a digest."""
        return object_folder(self.name)

    @property
    def options_text(self) -> str:
        """The options as JSON, identical for equal options."""
        return json.dumps(dict(self.options), sort_keys=True)


def object_folder(name: str) -> str:
    """Return the relative folder of an object's output, in one of 256 folders to limit their sizes."""
    digest = hashlib.sha256(name.encode("utf-8", "surrogateescape")).hexdigest()[:DIGEST]
    readable = re.sub(r"[^A-Za-z0-9_-]+", "_", PurePosixPath(name).stem).strip("_-")[:READABLE] or "object"
    return f"objects/{digest[:2]}/{readable}-{digest}"


def parse_option(name: str, text: str, where: str) -> Any:
    """Parse the value of an option in a table's cell. Raise InputError if it is not valid."""
    try:
        return OPTIONS[name](text)
    except ValueError:
        kind = "an integer" if OPTIONS[name] is int else "a number"
        raise InputError(f"{where}: found {name} {text[:100]!r}; valid is {kind}") from None
