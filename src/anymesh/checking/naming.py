"""Check "naming": names are preserved by every format and engine."""

from __future__ import annotations

import re
from collections.abc import Iterator

from anymesh.checking.engines.robot import Robot
from anymesh.checking.report import Finding, warning
from anymesh.names import legal_name

CHECK = "naming"
LEGAL_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")


def check_naming(robot: Robot) -> Iterator[Finding]:
    """Check that names have only letters, digits, underscore, point and hyphen, and differ by more than case."""
    for word, names in (("link", [b.name for b in robot.links]), ("joint", [j.name for j in robot.joints])):
        for name in names:
            if name and not LEGAL_NAME.fullmatch(name):
                legal = legal_name(name, fallback=word)
                yield warning(CHECK, name, f"the name of this {word} is changed or refused by some engines; {legal} is valid")
        seen: dict[str, str] = {}
        for name in names:
            other = seen.setdefault(name.lower(), name)
            if other != name:
                problem = f"differs from the {word} {other!r} only in case; their files would overwrite each other"
                yield warning(CHECK, name, problem)
