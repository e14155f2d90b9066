"""Geoms of a compiled MuJoCo model as meshes, with colour and texture."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from PIL import Image

from anymesh.errors import InputError
from anymesh.evaluation.datasets.shapes_ import box, capsule, cylinder, ellipsoid
from anymesh.loading.join import simple_mesh
from anymesh.mujoco_ import load_mujoco
from anymesh.types import Material, Mesh, Texture
from anymesh.types.mesh import to_linear

mujoco = load_mujoco()

PLAIN = np.array([0.5, 0.5, 0.5, 1.0])  # MuJoCo's default colour of a geom


class GeomMaterials:
    """The geoms of one model; each texture is encoded only once."""

    def __init__(self, model: Any) -> None:
        self._model = model
        self._textures: dict[int, Texture] = {}

    def mesh(self, geom: int) -> Mesh:
        """Return the mesh in the geom's frame."""
        size = self._model.geom_size[geom]
        material, repeat = self._material(geom)
        match self._model.geom_type[geom]:
            case mujoco.mjtGeom.mjGEOM_BOX:
                return box(2 * size, material)
            case mujoco.mjtGeom.mjGEOM_SPHERE:
                return ellipsoid([size[0]] * 3, material)
            case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
                return ellipsoid(size, material)
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                return cylinder(size[0], 2 * size[1], material)
            case mujoco.mjtGeom.mjGEOM_CAPSULE:
                return capsule(size[0], 2 * size[1], material)
            case mujoco.mjtGeom.mjGEOM_MESH:
                return _mesh(self._model, int(self._model.geom_dataid[geom]), material, repeat)
            case kind:
                raise InputError(f"geom {geom} has the type {mujoco.mjtGeom(kind).name}; valid are primitives and meshes")

    def _has_uv(self, geom: int) -> bool:
        m = self._model
        return bool(m.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and m.mesh_texcoordadr[m.geom_dataid[geom]] >= 0)

    def _material(self, geom: int) -> tuple[Material, np.ndarray]:
        """Return the geom's material, and the repetitions of its texture along u and v."""
        m = self._model
        number, rgba = int(m.geom_matid[geom]), m.geom_rgba[geom]
        if number < 0:
            return _colored(rgba), np.ones(2)
        tint = m.mat_rgba[number] if np.allclose(rgba, PLAIN) else rgba
        texture = int(m.mat_texid[number][mujoco.mjtTextureRole.mjTEXROLE_RGB])
        if texture < 0:
            return _colored(tint), np.ones(2)
        # a projected texture is replaced by its mean colour
        if m.tex_type[texture] != mujoco.mjtTexture.mjTEXTURE_2D or not self._has_uv(geom):
            middle = _pixels(m, texture)[..., :3].reshape(-1, 3).mean(0) / 255
            return _colored(tint * np.r_[middle, 1]), np.ones(2)
        if texture not in self._textures:
            buffer = io.BytesIO()
            Image.fromarray(_pixels(m, texture)).save(buffer, "PNG", compress_level=1)
            self._textures[texture] = Texture(buffer.getvalue(), "image/png")
        return _colored(tint, {"base_color": self._textures[texture]}), m.mat_texrepeat[number]


def _colored(rgba: np.ndarray, textures: dict[str, Texture] | None = None) -> Material:
    color = (*to_linear(rgba[:3].astype(float)).tolist(), float(rgba[3]))
    return Material(base_color=color, alpha_mode="BLEND" if rgba[3] < 1 else "OPAQUE", textures=textures or {})


def _pixels(model: Any, texture: int) -> np.ndarray:
    height, width, channels = (int(a[texture]) for a in (model.tex_height, model.tex_width, model.tex_nchannel))
    start = int(model.tex_adr[texture])
    pixels = model.tex_data[start : start + height * width * channels].reshape(height, width, channels)
    return np.repeat(pixels, 3, axis=2) if channels == 1 else pixels


def _mesh(model: Any, mesh: int, material: Material, repeat: np.ndarray) -> Mesh:
    def rows(values: np.ndarray, start: np.ndarray, count: np.ndarray) -> np.ndarray:
        return values[int(start[mesh]) : int(start[mesh]) + int(count[mesh])]

    faces = rows(model.mesh_face, model.mesh_faceadr, model.mesh_facenum)
    uv = None
    if model.mesh_texcoordadr[mesh] >= 0:
        table = rows(model.mesh_texcoord, model.mesh_texcoordadr, model.mesh_texcoordnum) * repeat
        uv = table[rows(model.mesh_facetexcoord, model.mesh_faceadr, model.mesh_facenum)]
        uv = np.stack([uv[..., 0], 1 - uv[..., 1]], -1).astype(np.float32)  # MuJoCo's v points down
    vertices = rows(model.mesh_vert, model.mesh_vertadr, model.mesh_vertnum)
    return simple_mesh("mesh", "mesh", vertices, faces, material, corner_uv=uv)
