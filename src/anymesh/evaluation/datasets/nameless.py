"""Writing of an object's meshes as one file without hints: one node, no names, meshes not merged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Int

from anymesh.export.glb import glb_bytes
from anymesh.export.links import Link, Primitive, split_links
from anymesh.export.settings import ExportConfig
from anymesh.loading.join import join
from anymesh.types import Asset, Joint, JointType, Material, Mesh, Part, Segmentation
from anymesh.types.asset import Source

Z_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])  # from the file's Y-up to an asset's Z-up


def write_nameless(pieces: Sequence[Mesh], path: Path) -> Int[np.ndarray, " F"]:
    """Write the meshes (Y up) to a GLB; return the mesh index of each face, in the order of the file's faces.

    Faces are sorted by material, as primitives of one node; materials and textures are kept without their names.
    """
    mesh = join([_anonymous(piece) for piece in pieces]).transformed(Z_UP)
    number = np.repeat(np.arange(len(pieces)), [len(p.faces) for p in pieces])
    names = [f"piece{k}" for k in range(len(pieces))]
    zero, up = np.zeros(3), np.array([0.0, 0.0, 1.0])
    fixed = tuple(Joint(n, JointType.FIXED, names[0], n, zero, up, None, 1.0, "fixed") for n in names[1:])
    source = Source("", "", np.eye(4), "z")
    split = Asset("object", source, mesh, Segmentation(number, tuple(Part(n, "part") for n in names)), fixed, "truth")
    part = Part("object", "object")
    whole = replace(split, segmentation=Segmentation(np.zeros_like(number), (part,)), joints=())
    by_material: dict[int, list[Primitive]] = {}
    for link in split_links(split):
        for primitive in link.primitives:
            by_material.setdefault(primitive.material, []).append(primitive)
    textured = [k for k, m in enumerate(mesh.materials) if m.textures]
    primitives = tuple(_merged(by_material[k], k in textured) for k in sorted(by_material))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(glb_bytes(whole, [Link(part, None, zero, np.arange(len(number)), primitives)], ExportConfig()))
    return number[np.lexsort((number, mesh.face_material))]


def _anonymous(mesh: Mesh) -> Mesh:
    return replace(mesh, materials=tuple(_nameless(m) for m in mesh.materials))


def _nameless(m: Material) -> Material:
    return replace(m, name="material", textures={slot: replace(t, name="") for slot, t in m.textures.items()})


def _merged(primitives: list[Primitive], textured: bool) -> Primitive:
    """Merge primitives of one material; their corners stay separate. Texture coordinates are kept only if used."""
    start = np.cumsum([0, *(len(p.positions) for p in primitives)])[:-1]

    def rows(values: list, fill: int) -> np.ndarray | None:
        width = next((v.shape[1] for v in values if v is not None), 0)
        if not width:
            return None
        kind = next(v.dtype for v in values if v is not None)
        pairs = zip(values, primitives, strict=True)
        return np.concatenate([np.full((len(p.positions), width), fill, kind) if v is None else v for v, p in pairs])

    return Primitive(
        primitives[0].material,
        np.concatenate([p.positions for p in primitives]),
        np.concatenate([p.triangles + s for p, s in zip(primitives, start, strict=True)]),
        rows([p.uv for p in primitives], 0) if textured else None,
        rows([p.normals for p in primitives], 0),
        rows([p.colors for p in primitives], 255),
    )
