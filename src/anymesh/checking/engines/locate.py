"""Where a robot description is, and the files that it refers to."""

from __future__ import annotations

import json
import re
from pathlib import Path
from urllib.parse import unquote

from anymesh.errors import InputError

PACKAGES = re.compile(r"(?:package|model)://|\$\(find ([^)]*)\)/")  # the last in files whose macros were not expanded
URDF, MJCF = ".urdf", ".mjcf"
OPENING = re.compile(rb"<(robot|mujoco)[\s>/]")


def find_file(reference: str, folder: Path) -> Path | None:
    """Return the file that `reference` names, relative to the description's folder; None if there is none.

    package://NAME/REST and model://NAME/REST are searched as NAME/REST and as REST in the folder and all its parents, as in ROS
    packages. Backslashes count as slashes.
    """
    reference = reference.replace("\\", "/")
    named = PACKAGES.match(reference)
    if named is not None:
        whole = unquote((f"{named[1]}/" if named[1] else "") + reference[named.end() :])
        rest = whole.partition("/")[2]
        above = (folder.resolve(), *folder.resolve().parents)
        tried = [place / name for place in above for name in (whole, rest) if name]
    else:
        plain = unquote(reference.removeprefix("file://")) if reference.startswith("file://") else reference
        tried = [folder / plain]
    return next((path for path in tried if path.is_file()), None)


def find_description(path: Path) -> Path:
    """Find the URDF or MJCF at `path`, or in the folder `path`: the one named by asset.json, else the only one.

    A URDF takes precedence over an MJCF. Raise InputError if there is none, or several without an asset.json.
    """
    path = Path(path)
    if path.is_file():
        if kind_of(path) is None:
            raise InputError(f"{path.name} is neither URDF nor MJCF; valid are files with <robot> or <mujoco> at the top")
        return path
    if not path.is_dir():
        raise InputError(f"{path} is not there; valid are a folder of an asset, a URDF or an MJCF")
    named = _named(path)
    if named is not None:
        return named
    files = [p for p in sorted(path.iterdir()) if p.suffix.lower() in (URDF, ".xml", MJCF) and kind_of(p) is not None]
    for kind in (URDF, MJCF):
        some = [p for p in files if kind_of(p) == kind]
        if len(some) == 1:
            return some[0]
        if some:
            raise InputError(f"{path} holds {', '.join(p.name for p in some)}; say which")
    raise InputError(f"{path} holds no URDF and no MJCF; one is needed")


def mjcf_beside(path: Path) -> Path | None:
    """Return the MJCF of the same asset: a URDF says less about mechanisms. None if there is none."""
    if kind_of(path) == MJCF:
        return path
    beside = path.with_suffix(".xml")
    return beside if (path.parent / "asset.json").is_file() and beside.is_file() and kind_of(beside) == MJCF else None


def kind_of(path: Path) -> str | None:
    """Return URDF or MJCF by the content of a file, or None; a file with the suffix .urdf is a URDF, valid or not."""
    if path.suffix.lower() == URDF:
        return URDF
    try:
        match = OPENING.search(path.read_bytes()[:100_000])
    except OSError:
        return None
    if match is None:
        return None
    return URDF if match[1] == b"robot" else MJCF


def _named(folder: Path) -> Path | None:
    try:
        name = json.loads((folder / "asset.json").read_text(encoding="utf-8"))["name"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    urdf = folder / f"{name}{URDF}"
    return urdf if urdf.is_file() else None
