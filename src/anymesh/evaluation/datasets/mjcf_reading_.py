"""Compilation of MJCF files by MuJoCo, including those that only robosuite reads."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

from anymesh.errors import InputError
from anymesh.mujoco_ import load_mujoco

mujoco = load_mujoco()

UNKNOWN = re.compile(r"unrecognized element\s+Element '([^']+)'")


def compile_mjcf(path: Path) -> Any:
    """Return the model, with one body for each body of the file. Raise InputError if MuJoCo rejects it."""
    try:
        spec = _read(path)
        spec.compiler.fusestatic = False
        spec.compiler.boundmass = spec.compiler.boundinertia = 1.0  # irrelevant here, and bodies may lack it
        for mesh in spec.meshes:
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # flat visuals have no volume
        return spec.compile()
    except (ValueError, mujoco.FatalError, ET.ParseError, OSError) as error:
        raise InputError(f"{path.name}: MuJoCo cannot use it ({' '.join(str(error).split())[:200]})") from None


def _read(path: Path) -> Any:
    try:
        return mujoco.MjSpec.from_file(str(path))
    except ValueError as error:
        if "repeated name" not in str(error) and not UNKNOWN.search(str(error)):
            raise
    root = ET.fromstring(path.read_text(encoding="utf-8"))
    _drop_repeated(root)
    for _ in range(9):
        try:
            spec = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
        except ValueError as error:
            unknown = UNKNOWN.search(str(error))
            if unknown is None:
                raise
            for parent in list(root.iter()):
                for child in parent.findall(unknown[1]):
                    parent.remove(child)
        else:
            spec.modelfiledir = str(path.parent)
            return spec
    raise ValueError("too many elements that MuJoCo does not know")


def _drop_repeated(root: ET.Element) -> None:
    """Remove assets that repeat the type and name of an earlier one."""
    known = set()
    for assets in root.iter("asset"):
        for asset in list(assets):
            key = (asset.tag, asset.get("name"))
            if key[1] is not None and key in known:
                assets.remove(asset)
            known.add(key)
