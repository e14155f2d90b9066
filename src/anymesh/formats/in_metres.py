"""Meshes that robot descriptions refer to, as engines and viewers read them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.files import Folder, check_file
from anymesh.loading.load import read_framed
from anymesh.types import Mesh


def read_in_metres(path: Path, root: Path | None) -> tuple[Mesh, tuple[str, ...]]:
    """Return the mesh as engines and viewers of robots read it, without joints and pivots, and the reader's warnings.

    The unit of COLLADA is applied, but its up axis is not (see docs/check.md); other formats are read without conversion.
    root: as of `load_mesh`. Raise InputError.
    """
    data, folder, suffix = check_file(path), Folder(path, root, joints=False), path.suffix.lower()
    try:
        framed = read_framed(suffix, data, folder)
    except InputError:
        raise
    except Exception as error:  # readers raise many types of errors for broken files
        cause = " ".join(f"{type(error).__name__}: {error}".split())[:150]
        raise InputError(f"{path.name} is broken or truncated ({cause})") from None
    scale = np.diag([framed.unit or 1.0] * 3 + [1.0])
    return (framed.mesh if framed.unit in (None, 1.0) else framed.mesh.transformed(scale)), tuple(folder.warnings)
