"""Name the parts of labelled faces: those found, the scene's nodes, or a file of labels (as in the paper's tables)."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import InputError, OptionError
from anymesh.loading.scene_graph import materials_of_nodes
from anymesh.names import GIVEN, legal_names, listed
from anymesh.types import Mesh, Part, Segmentation
from anymesh.vocabulary import is_fixed_name, recognize

SHOWN = 10  # names of the file in the reason of a part
NPY, ZIP = b"\x93NUMPY", b"PK"  # first bytes of a file of the format


def named_parts(
    face_part: Int[np.ndarray, " F"],
    labels: Sequence[str],
    areas: Float[np.ndarray, " F"],
    confidence: Sequence[float],
    reason: Sequence[str],
) -> Segmentation:
    """Return the parts as links with unique, legal names, the largest first.

    Entry k - 1 of labels, confidence and reason belongs to part k. Parts without faces are left out. If no face is left for the
    base, the largest part becomes the base.
    """
    count = len(labels) + 1
    size = np.bincount(face_part, areas, count)
    size[np.setdiff1d(np.arange(count), face_part)] = -1
    if size[0] < 0:
        face_part = np.where(face_part == int(size.argmax()), 0, face_part)
        size[size.argmax()], size[0] = -1, 0
    present = [int(k) for k in np.argsort(-size[1:], kind="stable") + 1 if size[k] >= 0]
    renumber = np.zeros(count, np.int64)
    renumber[present] = np.arange(1, len(present) + 1)
    own = [labels[k - 1] for k in present]
    names = legal_names(["base", *(n if own.count(n) == 1 else f"{n}_{own[: i + 1].count(n)}" for i, n in enumerate(own))])
    parts = [Part("base", "base", 1.0, "everything that is not a movable part")]
    parts += [Part(name, labels[k - 1], confidence[k - 1], reason[k - 1]) for name, k in zip(names[1:], present, strict=True)]
    return Segmentation(renumber[face_part], tuple(parts))


def parts_from_nodes(mesh: Mesh) -> Segmentation:
    """Return the scene's nodes as parts; the root is the node named "base", else the one with the largest box."""
    present, number = np.unique(mesh.face_node, return_inverse=True)
    objects = _without_materials(mesh, [int(n) for n in present])
    names = list(dict.fromkeys(objects))
    return _segmentation(mesh, np.array([names.index(name) for name in objects])[number.reshape(-1)], names)


def _without_materials(mesh: Mesh, present: Sequence[int]) -> list[str]:
    """Return the names of nodes, without the material's where an object is one node per material (`door_oak`, `door_steel`)."""
    names, stems = [mesh.nodes[n].name for n in present], list[str]()
    for used, name in zip(materials_of_nodes(mesh), names, strict=True):
        material = mesh.materials[used[0]].name if len(used) == 1 and used[0] >= 0 else ""
        part_word = recognize(material) is not None or is_fixed_name(material)
        end = re.search(rf"[\W_]+{re.escape(material)}(?:_\d+)?$", name, re.IGNORECASE) if material and not part_word else None
        stems.append(name[: end.start()] if end else "")
    return [stem if stem and stems.count(stem) > 1 else name for stem, name in zip(stems, names, strict=True)]


def with_names_of_file(mesh: Mesh, segmentation: Segmentation) -> Segmentation:
    """Return the parts with names of the file among their reasons, where these are in scripts that no link can have."""
    named: dict[int, list[str]] = {}
    for n, node in enumerate(mesh.nodes):
        faces = mesh.face_node == n if not node.name.isascii() else np.zeros(0, bool)
        if faces.any():
            named.setdefault(int(np.bincount(segmentation.face_part[faces]).argmax()), []).append(node.name)
    parts = []
    for k, part in enumerate(segmentation.parts):
        texts = [f'"{name}"' for name in named.get(k, [])]
        parts.append(replace(part, reason=f"{part.reason}; in the file: {listed(texts, SHOWN)}") if texts else part)
    return replace(segmentation, parts=tuple(parts)) if named else segmentation


def whole_as_base(mesh: Mesh) -> Segmentation:
    """Return the whole mesh as the base, for objects that do not move."""
    return Segmentation(np.zeros(len(mesh.faces), np.int64), (Part("base", "base", 1.0, GIVEN),))


def parts_from_file(mesh: Mesh, path: Path) -> Segmentation:
    """Read face labels in the file's face order.

    The file is a .npy array of F integers, or a .json file with a list or {"names": [...], "faces": [...]}.
    Raise OptionError if the file cannot be read as labels of this mesh.
    """
    labels, names = _read(path)
    if labels.shape != (len(mesh.faces),) or not np.issubdtype(labels.dtype, np.integer):
        raise OptionError(
            f"--parts: found labels of shape {labels.shape} and type {labels.dtype} in {path.name}; "
            f"valid is one integer for each of the mesh's {len(mesh.faces)} faces"
        )
    present, index = np.unique(labels, return_inverse=True)
    if present.min() < 0:
        raise OptionError(f"--parts: found the label {present.min()} in {path.name}; valid are integers from 0 up")
    if names is not None and (not isinstance(names, list) or present.max() >= len(names)):
        raise OptionError(f"--parts: names in {path.name} do not cover the labels {present.min()}..{present.max()}")
    part_names = [str(names[k]) if names is not None else ("base" if k == 0 else f"part_{k}") for k in present]
    return _segmentation(mesh, index.reshape(-1), part_names)


def _read(path: Path) -> tuple[np.ndarray, Any]:
    """Return the labels in a file, unchecked, and the names if it has any. Raise OptionError if the file cannot be read."""
    try:
        data = path.read_bytes() if path.is_file() else None
    except OSError as error:
        raise OptionError(f"--parts: {path.name} cannot be opened: {error.strerror}") from None
    if data is None:
        raise OptionError(f"--parts: found no file {path}; valid are auto, nodes, none, or a .npy or .json file of face labels")
    suffix = path.suffix.lower()
    if suffix not in (".npy", ".json"):
        raise OptionError(f"--parts: found a {suffix or 'nameless'} file; valid are .npy and .json")
    return (_npy(path.name, data), None) if suffix == ".npy" else _json(path.name, data)


def _npy(name: str, data: bytes) -> np.ndarray:
    content = "a broken array, or one of objects"
    if not data.startswith(NPY):
        content = "a ZIP archive (an .npz?)" if data.startswith(ZIP) else "another format" if data else "an empty file"
    try:
        return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except Exception:  # a broken header raises errors of many types, including those of the tokenizer
        raise OptionError(f"--parts: found {content} in {name}; valid is one .npy array of integers") from None


def _json(name: str, data: bytes) -> tuple[np.ndarray, Any]:
    valid = 'valid is a list of integers, or {"names": [...], "faces": [...]}'
    try:
        record = json.loads(data)  # from bytes, for any Unicode encoding, with or without a byte order mark
    except RecursionError:
        raise OptionError(f"--parts: found lists nested too deep in {name}; {valid}") from None
    except ValueError as error:
        raise OptionError(f"--parts: found {'no JSON' if data else 'an empty file'} in {name} ({error}); {valid}") from None
    names = record.get("names") if isinstance(record, dict) else None
    if isinstance(record, dict) and "faces" not in record:
        raise OptionError(f'--parts: found no "faces" in {name}; {valid}')
    try:
        return np.asarray(record["faces"] if isinstance(record, dict) else record), names
    except (ValueError, OverflowError, RecursionError):
        raise OptionError(f"--parts: found lists of unequal length or depth in {name}; {valid}") from None


def _segmentation(mesh: Mesh, label: np.ndarray, names: list[str]) -> Segmentation:
    """Renumber the parts so that the root is part 0."""
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
