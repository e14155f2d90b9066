"""Reading of an asset from its folder: asset.json, the GLB, the transcript. Saved stages are not needed."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.export import Format
from anymesh.export.formats import main_file
from anymesh.loading import load_mesh
from anymesh.types import Asset, Exchange, Joint, JointType, Mesh, Part, Picture, Segmentation, Source

RECORD = "asset.json"
TRANSCRIPT = "transcript"
ASKED = re.compile(r"\d{3,}_[a-z0-9-]+\.json")
DRAWN = re.compile(r"[0-9a-f]{64}\.png")
WORDS = ("kind", "key", "model", "text", "answer", "verdict")
FROM_Y_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])  # glTF has Y up, an asset Z


def find_assets(folder: Path) -> list[Path]:
    """Return the folder itself if it is an asset's, else all asset folders below it, in order of their paths.

    Hidden folders are skipped. Raise InputError if there is none.
    """
    if (folder / RECORD).is_file():
        return [folder]
    folders = sorted({path.parent for path in folder.glob(f"**/{RECORD}") if path.is_file()})
    shown = [path for path in folders if not any(part.startswith(".") for part in path.relative_to(folder).parts)]
    if not shown:
        raise InputError(f"{folder} holds no {RECORD}; valid is a folder that `anymesh articulate` made, or a folder of such")
    return shown


def glb_path(folder: Path) -> Path:
    """Return the path of an asset's GLB. Raise InputError if it has none."""
    named = main_file(Format.GLB, str(_record(folder).get("name")))
    if Path(named).name != named or not (folder / named).is_file():
        raise InputError(f"{folder} has no GLB; `anymesh export {folder} --formats glb` writes one")
    return folder / named


def read_asset(folder: Path) -> Asset:
    """Read the asset of a folder. Raise InputError if it is not an asset, or if asset.json and the GLB do not match."""
    record = _record(folder)
    mesh = load_mesh(glb_path(folder)).mesh.transformed(FROM_Y_UP)
    try:
        parts = tuple(Part(p["name"], p["label"], p["confidence"], p["reason"]) for p in record["parts"])
        source = record["source"]
        return Asset(
            name=record["name"],
            source=Source(
                source["path"],
                source["sha256"],
                np.array(source["T_asset_source"], float),
                source["up"],
                tuple(source["notes"]),
            ),
            mesh=mesh,
            segmentation=Segmentation(_face_part(mesh, parts), parts),
            joints=tuple(_joint(joint) for joint in record["joints"]),
            answerer=record["answerer"],
            warnings=tuple(map(str, record["warnings"])),
            exchanges=read_transcript(folder / TRANSCRIPT),
            notes=tuple(map(str, record.get("finish", ()))),  # since schema 1.2
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(f"{folder / RECORD} is not what anymesh writes: {type(error).__name__}: {error}") from error


def read_transcript(folder: Path) -> tuple[Exchange, ...]:
    """Read the questions and answers of a transcript, in order; unreadable ones are left out."""
    if not folder.is_dir():
        return ()
    exchanges = (_exchange(folder, path) for path in sorted(folder.iterdir()) if ASKED.fullmatch(path.name))
    return tuple(exchange for exchange in exchanges if exchange is not None)


def _record(folder: Path) -> Mapping[str, Any]:
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{folder / RECORD} cannot be read: {error}") from error
    if not isinstance(record, dict):
        raise InputError(f"{folder / RECORD} is not what anymesh writes: found a {type(record).__name__}")
    return record


def _face_part(mesh: Mesh, parts: Sequence[Part]) -> np.ndarray:
    """Return the part of each face; each link is a node with its name."""
    number = {part.name: k for k, part in enumerate(parts)}
    unknown = [node.name for node in mesh.nodes if node.name not in number]
    if unknown:
        raise ValueError(f"the GLB has nodes {unknown[:5]} that are not parts; parts are {list(number)[:20]}")
    return np.array([number[node.name] for node in mesh.nodes])[mesh.face_node]


def _joint(record: Mapping[str, Any]) -> Joint:
    axis = np.array(record["axis"], float)
    limits = record["limits"]
    made = Joint(
        name=record["name"],
        type=JointType(record["type"]),
        parent=record["parent"],
        child=record["child"],
        origin=np.array(record["origin"], float),
        axis=axis / np.linalg.norm(axis),
        limits=None if limits is None else (float(limits[0]), float(limits[1])),
        confidence=record["confidence"],
        reason=record["reason"],
    )
    return replace(made, **{key: float(record[key]) for key in ("effort", "velocity", "damping", "friction")})


def _exchange(folder: Path, path: Path) -> Exchange | None:
    try:
        record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if not all(isinstance(record[word], str) for word in WORDS):
            return None
        record["pictures"] = tuple(
            Picture((folder / drawn["file"]).read_bytes(), str(drawn["caption"]))
            for drawn in record["pictures"]
            if DRAWN.fullmatch(drawn["file"]) and (folder / drawn["file"]).is_file()
        )
        return Exchange(**record)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
