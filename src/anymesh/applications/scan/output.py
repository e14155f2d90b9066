"""Output files of a scan: a GLB with vertex colours and a report, both written completely or not at all."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.applications.scan.cleaning_ import Hole
from anymesh.errors import OutputError
from anymesh.export.glb import INDICES, VERTICES, GlbBuffer
from anymesh.types.mesh import to_linear

TO_GLTF = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # z up to y up


@dataclass(frozen=True)
class ScanReport:
    """Inputs and results of a scan; lengths in metres.

    T_scan_world: rows of the transform from the recording's world to the scan's frame (z up, floor at 0; the GLB has y up, as
    its format requires); disagreement: median over frames, share of the depth; holes: large ones, closed if flat, the largest
    first; open_share: area of the open ones over the surface's; closed_holes: number of small ones, all closed.
    """

    mesh: str
    layout: str
    frames: int
    dropped: tuple[str, ...]
    warnings: tuple[str, ...]
    method: str
    voxel: float
    truncation: float
    pixel: float
    noise: float
    disagreement: float
    floor: str
    T_scan_world: tuple[tuple[float, ...], ...]
    extents: tuple[float, float, float]
    faces: int
    fused_faces: int
    bits_removed: int
    closed_holes: int
    holes: tuple[Hole, ...]
    open_share: float


def report_path(out: Path) -> Path:
    """Return the path of a scan's report, beside its mesh."""
    return out.with_name(f"{out.stem}.scan.json")


def check_output(out: Path, force: bool) -> None:
    """Raise OutputError unless the files may be written."""
    if out.suffix.lower() != ".glb":
        raise OutputError(f"{out}: a scan is written as .glb, found {out.suffix or 'no suffix'!r}")
    if out.is_dir():
        raise OutputError(f"{out} is a folder; the name of a .glb file is expected")
    there = [p for p in (out, report_path(out)) if p.exists()]
    if there and not force:
        raise OutputError(f"{there[0]} exists; --force replaces it")


def write_scan(
    out: Path, vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], colors: UInt8[np.ndarray, "V 3"],
    report: ScanReport,
) -> None:  # fmt: skip
    """Write the GLB and its report. Raise OutputError if the folder cannot be written; then nothing is changed."""
    parts = {report_path(out): json.dumps(asdict(report), indent=1).encode(), out: glb_bytes(vertices, faces, colors)}
    temporary = {path: path.with_name(f".{path.name}.partial") for path in parts}
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        for path, data in parts.items():
            temporary[path].write_bytes(data)
        for path in parts:
            temporary[path].replace(path)
    except OSError as error:
        raise OutputError(f"{out} cannot be written: {error.strerror or error}") from None
    finally:
        for path in temporary.values():
            path.unlink(missing_ok=True)


def glb_bytes(vertices: np.ndarray, faces: np.ndarray, colors: np.ndarray) -> bytes:
    """Return a GLB of one mesh, y up, with linear 16-bit vertex colours."""
    buffer = GlbBuffer()
    color = np.c_[np.rint(to_linear(colors / 255) * 65535), np.full(len(colors), 65535)].astype(np.uint16)
    attributes = {
        "POSITION": buffer.accessor((vertices @ TO_GLTF.T).astype(np.float32), target=VERTICES, bounds=True),
        "COLOR_0": buffer.accessor(color, target=VERTICES, normalized=True),
    }
    indices = buffer.accessor(faces.reshape(-1).astype(np.uint32), target=INDICES)
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "articulate-anymesh scan"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "scan", "mesh": 0}],
        "meshes": [{"name": "scan", "primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
        "materials": [{"name": "scanned", "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.9}}],
    }
    return buffer.encode(document)
