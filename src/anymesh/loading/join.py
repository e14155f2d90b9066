"""Steps common to the readers of all formats: conversion of colours to bytes, and joining of meshes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from jaxtyping import Float, Float32, Int, UInt8

from anymesh.errors import InputError
from anymesh.types import Material, Mesh, Node, StatedJoint


def check_geometry(name: str, vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], first: int = 0) -> None:
    """Raise InputError if there is no triangle, an index without a vertex, or a corner that is not finite.

    first: number of the first vertex in the file.
    """
    if not len(faces):
        raise InputError(f"{name}: found no triangle, only {len(vertices)} points; at least one triangle is needed")
    if faces.min() < 0 or faces.max() >= len(vertices):
        index = int(faces.min() if faces.min() < 0 else faces.max())
        raise InputError(f"{name}: a face refers to vertex {index + first}; valid are {first} to {len(vertices) - 1 + first}")
    if not np.isfinite(vertices).all() and not np.isfinite(vertices[faces]).all():
        raise InputError(f"{name}: found a vertex that is not finite (NaN or infinite); valid are finite coordinates")


def simple_mesh(
    name: str,
    label: str,
    vertices: np.ndarray,
    faces: np.ndarray,
    material: Material | None = None,
    **corners: Any,
) -> Mesh:
    """Return a checked mesh of one node and at most one material, with corner_uv, corner_color and corner_normal."""
    vertices = np.array(vertices, np.float64)
    faces = np.asarray(faces, np.int64).reshape(-1, 3)
    check_geometry(name, vertices, faces)
    vertices[~np.isfinite(vertices)] = 0.0  # vertices of no face
    return Mesh(
        vertices,
        faces,
        np.zeros(len(faces), np.int64),
        (Node(label, label),),
        np.full(len(faces), -1 if material is None else 0, np.int64),
        () if material is None else (material,),
        **corners,
    )


def rgba(values: np.ndarray) -> UInt8[np.ndarray, "n 4"]:
    """Return colours of 3 or 4 channels as bytes: floats are 0..1, integers use the range of their type."""
    values = np.asarray(values)
    if values.dtype.kind == "f":
        values = np.nan_to_num(values, nan=1.0) * 255
    elif values.dtype.itemsize == 2:
        values = values / 257
    values = np.clip(np.rint(values), 0, 255).astype(np.uint8)
    return values if values.shape[1] == 4 else np.c_[values[:, :3], np.full(len(values), 255, np.uint8)]


def unit(normals: np.ndarray) -> Float32[np.ndarray, "*n 3"] | None:
    """Return normals of length 1, zero where there is none or it is not finite; None if all are so."""
    normals = np.asarray(normals, np.float64)
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    normals, length = np.where(np.isfinite(length), normals, 0.0), np.where(np.isfinite(length), length, 0.0)
    if not (length > 0).any():
        return None
    return np.divide(normals, length, out=np.zeros_like(normals), where=length > 0).astype(np.float32)


def unique_names(names: Iterable[str]) -> list[str]:
    """Return the names, with repeated names numbered."""
    taken: set[str] = set()
    count: dict[str, int] = {}
    unique = []
    for name in names:
        new = name
        while new in taken:
            count[name] = count.get(name, 0) + 1
            new = f"{name}_{count[name]}"
        taken.add(new)
        unique.append(new)
    return unique


def join(meshes: list[Mesh]) -> Mesh:
    """Join meshes in their order; node names become unique, equal materials become one."""
    materials: list[Material] = []
    known: dict[int, int] = {}  # by identity first, since comparing pictures takes time
    face_material = []
    for mesh in meshes:
        for material in mesh.materials:
            if id(material) not in known:
                if material not in materials:
                    materials.append(material)
                known[id(material)] = materials.index(material)
        number = np.array([*(known[id(m)] for m in mesh.materials), -1], np.int64)
        face_material.append(number[mesh.face_material])
    nodes, joints = list[Node](), list[StatedJoint]()
    for mesh in meshes:
        first = len(joints)
        nodes += [replace(n, joint=n.joint + first if n.joint >= 0 else -1) for n in mesh.nodes]
        joints += [replace(j, parent=_later(j.parent, first), follows=_later(j.follows, first)) for j in mesh.joints]
    names = unique_names(node.name for node in nodes)
    vertices, count = _offsets(len(m.vertices) for m in meshes), _offsets(len(m.nodes) for m in meshes)
    return Mesh(
        np.concatenate([m.vertices for m in meshes]),
        np.concatenate([m.faces + o for m, o in zip(meshes, vertices, strict=True)]),
        np.concatenate([m.face_node + o for m, o in zip(meshes, count, strict=True)]),
        tuple(replace(node, name=name) for node, name in zip(nodes, names, strict=True)),
        np.concatenate(face_material),
        tuple(materials),
        _corners([m.corner_uv for m in meshes], meshes, 2, np.float32, 0),
        _corners([m.corner_color for m in meshes], meshes, 4, np.uint8, 255),
        _normals(meshes),
        tuple(joints),
        _corners([m.corner_more_uv for m in meshes], meshes, 0, np.float32, 0),
    )


def _offsets(lengths: Iterable[int]) -> np.ndarray:
    return np.cumsum([0, *lengths])[:-1]


def _corners(values: list, meshes: list[Mesh], width: int, dtype: type, fill: int) -> np.ndarray | None:
    if all(v is None for v in values):
        return None
    width = max(width, *(v.shape[2] for v in values if v is not None), 0)
    padded = [np.full((len(m.faces), 3, width), fill, dtype) for m in meshes]
    for rows, v in zip(padded, values, strict=True):
        if v is not None:
            rows[..., : v.shape[2]] = v
    return np.concatenate(padded)


def _normals(meshes: list[Mesh]) -> np.ndarray | None:
    """Return corner normals; if only some meshes have normals, the others get those of their faces."""
    if all(m.corner_normal is None for m in meshes):
        return None
    flat = [np.repeat(m.face_normals[:, None], 3, 1) if m.corner_normal is None else m.corner_normal for m in meshes]
    return np.concatenate(flat).astype(np.float32)


def _later(number: int | None, first: int) -> int | None:
    return None if number is None else number + first
