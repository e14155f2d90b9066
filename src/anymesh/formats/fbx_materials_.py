"""Materials of FBX: Lambert and Phong, and the physically based ones of Maya, 3ds Max, Blender and Arnold."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from anymesh.formats.pictures_ import Channel, has_alpha, is_normal_map, merged
from anymesh.loading.files import Folder, picture
from anymesh.types import Material, Texture
from anymesh.types.mesh import CLAMP, REPEAT, to_linear

CLASSIC = ("UNKNOWN", "FBX_LAMBERT", "FBX_PHONG")  # their colours are those of the screen
Coordinates = tuple[str, tuple[float, ...] | None]  # name of a UV set, and the 6 numbers of its (2, 3) transform


def elements(listed: Any) -> list[Any]:
    """Return the objects of a list of ufbx.

    Up to 0.0.5 an access to an item does not count its reference, so that the object is freed while it is used. It is counted
    here; with a version that counts too, objects live until the process ends.
    """
    objects = []
    for k in range(len(listed)):
        one = listed[k]
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(one))
        objects.append(one)
    return objects


@dataclass(frozen=True)
class FbxLook:
    """A material, and its texture coordinates by uv_set of its pictures."""

    material: Material
    sets: tuple[Coordinates, ...] = ()


class FbxMaterials:
    """Reads each material and each picture once."""

    def __init__(self, ufbx: Any, scene: Any, folder: Folder) -> None:
        self._ufbx, self._folder = ufbx, folder
        self._linear = "BLENDER" in str(scene.metadata.exporter.name)  # whose colours are linear
        self._looks: dict[int, FbxLook] = {}
        self._pictures: dict[str, Texture | None] = {}

    def read(self, material: Any) -> FbxLook:
        """Return a material; a missing or broken picture gives a warning."""
        key = int(material.typed_id)
        if key not in self._looks:
            self._looks[key] = self._read(material)
        return self._looks[key]

    def _read(self, m: Any) -> FbxLook:
        pbr, fbx = m.pbr, m.fbx
        classic = m.shader_type.name in CLASSIC
        linear = self._linear or not classic
        chosen: dict[str, tuple[Any, Texture]] = {}
        for slot, maps in {
            "base": (pbr.base_color, fbx.diffuse_color), "metallic": (pbr.metalness,), "roughness": (pbr.roughness,),
            "gloss": (pbr.glossiness,), "normal": (pbr.normal_map, fbx.normal_map), "bump": (fbx.bump,),
            "occlusion": (pbr.ambient_occlusion,), "emissive": (pbr.emission_color, fbx.emission_color),
            "opacity": (pbr.opacity, fbx.transparency_color, fbx.transparency_factor),
        }.items():  # fmt: skip
            for one in maps:
                image = self._file(one.texture) if one.texture is not None and one.texture_enabled else None
                if image is not None and (texture := self._texture(image)) is not None:
                    chosen.setdefault(slot, (image, texture))
        if "bump" in chosen:
            bump = chosen.pop("bump")
            if is_normal_map(bump[1]):
                chosen.setdefault("normal", bump)
            else:
                self._folder.warn("bump pictures (heights) are left out; normal maps are read")
        if fbx.displacement.texture is not None or pbr.displacement_map.texture is not None:
            self._folder.warn("displacement of materials is left out")
        color = np.ones(3) if "base" in chosen else self._color(pbr.base_color, pbr.base_factor, (0.7, 0.7, 0.7))
        emission = np.ones(3) if "emissive" in chosen else self._color(pbr.emission_color, pbr.emission_factor, (0.0, 0.0, 0.0))
        if not linear:
            color, emission = to_linear(color), to_linear(emission)
        alpha = self._alpha(m, classic)
        return self._assembled(m, chosen, color, emission, alpha)

    def _assembled(
        self, m: Any, chosen: dict[str, tuple[Any, Texture]], color: np.ndarray, emission: np.ndarray, alpha: float
    ) -> FbxLook:
        base, opacity = chosen.get("base"), chosen.get("opacity")
        rough, metal, gloss = chosen.get("roughness"), chosen.get("metallic"), chosen.get("gloss")
        textures: dict[str, tuple[Any, Texture]] = {}
        mode = "BLEND" if alpha < 1 else "OPAQUE"
        if opacity is not None and opacity[1].data == (base[1].data if base else b""):
            textures["base_color"], mode = base or opacity, "BLEND"
        elif opacity is not None:
            mask = Channel(opacity[1], "a" if has_alpha(opacity[1]) else "r")
            joined = merged(base[1] if base else None, a=mask)
            textures["base_color"], mode = ((base or opacity)[0], joined), "BLEND"
        elif base is not None:
            textures["base_color"] = base
        leader = rough or gloss or metal
        if leader is not None:
            shine = Channel(rough[1]) if rough else Channel(gloss[1], inverted=True) if gloss else None
            joined = merged(None, g=shine, b=Channel(metal[1]) if metal else None)
            textures["metallic_roughness"] = (leader[0], joined)
        textures |= {slot: chosen[slot] for slot in ("normal", "occlusion", "emissive") if slot in chosen}
        sets: list[Coordinates] = []
        placed = {}
        for slot, (image, texture) in textures.items():
            where = self._coordinates(image)
            sets += [where] if where not in sets else []
            wrap = tuple(CLAMP if w.name == "CLAMP" else REPEAT for w in (image.wrap_u, image.wrap_v))
            placed[slot] = replace(texture, wrap=(wrap[0], wrap[1]), uv_set=sets.index(where))
        red, green, blue = (float(c) for c in np.clip(color, 0, 1))
        glow = tuple(float(c) for c in np.clip(emission, 0, None))
        roughness = 1.0 if rough or gloss else self._number(m.pbr.roughness, 0.8)
        material = Material(
            name=str(m.name) or f"material_{m.typed_id}", base_color=(red, green, blue, alpha),
            metallic=1.0 if metal else self._number(m.pbr.metalness, 0.0), roughness=roughness,
            emissive=(glow[0], glow[1], glow[2]), alpha_mode=mode, textures=placed,
        )  # fmt: skip
        return FbxLook(material, tuple(sets))

    def _color(self, value: Any, factor: Any, default: Sequence[float]) -> np.ndarray:
        stated = np.array(value.value_vec4, np.float64)[:3] if value.has_value else np.array(default, np.float64)
        return np.nan_to_num(stated) * (self._number(factor, 1.0, None) if factor.has_value else 1.0)

    def _number(self, value: Any, default: float, most: float | None = 1.0) -> float:
        stated = float(value.value_vec4[0]) if value.has_value else default
        return float(np.clip(stated if np.isfinite(stated) else default, 0, most))

    def _alpha(self, m: Any, classic: bool) -> float:
        """Return the opacity; writers disagree on what 0 and 1 mean, so a wholly transparent material is opaque."""
        if classic:
            amount = (
                np.array(m.fbx.transparency_color.value_vec4, np.float64)[:3].mean()
                if m.fbx.transparency_color.has_value
                else 1.0
            )
            amount *= float(m.fbx.transparency_factor.value_vec4[0]) if m.fbx.transparency_factor.has_value else 0.0
            stated = self._ufbx.find_prop(m.props, "Opacity")
            alpha = 1 - amount if stated is None else float(stated.value_vec4[0])
        else:
            alpha = float(
                np.array(m.pbr.opacity.value_vec4, np.float64)[: max(1, min(3, m.pbr.opacity.value_components))].mean()
            )
            alpha = alpha if m.pbr.opacity.has_value and m.pbr.opacity.texture is None else 1.0
            clear = m.pbr.transmission_factor
            if clear.has_value and self._number(clear, 0.0) > 0:
                alpha = min(alpha, 1 - self._number(clear, 0.0))
        if not 0 < alpha <= 1:
            if np.isfinite(alpha) and alpha <= 0:
                self._folder.warn(f"material {str(m.name)!r} is wholly transparent in the file; it is taken for opaque")
            return 1.0
        return float(alpha)

    def _file(self, texture: Any) -> Any:
        """Return the picture of a texture: its own, or the first of its layers."""
        files = elements(texture.file_textures)
        if texture.type.name != "FILE" and len(files) > 1:
            self._folder.warn("textures of several layers: the first picture of each is used")
        return texture if texture.type.name == "FILE" else files[0] if files else None

    def _texture(self, image: Any) -> Texture | None:
        content = bytes(image.content) or (bytes(image.video.content) if image.video is not None else b"")
        names = [str(n) for n in (image.relative_filename, image.filename, image.absolute_filename) if n]
        name = names[0] if names else str(image.name) or f"texture_{image.typed_id}"
        key = f"{image.typed_id}" if content else name
        if key not in self._pictures:
            if content:
                self._pictures[key] = picture(self._folder, content, name)
            else:
                there = next((n for n in names if self._folder.find(n) is not None), name)
                data = self._folder.read_or_warn(there, "texture")
                self._pictures[key] = None if data is None else picture(self._folder, data, there)
        return self._pictures[key]

    def _coordinates(self, image: Any) -> Coordinates:
        if not image.has_uv_transform:
            return str(image.uv_set), None
        m = image.uv_to_texture
        numbers = np.array([[m.c0.x, m.c1.x, m.c3.x], [m.c0.y, m.c1.y, m.c3.y]], np.float64)
        usable = np.isfinite(numbers).all()
        return str(image.uv_set), tuple(numbers.reshape(-1).tolist()) if usable else None
