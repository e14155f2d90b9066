"""Appearance of a link in USD: one mesh, its materials as UsdPreviewSurface, corner colours as displayColor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from anymesh.export.links import Link, Primitive
from anymesh.export.materials import GREY, painted
from anymesh.export.meshes import material_names, visible
from anymesh.export.model import FOLDER
from anymesh.export.settings import ExportConfig
from anymesh.types import Material, Mesh
from anymesh.types.mesh import to_linear


class UsdMaterials:
    """Writes visual meshes, and each material once on first use."""

    def __init__(self, pxr: Any, stage: Any, scope: str, mesh: Mesh, textures: Mapping[bytes, str]) -> None:
        self._pxr, self._stage, self._scope, self._mesh, self._textures = pxr, stage, scope, mesh, textures
        self._names = material_names(mesh.materials)
        self._made: dict[int, Any] = {}

    def add_visual(self, path: str, link: Link, config: ExportConfig) -> None:
        """Add the mesh of a link; several materials become face subsets."""
        pxr, primitives = self._pxr, visible(link, config)
        mesh = pxr.UsdGeom.Mesh.Define(self._stage, path)
        points = np.concatenate([p.positions for p in primitives]).astype(np.float32)
        offsets = np.cumsum([0, *(len(p.positions) for p in primitives)])
        faces = np.concatenate([p.triangles + start for p, start in zip(primitives, offsets, strict=False)])
        mesh.CreatePointsAttr(pxr.Vt.Vec3fArray.FromNumpy(points))
        mesh.CreateFaceVertexCountsAttr(pxr.Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
        mesh.CreateFaceVertexIndicesAttr(pxr.Vt.IntArray.FromNumpy(faces.reshape(-1).astype(np.int32)))
        mesh.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
        mesh.CreateExtentAttr(pxr.Vt.Vec3fArray.FromNumpy(np.array([points.min(0), points.max(0)])))
        sides = [self._mesh.materials[p.material].double_sided for p in primitives if p.material >= 0]
        mesh.CreateDoubleSidedAttr(any(sides))
        self._add_primvars(mesh, primitives)
        self._bind(mesh, primitives)

    def _add_primvars(self, mesh: Any, primitives: Sequence[Primitive]) -> None:
        """Add normals, texture coordinates (v up, as in USD) and colours of the corners."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        api, vertex = pxr.UsdGeom.PrimvarsAPI(mesh), pxr.UsdGeom.Tokens.vertex
        normals = [p.normals for p in primitives if p.normals is not None]
        uv = [p.uv for p in primitives if p.uv is not None]
        if len(normals) == len(primitives):
            mesh.CreateNormalsAttr(pxr.Vt.Vec3fArray.FromNumpy(np.concatenate(normals).astype(np.float32)))
            mesh.SetNormalsInterpolation(vertex)
        if len(uv) == len(primitives):
            st = api.CreatePrimvar("st", kinds.TexCoord2fArray, vertex)
            st.Set(pxr.Vt.Vec2fArray.FromNumpy(np.concatenate(uv).astype(np.float32)))
        if any(p.material < 0 or painted(self._mesh, p) for p in primitives):
            colors = np.concatenate([_colors(p) for p in primitives])
            display = mesh.CreateDisplayColorPrimvar(vertex)
            display.Set(pxr.Vt.Vec3fArray.FromNumpy(to_linear(colors[:, :3]).astype(np.float32)))
            if (colors[:, 3] < 1).any():
                opacity = mesh.CreateDisplayOpacityPrimvar(vertex)
                opacity.Set(pxr.Vt.FloatArray.FromNumpy(np.ascontiguousarray(colors[:, 3], np.float32)))

    def _bind(self, mesh: Any, primitives: Sequence[Primitive]) -> None:
        shade, start = self._pxr.UsdShade, 0
        for p in primitives:
            at, start = np.arange(start, start + len(p.triangles), dtype=np.int32), start + len(p.triangles)
            if p.material < 0 or painted(self._mesh, p):
                continue  # displayColor is used
            prim = mesh.GetPrim()
            if len(primitives) > 1:
                binding = shade.MaterialBindingAPI.Apply(prim)
                subset = binding.CreateMaterialBindSubset(self._names[p.material], self._pxr.Vt.IntArray.FromNumpy(at))
                prim = subset.GetPrim()
            shade.MaterialBindingAPI.Apply(prim).Bind(self._material(p.material))

    def _material(self, index: int) -> Any:
        if index not in self._made:
            self._made[index] = self._make(f"{self._scope}/{self._names[index]}", self._mesh.materials[index])
        return self._made[index]

    def _make(self, path: str, m: Material) -> Any:
        """Convert glTF's metallic-roughness model to UsdPreviewSurface; factors scale the textures."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        material = pxr.UsdShade.Material.Define(self._stage, path)
        surface = pxr.UsdShade.Shader.Define(self._stage, f"{path}/surface")
        surface.CreateIdAttr("UsdPreviewSurface")
        material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
        alpha = m.base_color[3] if m.alpha_mode != "OPAQUE" else 1.0
        for name, kind, value in (
            ("diffuseColor", kinds.Color3f, pxr.Gf.Vec3f(*m.base_color[:3])),
            ("emissiveColor", kinds.Color3f, pxr.Gf.Vec3f(*m.emissive)),
            ("metallic", kinds.Float, m.metallic),
            ("roughness", kinds.Float, m.roughness),
            ("opacity", kinds.Float, alpha),
            ("opacityThreshold", kinds.Float, m.alpha_cutoff if m.alpha_mode == "MASK" else 0.0),
        ):
            surface.CreateInput(name, kind).Set(value)
        reads = {
            "base_color": ("sRGB", m.base_color, (0, 0, 0, 0), {"diffuseColor": "rgb"}),
            "metallic_roughness": ("raw", (1, m.roughness, m.metallic, 1), (0, 0, 0, 0), {"roughness": "g", "metallic": "b"}),
            "normal": ("raw", (2, 2, 2, 1), (-1, -1, -1, 0), {"normal": "rgb"}),
            "occlusion": ("raw", (1, 1, 1, 1), (0, 0, 0, 0), {"occlusion": "r"}),
            "emissive": ("sRGB", (*m.emissive, 1), (0, 0, 0, 0), {"emissiveColor": "rgb"}),
        }
        if m.alpha_mode != "OPAQUE":
            reads["base_color"][3]["opacity"] = "a"
        for slot, (space, scale, bias, outputs) in reads.items():
            if slot in m.textures and m.textures[slot].data in self._textures:
                shader = self._texture(path, slot, self._textures[m.textures[slot].data], space)
                shader.CreateInput("scale", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in scale)))
                shader.CreateInput("bias", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in bias)))
                _connect(pxr, surface, shader, outputs)
        return material

    def _texture(self, path: str, slot: str, file: str, space: str) -> Any:
        """Add a texture shader that reads its coordinates from `st`."""
        pxr, kinds = self._pxr, self._pxr.Sdf.ValueTypeNames
        reader = pxr.UsdShade.Shader.Define(self._stage, f"{path}/st")
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", kinds.String).Set("st")
        shader = pxr.UsdShade.Shader.Define(self._stage, f"{path}/{slot}")
        shader.CreateIdAttr("UsdUVTexture")
        shader.CreateInput("file", kinds.Asset).Set(f"./{FOLDER}/{file}")
        shader.CreateInput("sourceColorSpace", kinds.Token).Set(space)
        for wrap in ("wrapS", "wrapT"):
            shader.CreateInput(wrap, kinds.Token).Set("repeat")
        result = reader.CreateOutput("result", kinds.Float2)
        shader.CreateInput("st", kinds.Float2).ConnectToSource(result)
        return shader


def _connect(pxr: Any, surface: Any, shader: Any, outputs: Mapping[str, str]) -> None:
    kinds = pxr.Sdf.ValueTypeNames
    types = {"diffuseColor": kinds.Color3f, "emissiveColor": kinds.Color3f, "normal": kinds.Normal3f}
    for name, channel in outputs.items():
        output = shader.CreateOutput(channel, kinds.Float3 if channel == "rgb" else kinds.Float)
        surface.CreateInput(name, types.get(name, kinds.Float)).ConnectToSource(output)


def _colors(p: Primitive) -> np.ndarray:
    """Return (n, 4) sRGB and alpha 0..1 of the corners; grey for a primitive without colours and material."""
    if p.colors is not None:
        return p.colors / 255
    return np.tile(np.array(GREY if p.material < 0 else (1.0, 1, 1, 1)), (len(p.positions), 1))
