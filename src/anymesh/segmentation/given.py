"""Parts that are given: the scene's nodes, or a file of face labels (the paper's tables take parts as given)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from anymesh.errors import InputError, OptionError
from anymesh.names import legal_names
from anymesh.reasoning.vocabulary import recognize
from anymesh.types import Mesh, Part, Segmentation

GIVEN = "given"


def parts_from_nodes(mesh: Mesh) -> Segmentation:
    """The scene's nodes are the parts; the root is the node named "base", else the one with the largest box."""
    present = np.unique(mesh.face_node)
    names = [mesh.nodes[n].name for n in present]
    return _segmentation(mesh, np.searchsorted(present, mesh.face_node), names)


def parts_from_file(mesh: Mesh, path: Path) -> Segmentation:
    """Face labels in the file's face order: a .npy of F integers, or .json with a list, or {"names": [...], "faces": [...]}.

    Raises OptionError when the file cannot be read as labels of this mesh.
    """
    names: list[str] | None = None
    if not path.is_file():
        raise OptionError(f"--parts: found no file {path}; valid are auto, nodes, or a .npy or .json file of face labels")
    try:
        match path.suffix.lower():
            case ".npy":
                labels = np.load(path, allow_pickle=False)
            case ".json":
                data = json.loads(path.read_text(encoding="utf-8"))
                names = data.get("names") if isinstance(data, dict) else None
                labels = np.asarray(data["faces"] if isinstance(data, dict) else data)
            case other:
                raise OptionError(f"--parts: found a {other or 'nameless'} file; valid are .npy and .json")
    except (ValueError, KeyError, OSError, TypeError) as error:
        raise OptionError(f"--parts: {path.name} cannot be read as face labels ({type(error).__name__})") from None
    if labels.shape != (len(mesh.faces),) or not np.issubdtype(labels.dtype, np.integer):
        raise OptionError(
            f"--parts: found labels of shape {labels.shape} and type {labels.dtype} in {path.name}; "
            f"valid is one integer for each of the mesh's {len(mesh.faces)} faces"
        )
    present, index = np.unique(labels, return_inverse=True)
    if names is not None and (not isinstance(names, list) or present.min() < 0 or present.max() >= len(names)):
        raise OptionError(f"--parts: names in {path.name} do not cover the labels {present.min()}..{present.max()}")
    found = [str(names[k]) if names is not None else ("base" if k == 0 else f"part_{k}") for k in present]
    return _segmentation(mesh, index.reshape(-1), found)


def _segmentation(mesh: Mesh, label: np.ndarray, names: list[str]) -> Segmentation:
    """Renumbers so that the root is part 0."""
    if len(names) == 0:
        raise InputError("the mesh has no nodes with faces")
    root = next((k for k, name in enumerate(names) if name.lower() == "base"), None)
    if root is None:
        size = [float(np.linalg.norm(np.ptp(mesh.triangles[label == k].reshape(-1, 3), axis=0))) for k in range(len(names))]
        root = int(np.argmax(size))
    order = [root, *(k for k in range(len(names)) if k != root)]
    number = np.empty(len(order), np.int64)
    number[order] = np.arange(len(order))
    legal = legal_names([names[k] for k in order])
    parts = []
    for k, name in zip(order, legal, strict=True):
        word = recognize(names[k])
        parts.append(Part(name, "base" if k == root else word.label if word else "part", 1.0, GIVEN))
    return Segmentation(number[label], tuple(parts))
