"""Reduction of an asset for display on pages with many: fewer faces and smaller textures, with notes."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float
from PIL import Image

from anymesh.export.glb import glb_bytes
from anymesh.export.links import split_links
from anymesh.export.model import ExportConfig
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.simplify_ import simplify
from anymesh.rendering.render import face_colors
from anymesh.types import Asset, Material, Mesh, Segmentation, Texture
from anymesh.types.triangles import normals_and_areas

FACES = 60_000  # number of faces above which an asset is decimated: about a megabyte of the page
PIXELS = 1024  # longest side of a texture
COARSE = 4  # multiple of the wanted faces that the clustering keeps for the exact decimation
FINEST = 1e-5  # minimum cell size of the clustering, as a share of the part's longest side, to limit the number of cells
MIN_PART_FACES = 200  # minimum number of faces of a part
FORMATS = {"image/png": "PNG", "image/jpeg": "JPEG"}
COATED = Material("display", (1.0, 1.0, 1.0, 1.0), double_sided=True)  # used with vertex colours


def displayed(asset: Asset, *, faces: int = FACES, pixels: int = PIXELS) -> tuple[Asset, tuple[str, ...]]:
    """Reduce the asset to about `faces` faces and textures of at most `pixels`; also return notes, () if unchanged.

    Parts, joints and names are unchanged. Decimated parts lose their textures; vertices have the colours instead.
    """
    count = len(asset.mesh.faces)
    if count > faces:
        asset = _decimated(asset, faces)
        return asset, (f"Decimated for display: {len(asset.mesh.faces):,} of {count:,} faces. The files are unchanged.",)
    largest, materials = 0, []
    for material in asset.mesh.materials:
        textures = {slot: _smaller(texture, pixels) for slot, texture in material.textures.items()}
        largest = max([largest, *(size for _, size in textures.values())])
        materials.append(replace(material, textures={slot: texture for slot, (texture, _) in textures.items()}))
    if largest <= pixels:
        return asset, ()
    note = f"Textures shrunk for display: from up to {largest} to {pixels} pixels. The files are unchanged."
    return replace(asset, mesh=replace(asset.mesh, materials=tuple(materials))), (note,)


def display_glb(asset: Asset) -> bytes:
    """Return the GLB of an asset with legal names."""
    return glb_bytes(asset, split_links(asset), ExportConfig())


def _decimated(asset: Asset, faces: int) -> Asset:
    mesh, part_of = asset.mesh, asset.segmentation.face_part
    pieces = []
    for part in range(len(asset.segmentation.parts)):
        mine = mesh.triangles[part_of == part]
        most = max(MIN_PART_FACES, faces * len(mine) // len(mesh.faces))
        pieces.append(simplify(_clustered(mine, COARSE * most), most))
    triangles = np.concatenate(pieces)
    part = np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces])
    nearest = distance_to_mesh(triangles.reshape(-1, 3), mesh.vertices, mesh.faces)[1]
    colors = np.full((len(nearest), 4), 255, np.uint8)
    colors[:, :3] = face_colors(mesh)[nearest]
    light = Mesh(
        vertices=triangles.reshape(-1, 3),
        faces=np.arange(3 * len(triangles)).reshape(-1, 3),
        face_node=np.zeros(len(triangles), int),
        nodes=mesh.nodes[:1],
        face_material=np.zeros(len(triangles), int),
        materials=(COATED,),
        corner_color=colors.reshape(-1, 3, 4),
    )
    return replace(asset, mesh=light, segmentation=Segmentation(part, asset.segmentation.parts), source_face=None)


def _clustered(triangles: Float[np.ndarray, "F 3 3"], most: int) -> Float[np.ndarray, "R 3 3"]:
    """Merge the corners in each cell of a grid, for about `most` triangles if the surface has more.

    This is inexact, but ten times as fast as edge collapses, which take half a minute for a million faces.
    """
    if len(triangles) <= most:
        return triangles
    corners = triangles.reshape(-1, 3)
    cell = float(np.sqrt(2 * normals_and_areas(triangles)[1].sum() / most))  # two triangles per cell of the surface
    cell = max(cell, FINEST * float(np.ptp(corners, axis=0).max()))
    if not cell > 0:
        return triangles
    grid = np.floor((corners - corners.min(0)) / cell).astype(np.int64)
    key = np.ravel_multi_index(tuple(grid.T), tuple(grid.max(0) + 1))
    number, count = np.unique(key, return_inverse=True, return_counts=True)[1:]
    middle = np.stack([np.bincount(number, column) for column in corners.T], 1) / count[:, None]
    faces = number.reshape(-1, 3)
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(1)]
    first = np.unique(np.sort(faces, 1), axis=0, return_index=True)[1]
    return middle[faces[np.sort(first)]] if len(first) else triangles


def _smaller(texture: Texture, pixels: int) -> tuple[Texture, int]:
    """Return the reduced texture, and its original longest side [px]; an unreadable one is unchanged."""
    try:
        with Image.open(io.BytesIO(texture.data)) as image:
            longest = max(image.size)
            if longest <= pixels or texture.mime not in FORMATS:
                return texture, longest
            scale = pixels / longest
            small = image.resize([max(1, round(scale * side)) for side in image.size], Image.Resampling.LANCZOS)
            buffer = io.BytesIO()
            small.save(buffer, FORMATS[texture.mime])
    except (OSError, ValueError, Image.DecompressionBombError):
        return texture, 0
    return replace(texture, data=buffer.getvalue()), longest


def jpeg(picture: bytes, width: int, quality: int) -> bytes:
    """Convert a picture file to JPEG of at most this width; transparent pixels become white."""
    with Image.open(io.BytesIO(picture)) as image:
        flat = Image.new("RGB", image.size, (255, 255, 255))
        flat.paste(image, mask=image.getchannel("A") if image.mode in ("RGBA", "LA") else None)
    flat.thumbnail((width, 4 * width), Image.Resampling.LANCZOS)
    buffer = io.BytesIO()
    flat.save(buffer, "JPEG", quality=quality)
    return buffer.getvalue()


def materials_shown(materials: tuple[Material, ...], colors: np.ndarray | None) -> bool:
    """Return whether the materials have visible colours or textures."""
    return colors is not None or any(_has_look(m.textures, m.base_color) for m in materials)


def _has_look(textures: Mapping[str, Texture], base: tuple[float, ...]) -> bool:
    return bool(textures) or max(base[:3]) - min(base[:3]) > 0.02
