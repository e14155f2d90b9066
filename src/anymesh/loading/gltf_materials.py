"""Materials of a glTF 2.0 file: their pictures, and the texture coordinates of each picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float32

from anymesh.errors import InputError
from anymesh.loading.files import Folder, picture, picture_file, warn_unreadable
from anymesh.loading.gltf_data import Buffers, from_uri
from anymesh.types import Material, Texture


@dataclass(frozen=True)
class GltfMaterial:
    """A material, and the texture coordinates of its pictures: by uv_set, the number of TEXCOORD_ and KHR_texture_transform."""

    material: Material | None
    sets: tuple[tuple[int, dict[str, Any]], ...] = ((0, {}),)

    def coordinates(self, read: Callable[[str], np.ndarray | None]) -> tuple[np.ndarray | None, np.ndarray | None]:
        """Return the corner_uv and corner_more_uv of each vertex, v upwards; None where there are none. read: an attribute."""
        first, *more = (_placed(read(f"TEXCOORD_{number}"), transform) for number, transform in self.sets)
        if not more:
            return first, None
        size = next((len(uv) for uv in (first, *more) if uv is not None), None)
        if size is None:
            return None, None
        first, *more = (np.zeros((size, 2), np.float32) if uv is None else uv for uv in (first, *more))
        return first, np.hstack(more)


def _placed(uv: np.ndarray | None, transform: dict[str, Any]) -> Float32[np.ndarray, "n 2"] | None:
    if uv is None:
        return None
    uv = np.nan_to_num(np.asarray(uv, np.float64)[:, :2])
    if transform:
        angle = float(transform.get("rotation", 0.0))
        c, s = np.cos(angle), np.sin(angle)
        uv = (uv * transform.get("scale", (1, 1))) @ np.array([[c, -s], [s, c]]) + transform.get("offset", (0, 0))
    return np.stack([uv[:, 0], 1 - uv[:, 1]], 1).astype(np.float32)


def read_materials(tree: dict[str, Any], buffers: Buffers, folder: Folder) -> list[GltfMaterial]:
    """Return the materials in the order of the file; a missing or broken picture gives a warning."""
    images = [_image(k, image, buffers, folder) for k, image in enumerate(tree.get("images", []))]
    return [_material(k, m, tree.get("textures", []), images) for k, m in enumerate(tree.get("materials", []))]


def _image(number: int, image: dict[str, Any], buffers: Buffers, folder: Folder) -> Texture | None:
    uri, name = image.get("uri"), str(image.get("name") or f"image_{number}")
    if uri is not None and not uri.startswith("data:"):
        return picture_file(folder, uri)
    try:
        data = buffers.view(image["bufferView"]) if uri is None else from_uri(uri, folder)
    except (InputError, LookupError, TypeError) as error:  # a picture is optional
        warn_unreadable(folder, name, error)
        return None
    return picture(folder, data, name)


def _material(number: int, m: dict[str, Any], textures: list[dict[str, Any]], images: list[Texture | None]) -> GltfMaterial:
    pbr, extensions = m.get("pbrMetallicRoughness", {}), m.get("extensions", {})
    color, base = pbr.get("baseColorFactor"), pbr.get("baseColorTexture")
    metallic, roughness = pbr.get("metallicFactor", 1.0), pbr.get("roughnessFactor", 1.0)
    old = extensions.get("KHR_materials_pbrSpecularGlossiness")
    if old is not None:  # an archived extension; its colour and gloss have counterparts
        color, base = old.get("diffuseFactor", color), old.get("diffuseTexture", base)
        metallic, roughness = 0.0, 1.0 - float(old.get("glossinessFactor", 1.0))
    named = {
        "base_color": base,
        "metallic_roughness": pbr.get("metallicRoughnessTexture"),
        "normal": m.get("normalTexture"),
        "occlusion": m.get("occlusionTexture"),
        "emissive": m.get("emissiveTexture"),
    }
    slot_textures = {slot: _texture(info, textures, images) for slot, info in named.items() if info is not None}
    mode, cutoff = m.get("alphaMode", "OPAQUE"), float(m.get("alphaCutoff", 0.5))
    material = Material(
        name=str(m.get("name") or f"material_{number}"),
        base_color=_factor(color, 4),
        metallic=_factor([metallic], 1)[0],
        roughness=_factor([roughness], 1)[0],
        emissive=_factor(m.get("emissiveFactor", (0.0, 0.0, 0.0)), 3),
        double_sided=bool(m.get("doubleSided", False)),
        alpha_mode=mode if mode in ("OPAQUE", "MASK", "BLEND") else "OPAQUE",
        alpha_cutoff=cutoff if np.isfinite(cutoff) else 0.5,
        textures={slot: t for slot, t in slot_textures.items() if t is not None},
    )
    main = base or next((info for info in named.values() if info is not None), {})
    moved = main.get("extensions", {}).get("KHR_texture_transform")
    return GltfMaterial(material, (((moved or {}).get("texCoord", main.get("texCoord", 0)), moved or {}),))


def _texture(info: dict[str, Any], textures: list[dict[str, Any]], images: list[Texture | None]) -> Texture | None:
    texture = textures[info["index"]]
    extended = [e["source"] for e in texture.get("extensions", {}).values() if isinstance(e, dict) and "source" in e]
    sources = [texture["source"]] if "source" in texture else []
    return next((images[s] for s in (*extended, *sources) if images[s] is not None), None)


def _factor(values: Any, width: int) -> Any:
    """Return numbers clipped to 0..1; 1 if there are none."""
    if values is None:
        return (1.0,) * width
    v = np.nan_to_num(np.asarray(values, np.float64).reshape(width), nan=1.0)
    return tuple(float(x) for x in np.clip(v, 0, 1))
