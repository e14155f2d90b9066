"""Materials of a glTF 2.0 file: pictures with samplers, coordinates of their own, and the material extensions.

Extensions that metallic-roughness cannot express are named in one warning: docs/formats.md says which.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float32

from anymesh.errors import InputError
from anymesh.formats.gltf.buffers import Buffers, from_uri, item
from anymesh.formats.gltf.gloss_ import from_gloss
from anymesh.loading.files import Folder, picture, picture_file, warn_unreadable
from anymesh.names import listed
from anymesh.types import Material, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT

WRAP = {33071: CLAMP, 33648: MIRROR}
NEAREST = 9728  # magFilter
MAX_SETS = 4  # of texture coordinates per material; what a viewer reads
CLEAREST = 0.25  # opacity of a surface that transmits all light: it stays visible
UNLIT, TRANSMISSION, STRONG = (f"KHR_materials_{name}" for name in ("unlit", "transmission", "emissive_strength"))
GLOSS = "KHR_materials_pbrSpecularGlossiness"
READ = (UNLIT, TRANSMISSION, STRONG, GLOSS)
LEFT_OUT: Mapping[str, Mapping[str, Any]] = {  # extension -> what it says when it changes nothing
    "KHR_materials_anisotropy": {"anisotropyStrength": 0},
    "KHR_materials_clearcoat": {"clearcoatFactor": 0},
    "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0},
    "KHR_materials_dispersion": {"dispersion": 0},
    "KHR_materials_ior": {"ior": 1.5},
    "KHR_materials_iridescence": {"iridescenceFactor": 0},
    "KHR_materials_sheen": {"sheenColorFactor": [0, 0, 0]},
    "KHR_materials_specular": {
        "specularFactor": 1,
        "specularColorFactor": [1, 1, 1],
        "specularTexture": None,
        "specularColorTexture": None,
    },
    "KHR_materials_volume": {"thicknessFactor": 0},
}


@dataclass(frozen=True)
class GltfMaterial:
    """A material, and by uv_set of its pictures the number of TEXCOORD_ and the KHR_texture_transform."""

    material: Material | None
    sets: tuple[tuple[int, tuple[float, ...]], ...] = ((0, (0.0, 0.0, 0.0, 1.0, 1.0)),)

    def coordinates(self, read: Callable[[str], np.ndarray | None]) -> tuple[np.ndarray | None, np.ndarray | None]:
        """Return the corner_uv and corner_more_uv of each vertex, v upwards; None where there are none. read: an attribute."""
        placed = [_placed(read(f"TEXCOORD_{number}"), transform) for number, transform in self.sets]
        size = next((len(uv) for uv in placed if uv is not None), None)
        if size is None:
            return None, None
        first, *more = (np.zeros((size, 2), np.float32) if uv is None else uv for uv in placed)
        return first, np.hstack(more) if more else None


def _placed(uv: np.ndarray | None, transform: tuple[float, ...]) -> Float32[np.ndarray, "n 2"] | None:
    if uv is None:
        return None
    uv = np.nan_to_num(np.asarray(uv, np.float64)[:, :2])
    if transform != (0, 0, 0, 1, 1):
        x, y, angle, *scale = transform
        c, s = np.cos(angle), np.sin(angle)
        uv = (uv * scale) @ np.array([[c, -s], [s, c]]) + (x, y)
    return np.stack([uv[:, 0], 1 - uv[:, 1]], 1).astype(np.float32)


def read_materials(tree: dict[str, Any], buffers: Buffers, folder: Folder) -> list[GltfMaterial]:
    """Return the materials in the order of the file; what is missing, broken or left out gives a warning."""
    images = [_image(k, image, buffers, folder) for k, image in enumerate(tree.get("images", []))]
    pictures = _Pictures(tree, images, folder)
    materials = tree.get("materials", [])
    read = [_material(k, m, pictures) for k, m in enumerate(materials)]
    left = Counter(name for m in materials for name in sorted(m.get("extensions", {})) if _changes(name, m["extensions"][name]))
    if left:
        named = ", ".join(f"{name} of {count}" for name, count in sorted(left.items()))
        folder.warn(f"what {named} of {len(materials)} materials adds to their look is left out")
    primitives = [p for mesh in tree["meshes"] for p in mesh.get("primitives", ())]
    if any(key.startswith("COLOR_") and key != "COLOR_0" for p in primitives for key in p.get("attributes", ())):
        folder.warn("further vertex colours (COLOR_1) are left out; COLOR_0 counts")
    missing = sum(not 0 <= p.get("material", 0) < max(len(materials), "material" not in p) for p in primitives)
    if missing:
        folder.warn(f"{missing} of {len(primitives)} primitives refer to a material that the file does not hold, and have none")
    variants = tree.get("extensions", {}).get("KHR_materials_variants", {}).get("variants", [])
    if variants:
        named = ", ".join(repr(str(v.get("name", ""))) for v in variants[:9])
        folder.warn(f"of {len(variants)} material variants ({named}) none is used, but the look that the file shows at first")
    used = {p.get("material") for p in primitives}
    unseen = [m.material.name for k, m in enumerate(read) if k in used and m.material is not None and m.material.opacity <= 0]
    if unseen:
        folder.warn(f"invisible by the alpha of its material, as the file states: {listed(unseen, 4)}")
    return read


def _changes(name: str, extension: Any) -> bool:
    """Return whether an extension that is left out changes the look."""
    if name in READ or not isinstance(extension, dict):
        return False
    return name not in LEFT_OUT or any(extension.get(key, plain) != plain for key, plain in LEFT_OUT[name].items())


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


class _Pictures:
    """The textures of a document, with their samplers."""

    def __init__(self, tree: dict[str, Any], images: list[Texture | None], folder: Folder) -> None:
        self._textures, self._samplers, self._images = tree.get("textures", []), tree.get("samplers", []), images
        self.folder = folder

    def get(self, info: dict[str, Any] | None) -> Texture | None:
        """Return the picture that a textureInfo means; None, with a warning if it refers to nothing."""
        if info is None:
            return None
        try:
            texture = item(self._textures, info["index"])
            extended = [e["source"] for e in texture.get("extensions", {}).values() if isinstance(e, dict) and "source" in e]
            sources = [*extended, *([texture["source"]] if "source" in texture else [])]
            image = next((i for s in sources if (i := item(self._images, s)) is not None), None)
            sampler = item(self._samplers, texture["sampler"]) if "sampler" in texture else {}
        except LookupError as error:
            self.folder.warn(f"a picture is left out: its material refers to no texture, image or sampler ({error})")
            return None
        if image is None:
            return None
        wrap = tuple(WRAP.get(sampler.get(key), REPEAT) for key in ("wrapS", "wrapT"))
        strength = float(info.get("scale", info.get("strength", 1.0)))
        nearest = sampler.get("magFilter") == NEAREST
        return replace(image, wrap=wrap, strength=strength if np.isfinite(strength) else 1.0, nearest=nearest)


def _material(number: int, m: dict[str, Any], pictures: _Pictures) -> GltfMaterial:
    pbr, extensions = m.get("pbrMetallicRoughness", {}), m.get("extensions", {})
    infos = {
        "base_color": pbr.get("baseColorTexture"),
        "metallic_roughness": pbr.get("metallicRoughnessTexture"),
        "normal": m.get("normalTexture"),
        "occlusion": m.get("occlusionTexture"),
        "emissive": m.get("emissiveTexture"),
    }
    old = extensions.get(GLOSS)
    if old is not None:
        infos |= {"base_color": old.get("diffuseTexture"), "metallic_roughness": old.get("specularGlossinessTexture")}
    textures = {slot: t for slot, info in infos.items() if (t := pictures.get(info)) is not None}
    name = str(m.get("name") or f"material_{number}")
    sets, placed = _coordinates(name, {slot: infos[slot] or {} for slot in textures}, pictures.folder)
    textures = {slot: replace(t, uv_set=placed[slot]) for slot, t in textures.items() if slot in placed}
    mode, cutoff = m.get("alphaMode", "OPAQUE"), float(m.get("alphaCutoff", 0.5))
    strong = float(np.nan_to_num(extensions.get(STRONG, {}).get("emissiveStrength", 1.0), posinf=1.0))
    material = Material(
        name=name,
        base_color=_factor(pbr.get("baseColorFactor"), 4),
        metallic=_factor([pbr.get("metallicFactor", 1.0)], 1)[0],
        roughness=_factor([pbr.get("roughnessFactor", 1.0)], 1)[0],
        emissive=tuple(max(strong, 0.0) * v for v in _factor(m.get("emissiveFactor", (0.0, 0.0, 0.0)), 3)),
        double_sided=bool(m.get("doubleSided", False)),
        alpha_mode=mode if mode in ("OPAQUE", "MASK", "BLEND") else "OPAQUE",
        alpha_cutoff=cutoff if np.isfinite(cutoff) else 0.5,
        textures=textures,
    )
    if old is not None:
        specular = _factor(old.get("specularFactor"), 3) if "specularFactor" in old else None
        gloss = _factor([old.get("glossinessFactor", 1.0)], 1)[0]
        material = from_gloss(material, _factor(old.get("diffuseFactor"), 4), specular, gloss)
    if UNLIT in extensions:
        kept = {slot: t for slot, t in material.textures.items() if slot == "base_color"}
        material = replace(material, metallic=0.0, roughness=1.0, emissive=(0.0, 0.0, 0.0), textures=kept, unlit=True)
    clear = extensions.get(TRANSMISSION, {})
    amount, mask = _factor([clear.get("transmissionFactor", 0.0)], 1)[0], pictures.get(clear.get("transmissionTexture"))
    if mask is not None:
        amount *= float(mask.pixels()[..., 0].mean() / 255)
    return GltfMaterial(_transmitting(material, amount) if amount > 0 else material, sets)


def _coordinates(name: str, infos: Mapping[str, dict[str, Any]], folder: Folder) -> tuple[tuple, dict[str, int]]:
    """Return the sets of coordinates of a material's pictures, those of the first one first, and the set of each slot."""
    sets: list[tuple[int, tuple[float, ...]]] = []
    placed = {}
    for slot, info in infos.items():
        moved = info.get("extensions", {}).get("KHR_texture_transform", {})
        transform = (*moved.get("offset", (0, 0)), moved.get("rotation", 0), *moved.get("scale", (1, 1)))
        where = (
            int(moved.get("texCoord", info.get("texCoord", 0))),
            tuple(np.nan_to_num(np.array(transform, np.float64)).tolist()),
        )
        if where not in sets and len(sets) == MAX_SETS:
            folder.warn(f"the {slot} picture of material {name!r} is left out: at most {MAX_SETS} sets of coordinates are kept")
            continue
        sets += [where] if where not in sets else []
        placed[slot] = sets.index(where)
    return tuple(sets) or GltfMaterial(None).sets, placed


def _transmitting(material: Material, amount: float) -> Material:
    """Return a material that lets light through as one with an opacity."""
    textures, opacity = dict(material.textures), material.opacity
    base = textures.get("base_color")
    if material.alpha_mode == "OPAQUE" and base is not None:  # its alpha did not count, and still does not
        textures["base_color"] = base.painted(base.pixels()[..., :3])
    color = (*material.base_color[:3], opacity * (1 - (1 - CLEAREST) * amount))
    return replace(material, base_color=color, alpha_mode="BLEND", textures=textures)


def _factor(values: Any, width: int) -> Any:
    """Return numbers clipped to 0..1; 1 for those that are missing."""
    if values is None:
        return (1.0,) * width
    v = np.nan_to_num(np.r_[np.asarray(values, np.float64).reshape(-1), np.ones(width)][:width], nan=1.0)
    return tuple(float(x) for x in np.clip(v, 0, 1))
