"""Where a mesh or picture that a robot description names lies."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

PACKAGE = "package://"


def find_file(reference: str, folder: Path) -> Path | None:
    """The file that `reference` names, seen from the description's folder; None where there is none.

    package://NAME/REST is looked for as NAME/REST and as REST in the folder and all above it, as ROS packages lie; a
    backslash counts as a slash.
    """
    reference = reference.replace("\\", "/")
    if reference.startswith(PACKAGE):
        whole = unquote(reference.removeprefix(PACKAGE))
        rest = whole.partition("/")[2]
        above = (folder.resolve(), *folder.resolve().parents)
        tried = [place / name for place in above for name in (whole, rest) if name]
    else:
        plain = unquote(reference.removeprefix("file://")) if reference.startswith("file://") else reference
        tried = [folder / plain]
    return next((path for path in tried if path.is_file()), None)
