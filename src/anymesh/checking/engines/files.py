"""Location of meshes and textures named by robot descriptions."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

PACKAGE = "package://"


def find_file(reference: str, folder: Path) -> Path | None:
    """Return the file that `reference` names, relative to the description's folder; None if there is none.

    package://NAME/REST is searched as NAME/REST and as REST in the folder and all its parents, as in ROS packages. Backslashes
    count as slashes.
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
