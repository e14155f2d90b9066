"""Materials of USD: UsdPreviewSurface, and the factors and pictures of OmniPBR and of MaterialX's standard surfaces."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from anymesh.formats.pictures_ import Channel, merged
from anymesh.formats.usd.layers_ import Layers
from anymesh.loading.files import Folder, picture_file
from anymesh.loading.references import SHOWN
from anymesh.types import Material, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT

PURPOSES = ("preview", "full")  # of bindings, in order; each falls back to those for all purposes
CONTEXTS = ("", "mdl", "mtlx")  # universal first
UV_NAMES = ("st", "UVMap", "st0", "st_0", "uv", "map1", "Texture_uv")  # where a shader names no coordinates
PREVIEW = "UsdPreviewSurface"
WRAP = {"mirror": MIRROR, "clamp": CLAMP, "black": CLAMP, "periodic": REPEAT}
# Inputs of other shaders, by those of UsdPreviewSurface; the first that is there counts.
OTHERS: dict[str, dict[str, tuple[str, ...]]] = {
    "OmniPBR": {
        "diffuseColor": ("diffuse_texture", "diffuse_color_constant"),
        "metallic": ("metallic_texture", "metallic_constant"),
        "roughness": ("reflectionroughness_texture", "reflection_roughness_constant"),
        "normal": ("normalmap_texture",),
        "occlusion": ("ao_texture",),
        "orm": ("ORM_texture",),
        "emissiveColor": ("emissive_color_texture", "emissive_color"),
        "opacity": ("opacity_texture", "opacity_constant"),
        "opacityThreshold": ("opacity_threshold",),
    },
    "standard_surface": {
        "diffuseColor": ("base_color",),
        "metallic": ("metalness",),
        "roughness": ("specular_roughness",),
        "normal": ("normal",),
        "emissiveColor": ("emission_color",),
        "opacity": ("opacity",),
    },
    "open_pbr_surface": {
        "diffuseColor": ("base_color",),
        "metallic": ("base_metalness",),
        "roughness": ("specular_roughness",),
        "normal": ("geometry_normal",),
        "emissiveColor": ("emission_color",),
        "opacity": ("geometry_opacity",),
    },
}
DEFAULTS = {
    "diffuseColor": 0.18, "metallic": 0.0, "roughness": 0.5, "emissiveColor": 0.0, "opacity": 1.0, "opacityThreshold": 0.0,
}  # fmt: skip
UNREAD = ("clearcoat", "displacement", "useSpecularWorkflow")


Coordinates = tuple[str | None, tuple[float, ...] | None]  # primvar, and the 6 numbers of its (2, 3) transform


@dataclass(frozen=True)
class UsdPicture:
    """A picture that an input reads. channel: rgb, r, g, b or a; values are its own times scale plus bias."""

    texture: Texture
    channel: str
    scale: tuple[float, ...]  # 4
    bias: tuple[float, ...]  # 4
    coordinates: Coordinates


@dataclass(frozen=True)
class UsdLook:
    """A material, its texture coordinates by uv_set of its pictures, and a primvar that gives its colour."""

    material: Material
    sets: tuple[Coordinates, ...] = ()
    color: str | None = None


class StageMaterials:
    """Reads each material once."""

    def __init__(self, pxr: Any, layers: Layers, folder: Folder) -> None:
        self._pxr, self._layers, self._folder = pxr, layers, folder
        self._looks: dict[tuple[str, str], UsdLook | None] = {}
        self._sided: dict[tuple[str, bool], UsdLook] = {}
        self._pictures: dict[tuple[str, str], Texture | None] = {}

    def bound(self, prim: Any, double_sided: bool) -> UsdLook | None:
        """Return the material bound to a prim or one above it; None if there is none that can be read."""
        for purpose in PURPOSES:
            material = self._binding(prim, purpose)
            if material is not None and (look := self._look(material, purpose)) is not None:
                key = (f"{material.GetPath()}{purpose}", double_sided)
                if key not in self._sided:
                    self._sided[key] = replace(look, material=replace(look.material, double_sided=double_sided))
                return self._sided[key]
        return None

    def _binding(self, prim: Any, purpose: str) -> Any:
        material = self._pxr.UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(purpose)[0]
        while not material and prim:  # files of old writers do not state the schema, without which bindings do not count
            targets = prim.GetRelationship("material:binding").GetForwardedTargets()
            material = self._pxr.UsdShade.Material(prim.GetStage().GetPrimAtPath(targets[0])) if targets else None
            prim = prim.GetParent()
        return material or None

    def _look(self, material: Any, purpose: str) -> UsdLook | None:
        key = (str(material.GetPath()), purpose)
        if key not in self._looks:
            self._looks[key] = self._read(material)
        return self._looks[key]

    def _read(self, material: Any) -> UsdLook | None:
        identifier = None
        for context in CONTEXTS:
            shader = material.ComputeSurfaceSource(context)[0]
            if not shader:
                continue
            identifier = _identifier(shader)
            kind = next((k for k in OTHERS if k in identifier), None)
            if identifier == PREVIEW or kind:
                return self._surface(material.GetPrim().GetName(), shader, OTHERS[kind] if kind else None)
        what = f"uses the shader {identifier[:SHOWN]!r}, which is not read" if identifier else "has no surface shader"
        self._folder.warn(f"material {material.GetPrim().GetName()!r} {what}; it is drawn grey")
        return None

    def _surface(self, name: str, shader: Any, names: dict[str, tuple[str, ...]] | None) -> UsdLook:
        def source(key: str) -> Any:
            for other in (key,) if names is None else names.get(key, ()):
                content = self._source(shader, other)
                if content is not None:
                    return content
            return None

        for unread in UNREAD:
            if names is None and isinstance(amount := source(unread), float | int) and amount:
                self._folder.warn(f"{unread} of materials is left out")
        sources = {key: source(key) for key in (*DEFAULTS, "normal", "occlusion", "orm")}
        if names is not None and "diffuse_texture" in names["diffuseColor"]:
            sources = self._omni(shader, sources)
        color = sources["diffuseColor"].name if isinstance(sources["diffuseColor"], _Primvar) else None
        pictures = {key: s for key, s in sources.items() if isinstance(s, UsdPicture)}
        numbers = {key: _number(sources[key], default, key) for key, default in DEFAULTS.items()}
        return self._assembled(name, numbers, pictures, color)

    def _omni(self, shader: Any, sources: dict[str, Any]) -> dict[str, Any]:
        """Return the sources of an OmniPBR, whose switches say which of its inputs count."""
        new = dict(sources)
        tint = self._source(shader, "diffuse_tint")
        if not self._source(shader, "enable_opacity"):
            new["opacity"], new["opacityThreshold"] = 1.0, 0.0
        if not self._source(shader, "enable_emission"):
            new["emissiveColor"] = 0.0
        if not self._source(shader, "enable_ORM_texture"):
            new["orm"] = None
        base = new["diffuseColor"]
        if isinstance(base, UsdPicture) and tint is not None and not isinstance(tint, UsdPicture | _Primvar):
            new["diffuseColor"] = replace(base, scale=(*np.resize(np.asarray(tint, float), 3).tolist(), 1.0))
        return new

    def _assembled(self, name: str, n: dict[str, Any], pictures: dict[str, UsdPicture], color: str | None) -> UsdLook:
        base, opacity, threshold = pictures.get("diffuseColor"), pictures.get("opacity"), float(n["opacityThreshold"][0])
        alpha = float(n["opacity"][0])
        red, green, blue = (1.0, 1.0, 1.0) if color else n["diffuseColor"]
        mode = "MASK" if threshold > 0 and (opacity or alpha < 1) else "BLEND" if opacity or alpha < 1 else "OPAQUE"
        textures: dict[str, Texture] = {}
        if base is not None or opacity is not None:
            textures["base_color"] = merged(None if base is None else base.texture, a=_channel(opacity, "a"))
        rough, metal, orm = pictures.get("roughness"), pictures.get("metallic"), pictures.get("orm")
        if orm is not None:
            textures["metallic_roughness"] = textures["occlusion"] = orm.texture
        elif rough or metal:
            textures["metallic_roughness"] = merged(None, g=_channel(rough), b=_channel(metal))
        for key, slot in (("normal", "normal"), ("occlusion", "occlusion"), ("emissiveColor", "emissive")):
            if (p := pictures.get(key)) is not None:
                textures.setdefault(slot, p.texture)
        leaders = {
            "base_color": base or opacity, "metallic_roughness": orm or rough or metal, "normal": pictures.get("normal"),
            "occlusion": orm or pictures.get("occlusion"), "emissive": pictures.get("emissiveColor"),
        }  # fmt: skip
        self._check(pictures, (base, opacity), (rough, metal))
        sets: list[Coordinates] = []
        for slot in textures:
            leader = leaders[slot]
            assert leader is not None
            sets += [leader.coordinates] if leader.coordinates not in sets else []
            strength = leader.scale[0] / 2 if slot == "normal" and leader.bias[0] < -0.5 else 1.0
            textures[slot] = replace(
                textures[slot], wrap=leader.texture.wrap, uv_set=sets.index(leader.coordinates), strength=strength
            )
        return UsdLook(
            Material(
                name=name, base_color=(red, green, blue, alpha), metallic=n["metallic"][0], roughness=n["roughness"][0],
                emissive=n["emissiveColor"], alpha_mode=mode, alpha_cutoff=threshold or 0.5, textures=textures,
            ),
            tuple(sets), color,
        )  # fmt: skip

    def _check(self, pictures: dict[str, UsdPicture], *pairs: tuple[UsdPicture | None, UsdPicture | None]) -> None:
        """Warn of what materials cannot represent."""
        if any(max(map(abs, p.bias[:3])) > 0.02 for key, p in pictures.items() if key != "normal"):
            self._folder.warn("the bias of a material's picture is left out")
        if any(a and b and a.coordinates != b.coordinates for a, b in pairs):
            self._folder.warn("opacity, or metallic, is drawn with the coordinates of the picture that it is joined with")

    def _source(self, shader: Any, name: str) -> Any:
        """Return what an input reads: a picture, a primvar or a constant; None if it is not authored."""
        given = shader.GetInput(name)
        if not given:
            return None
        for _ in range(20):  # nodes between the picture and the surface are passed
            attributes = self._pxr.UsdShade.Utils.GetValueProducingAttributes(given)
            if not attributes:
                return None
            attribute = attributes[0]
            kind = self._pxr.UsdShade.Utils.GetType(attribute.GetName())
            if kind != self._pxr.UsdShade.AttributeType.Output:
                content = attribute.Get()
                return self._picture_of(attribute, None, "rgb") if isinstance(content, self._pxr.Sdf.AssetPath) else content
            node = self._pxr.UsdShade.Shader(attribute.GetPrim())
            identifier, channel = _identifier(node), attribute.GetName().rsplit(":", 1)[-1]
            if "PrimvarReader" in identifier or "geompropvalue" in identifier or "geomcolor" in identifier:
                varname = self._text(node, "varname") or self._text(node, "geomprop") or "displayColor"
                return _Primvar(varname)
            file = node.GetInput("file")
            if file:
                source = self._pxr.UsdShade.Utils.GetValueProducingAttributes(file)
                return self._picture_of(source[0], node, channel) if source else None
            given = next((node.GetInput(k) for k in ("in", "in1", "input") if node.GetInput(k)), None)
            if given is None:
                self._folder.warn(f"a material's node {identifier[:SHOWN]!r} is left out")
                return None
        return None

    def _text(self, node: Any, name: str) -> str | None:
        given = node.GetInput(name)
        attributes = self._pxr.UsdShade.Utils.GetValueProducingAttributes(given) if given else []
        content = attributes[0].Get() if attributes else None
        return str(content) if content else None

    def _picture_of(self, attribute: Any, node: Any, channel: str) -> Any:
        specs = [s for s in attribute.GetPropertyStack(self._pxr.Usd.TimeCode.Default()) if s.HasInfo("default")]
        asset = specs[0].default.path if specs else ""
        if not asset:
            return None
        folder = self._layers.folder_of(specs[0].layer)
        key = (specs[0].layer.identifier, asset)
        if key not in self._pictures:
            self._pictures[key] = self._read_picture(folder, asset)

        def four(name: str, usual: float) -> tuple[float, ...]:
            content = self._constant(node, name)
            values = (usual,) * 4 if content is None else tuple(float(v) for v in content)
            return values if len(values) == 4 and np.isfinite(values).all() else (usual,) * 4

        channel = {"out": "rgb", "outputs": "rgb", "rgba": "rgb"}.get(channel, channel)
        if (texture := self._pictures[key]) is None:
            return four("fallback", 1.0)[:3] if channel == "rgb" else None
        modes = [str(self._constant(node, k) or "") for k in ("wrapS", "wrapT")]
        texture = replace(texture, wrap=(WRAP.get(modes[0], REPEAT), WRAP.get(modes[1], REPEAT)))
        return UsdPicture(texture, channel, four("scale", 1.0), four("bias", 0.0), self._coordinates(node))

    def _read_picture(self, folder: Folder, asset: str) -> Texture | None:
        if "<UDIM>" in asset or "<udim>" in asset:
            tile = re.sub("<udim>", "1001", asset, flags=re.I)
            folder.warn(f"texture {asset[:SHOWN]!r} has several tiles (UDIM); the first one is used for all")
            return picture_file(folder, tile)
        return picture_file(folder, asset)

    def _constant(self, node: Any, name: str) -> Any:
        given = node.GetInput(name) if node is not None else None
        attributes = self._pxr.UsdShade.Utils.GetValueProducingAttributes(given) if given else []
        return attributes[0].Get() if attributes else None

    def _coordinates(self, node: Any) -> Coordinates:
        """Return the primvar and the transform of a picture's texture coordinates."""
        total = np.eye(3)
        given = next((node.GetInput(k) for k in ("st", "texcoord") if node.GetInput(k)), None) if node is not None else None
        for _ in range(20):
            attributes = self._pxr.UsdShade.Utils.GetValueProducingAttributes(given) if given else []
            if not attributes:
                return None, None
            reader = self._pxr.UsdShade.Shader(attributes[0].GetPrim())
            if "ransform2d" in _identifier(reader):
                total = total @ self._transform(reader)
                given = reader.GetInput("in")
                continue
            name = (self._text(reader, "varname") or self._text(reader, "geomprop")) if reader else None
            return name, None if np.allclose(total, np.eye(3)) else tuple(total[:2].reshape(-1).tolist())
        return None, None

    def _transform(self, reader: Any) -> np.ndarray:
        def number(name: str, usual: Any) -> Any:
            content = self._constant(reader, name)
            return usual if content is None or not np.isfinite(np.asarray(content, float)).all() else content

        angle = np.radians(float(number("rotation", 0.0)))
        c, s = np.cos(angle), np.sin(angle)
        T = np.eye(3)
        T[:2, :2] = np.array([[c, -s], [s, c]]) * np.asarray(number("scale", (1.0, 1.0)), float)
        T[:2, 2] = number("translation", (0.0, 0.0))
        return T


@dataclass(frozen=True)
class _Primvar:
    name: str


def _identifier(shader: Any) -> str:
    identifier = shader.GetIdAttr().Get() or shader.GetSourceAssetSubIdentifier("mdl")
    return str(identifier or shader.GetImplementationSource() or "")


def _number(source: Any, default: float, key: str) -> tuple[float, ...]:
    """Return the factor of an input: a constant, or the scale of its picture."""
    if isinstance(source, UsdPicture):
        values: Any = source.scale["rgba".index(source.channel)] if len(source.channel) == 1 else source.scale[:3]
    else:
        values = default if source is None or isinstance(source, _Primvar) else source
    width = 3 if key in ("diffuseColor", "emissiveColor") else 1
    numbers = np.resize(np.nan_to_num(np.asarray(values, np.float64)).reshape(-1), width)
    return tuple(float(v) for v in np.clip(numbers, 0, None if key == "emissiveColor" else 1))


def _channel(p: UsdPicture | None, of_three: str = "r") -> Channel | None:
    return None if p is None else Channel(p.texture, of_three if p.channel == "rgb" else p.channel)
