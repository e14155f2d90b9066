"""STEP by cascadio (OpenCASCADE): the surfaces of its solids as triangles, each product a node with its name and colour."""

from __future__ import annotations

import json
import struct
from dataclasses import replace
from pathlib import Path
from typing import Any

from anymesh.errors import InputError, MissingExtraError
from anymesh.formats.advice import needs_extra
from anymesh.formats.gltf.buffers import parse_json, split_glb
from anymesh.formats.gltf.scene import read_gltf
from anymesh.loading.files import FileMesh, Folder

DEFLECTION_MM = 0.1  # [mm] how far triangles may be off the surface
TURN_RAD = 0.3  # [rad] between two neighbours


def read_step(folder: Folder, work: Path) -> FileMesh:
    """Return the products of the file at their places [m]. work: not used.

    Raise InputError if it is not valid, MissingExtraError without cascadio.
    """
    try:
        import cascadio
    except ImportError as error:
        raise MissingExtraError(needs_extra("cascadio")) from error
    name = folder.path.name
    data = folder.path.read_bytes()
    glb = cascadio.load(data, file_type="step", tol_linear=DEFLECTION_MM, tol_angular=TURN_RAD, use_parallel=False)
    if not glb:
        raise InputError(f"{name} is not a valid STEP file, it is broken, truncated, or has no solid or surface")
    mesh = read_gltf(_named(name, glb), folder)  # origins of products are those of their sketches
    return FileMesh(replace(mesh, nodes=tuple(replace(node, pivot=None) for node in mesh.nodes)), None, 1.0)


def _named(name: str, glb: bytes) -> bytes:
    """Return the GLB with nodes named after their products instead of the numbers of their uses, and not metallic."""
    text, binary = split_glb(name, glb)
    tree: dict[str, Any] = parse_json(name, text)
    for material in tree.get("materials", []):  # whose colours are all that the file states
        material["pbrMetallicRoughness"] = {"metallicFactor": 0.0, "roughnessFactor": 0.6} | material.get(
            "pbrMetallicRoughness", {}
        )
    for node in tree.get("nodes", []):
        if "mesh" in node and (product := tree["meshes"][node["mesh"]].get("name")):
            node["name"] = product
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text
    if binary is not None:
        binary += b"\0" * (-len(binary) % 4)
        body += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body
