"""Models for the writers: test assets with a few collision shapes per link, chosen by hand."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
from assets import QUAD_UV, box, checker, joint, mesh_of, source
from PIL import Image
from scipy.spatial import ConvexHull

from anymesh.export.flat_looks import with_materials
from anymesh.export.links import Link, split_links, with_legal_names
from anymesh.export.meshes import write_meshes
from anymesh.export.model import Exclusion, ExportConfig, ExportLink, Model
from anymesh.export.options import Base, Driven, ExportOptions
from anymesh.mechanisms.handles import handle_frames
from anymesh.mechanisms.resisting import resistances
from anymesh.physics.inertia import link_inertia
from anymesh.types import Asset, Box, Cylinder, Hull, Material, Part, Segmentation, Shape, Texture
from anymesh.types.mesh import TEXTURE_SLOTS

CONFIG = ExportConfig()
TURNED = np.array([[2, -2, 1], [1, 2, 2], [-2, -1, 2]]) / 3  # a rotation about no axis of the link


def hull(points: np.ndarray) -> Hull:
    """Return the convex hull of points, with outward faces."""
    found = ConvexHull(points)
    used, faces = np.unique(found.simplices, return_inverse=True)
    faces = faces.reshape(-1, 3)
    vertices = points[used]
    t = vertices[faces]
    inward = np.einsum("ij,ij->i", np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), found.equations[:, :3]) < 0
    return Hull(vertices, np.where(inward[:, None], faces[:, ::-1], faces))


def shapes_of(link: Link, index: int) -> tuple[Shape, ...]:
    """Return one hull for the whole link; the first link has two, the second also a box and a cylinder."""
    corners = link.triangles.reshape(-1, 3)
    whole = hull(corners)
    low, high = corners.min(0), corners.max(0)
    middle = (low + high) / 2
    match index:
        case 0:
            return whole, hull(middle + (corners - middle) * 0.5)
        case 1:
            size = float((high - low).min()) / 4
            turned = Box(middle, TURNED, np.array([1.0, 2.0, 1.5]) * size)
            return turned, whole, Cylinder(middle + 0.01, TURNED.T, size, 3 * size)
        case _:
            return (whole,)


def model_of(
    asset: Asset,
    *,
    base: Base = Base.FIXED,
    exclusions: tuple[Exclusion, ...] = (),
    like: Model | None = None,
    driven: Driven = Driven.POSITION,
) -> Model:
    """Return a model of an asset, with its inertia; its shapes are those of `like` if given."""
    asset = with_legal_names(asset)
    asset = replace(asset, mesh=with_materials(asset.mesh))
    links = split_links(asset)
    shapes = [shapes_of(link, i) for i, link in enumerate(links)] if like is None else [b.shapes for b in like.bodies]
    bodies = tuple(ExportLink(link, link_inertia(link.triangles, CONFIG), s) for link, s in zip(links, shapes, strict=True))
    resisting = resistances(asset, {body.name: body.inertia for body in bodies})
    return Model(
        asset, bodies, resisting, ExportOptions(base, drives=driven), exclusions, handles=handle_frames(asset, resisting)
    )


def with_meshes(model: Model, folder: Path) -> Path:
    """Write the model's meshes, which most formats refer to; return the folder."""
    write_meshes(model, folder, CONFIG)
    return folder


def jpeg() -> bytes:
    """Return a JPEG of two greens."""
    file = io.BytesIO()
    Image.fromarray(np.indices((16, 16)).sum(0).astype(np.uint8)[..., None] * np.uint8([2, 8, 3])).save(file, "JPEG")
    return file.getvalue()


def desk() -> Asset:
    """Return an asset with five levels, odd numbers, shared names, several materials per link, and every texture slot."""
    pieces = [box((0.37 * i, 0.11 * i, 0.05), (0.37 * i + 0.3, 0.11 * i + 0.2, 0.3)) for i in range(6)]
    part_of = np.repeat(np.arange(6), 12)
    face_material = np.array([0, 1, 2, -1, 3, 0])[part_of]
    face_material[:6], face_material[12:15] = 2, 0  # the first two links have two materials
    plain = Texture(checker(), "image/png", "wood.png")
    everything = {slot: Texture(checker(4 + 2 * i), "image/png", f"{slot}.png") for i, slot in enumerate(TEXTURE_SLOTS)}
    materials = (
        Material("wood", (0.9, 0.8, 0.7, 1.0), textures={"base_color": Texture(jpeg(), "image/jpeg", "wood.jpg")}),
        Material("Wood", textures={"base_color": plain}),
        Material("lamp", (0.2, 0.4, 0.6, 0.5), emissive=(1.0, 0.5, 0.0), alpha_mode="BLEND", double_sided=True),
        Material("all of it", (1.0, 1.0, 1.0, 1.0), 0.5, 0.25, (1.0, 1.0, 1.0), alpha_mode="MASK", textures=everything),
    )
    mesh, _ = mesh_of(pieces, face_material, materials=materials, corner_uv=np.tile(QUAD_UV, (len(part_of) // 2, 1, 1)))
    names = ("desk", "cap", "tray", "lid", "stop", "dial")  # children before their parents
    joints = (
        joint("lid", "revolute", "desk", "lid", (1 / 3, 0.1, 0.3), (-1, 0.01, 0), (-0.1, np.pi / 3)),
        joint("tray", "prismatic", "lid", "tray", (2 / 3, 0.217, 0.05), (1e-3, -1, 2e-3), (-0.05, 1 / 3)),
        joint("turn", "continuous", "tray", "dial", (1.11, 0.33, np.pi / 10), (0.6, 0.8, -0.1), None),
        joint("stop_joint", "fixed", "dial", "stop", (1.5, 0.44, 0.05), (0, 0, 1), None),
        joint("push", "prismatic", "stop", "cap", (1.9, 0.6, 0.2), (-1, 0, 0), (-0.01, 0.0)),
    )
    parts = tuple(Part(n, "part") for n in names)
    part_of = np.array([0, 3, 2, 5, 4, 1])[part_of]
    return Asset("desk", source("desk.glb"), mesh, Segmentation(part_of, parts), joints, "geometry")
