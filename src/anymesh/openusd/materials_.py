"""Materials in USD: UsdPreviewSurface, each written once on first use, and their bindings."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from anymesh.export.links import Primitive
from anymesh.export.meshes import material_names, painted
from anymesh.names import legal_names
from anymesh.types import Brief, Material, Mesh, Texture

PAINTED = "painted"  # after the name of a material that takes its colours from the corners


@dataclass
class UsdMaterials(Brief):
    """Writes materials below the path `scope` of a stage. folder: of pictures; textures: their file names by their bytes."""

    pxr: Any
    stage: Any
    scope: str
    mesh: Mesh
    folder: str
    textures: Mapping[bytes, str]
    _made: set[str] = field(default_factory=set)

    @cached_property
    def _names(self) -> list[str]:
        """Return the names of the materials as they are, then painted."""
        names = material_names(self.mesh.materials)
        return legal_names([*names, *(f"{name}_{PAINTED}" for name in names)], fallback="material")

    def name(self, p: Primitive) -> str:
        """Return the name of the material of a primitive, also of a subset of the faces that have it."""
        return self._names[p.material + len(self.mesh.materials) * painted(self.mesh, p)]

    def add_subsets(self, mesh: Any, primitives: Sequence[Primitive], counts: Sequence[int]) -> None:
        """Divide the faces of a mesh by material, if it has several. counts: number of faces of each primitive."""
        start, shade = 0, self.pxr.UsdShade
        for p, count in zip(primitives, counts, strict=True) if len(primitives) > 1 else ():
            at, start = np.arange(start, start + count, dtype=np.int32), start + count
            binding = shade.MaterialBindingAPI.Apply(mesh.GetPrim())
            binding.CreateMaterialBindSubset(self.name(p), self.pxr.Vt.IntArray.FromNumpy(at))

    def bind(self, stage: Any, path: str, primitives: Sequence[Primitive], place: Callable[[str], str]) -> None:
        """Bind the materials of a mesh at `path` of a stage, and of its subsets. place: path of a material by its path here."""
        shade = self.pxr.UsdShade
        for p in primitives:
            prim = stage.OverridePrim(f"{path}/{self.name(p)}" if len(primitives) > 1 else path)
            material = stage.OverridePrim(place(self._material(p)))
            shade.MaterialBindingAPI.Apply(prim).Bind(shade.Material(material))

    def _material(self, p: Primitive) -> str:
        """Return the path of the material of a primitive, which is written if it is not there."""
        path = f"{self.scope}/{self.name(p)}"
        if path not in self._made:
            self._made.add(path)
            surface = self._make(path, self.mesh.materials[p.material])
            if painted(self.mesh, p):
                self._paint(path, surface, self.mesh.materials[p.material])
        return path

    def _paint(self, path: str, surface: Any, material: Material) -> None:
        """Connect colour and opacity to those of the corners."""
        kinds = self.pxr.Sdf.ValueTypeNames
        reads = [("diffuseColor", "displayColor", "float3", kinds.Float3)]
        if material.alpha_mode != "OPAQUE":
            reads.append(("opacity", "displayOpacity", "float", kinds.Float))
        for target, varname, kind, type_name in reads:
            reader = self.pxr.UsdShade.Shader.Define(self.stage, f"{path}/{varname}")
            reader.CreateIdAttr(f"UsdPrimvarReader_{kind}")
            reader.CreateInput("varname", kinds.String).Set(varname)
            if kind == "float":
                reader.CreateInput("fallback", kinds.Float).Set(1.0)
            surface.GetInput(target).GetAttr().Clear()  # three.js reads a value before the connection
            surface.GetInput(target).ConnectToSource(reader.CreateOutput("result", type_name))

    def _make(self, path: str, m: Material) -> Any:
        """Convert glTF's metallic-roughness model to UsdPreviewSurface; factors scale the textures."""
        pxr, kinds = self.pxr, self.pxr.Sdf.ValueTypeNames
        material = pxr.UsdShade.Material.Define(self.stage, path)
        surface = pxr.UsdShade.Shader.Define(self.stage, f"{path}/surface")
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
        bump, shade = (m.textures[slot].strength if slot in m.textures else 1.0 for slot in ("normal", "occlusion"))
        reads = {
            "base_color": ("sRGB", m.base_color, (0, 0, 0, 0), {"diffuseColor": "rgb"}),
            "metallic_roughness": ("raw", (1, m.roughness, m.metallic, 1), (0, 0, 0, 0), {"roughness": "g", "metallic": "b"}),
            "normal": ("raw", (2 * bump, 2 * bump, 2, 1), (-bump, -bump, -1, 0), {"normal": "rgb"}),
            "occlusion": ("raw", (shade, shade, shade, 1), (*[1 - shade] * 3, 0), {"occlusion": "r"}),
            "emissive": ("sRGB", (*m.emissive, 1), (0, 0, 0, 0), {"emissiveColor": "rgb"}),
        }
        if m.alpha_mode != "OPAQUE":
            reads["base_color"][3]["opacity"] = "a"
        for slot, (space, scale, bias, outputs) in reads.items():
            if slot in m.textures and m.textures[slot].data in self.textures:
                shader = self._texture(path, slot, m.textures[slot], space)
                shader.CreateInput("scale", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in scale)))
                shader.CreateInput("bias", kinds.Float4).Set(pxr.Gf.Vec4f(*(float(v) for v in bias)))
                _connect(pxr, surface, shader, outputs)
        return surface

    def _texture(self, path: str, slot: str, texture: Texture, space: str) -> Any:
        """Add a texture shader that reads its coordinates from `st`, or `st1` and so on."""
        pxr, kinds = self.pxr, self.pxr.Sdf.ValueTypeNames
        varname = f"st{texture.uv_set or ''}"
        reader = pxr.UsdShade.Shader.Define(self.stage, f"{path}/{varname}")
        reader.CreateIdAttr("UsdPrimvarReader_float2")
        reader.CreateInput("varname", kinds.String).Set(varname)
        shader = pxr.UsdShade.Shader.Define(self.stage, f"{path}/{slot}")
        shader.CreateIdAttr("UsdUVTexture")
        shader.CreateInput("file", kinds.Asset).Set(f"{self.folder}/{self.textures[texture.data]}")
        shader.CreateInput("sourceColorSpace", kinds.Token).Set(space)
        for name, wrap in zip(("wrapS", "wrapT"), texture.wrap, strict=True):
            shader.CreateInput(name, kinds.Token).Set(wrap)
        result = reader.CreateOutput("result", kinds.Float2)
        shader.CreateInput("st", kinds.Float2).ConnectToSource(result)
        return shader


def _connect(pxr: Any, surface: Any, shader: Any, outputs: Mapping[str, str]) -> None:
    kinds = pxr.Sdf.ValueTypeNames
    types = {"diffuseColor": kinds.Color3f, "emissiveColor": kinds.Color3f, "normal": kinds.Normal3f}
    for name, channel in outputs.items():
        output = shader.CreateOutput(channel, kinds.Float3 if channel == "rgb" else kinds.Float)
        surface.CreateInput(name, types.get(name, kinds.Float)).ConnectToSource(output)
