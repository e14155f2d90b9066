"""Materials of COLLADA: colours are sRGB and are converted to linear; pictures stay as the bytes of their files.

What is see-through follows COLLADA 1.5 ("Determining Transparency"). A material that no one could see is a mistake of writers
that invert these values, and is drawn opaque.
"""

from __future__ import annotations

import binascii
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from anymesh.formats.dae.geometry import Find, floats
from anymesh.loading.files import SHOWN, Folder, picture, picture_file
from anymesh.types import Brief, Material, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT, to_linear

SHADERS = ("phong", "blinn", "lambert", "constant")
LUMINANCE = np.array([0.212671, 0.715160, 0.072169])  # of COLLADA's specification
INVISIBLE = 0.01  # opacity
NOT_DRAWN = ("ambient", "specular", "reflective", "shininess", "reflectivity", "transparency")  # pictures without counterpart
BUMPS = ("bump", "normal", "normalmap")
WRAPS = {"MIRROR": MIRROR, "CLAMP": CLAMP, "BORDER": CLAMP, "NONE": CLAMP}


@dataclass(frozen=True)
class DaeMaterial:
    """A material. places: slot of a picture -> name of its texture coordinates, and by what these are repeated and moved."""

    material: Material | None
    places: Mapping[str, tuple[str, tuple[float, float], tuple[float, float]]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _Value(Brief):
    """A colour (RGBA), or a picture of a shader and its element, which also is there for a picture that cannot be read."""

    color: np.ndarray | None = None
    texture: Texture | None = None
    element: ET.Element | None = None


class DaeMaterials:
    """The materials of a document. find: an element by tag and URL."""

    def __init__(self, find: Find, root: ET.Element, folder: Folder) -> None:
        self._find, self._folder = find, folder
        self._made: dict[int, DaeMaterial] = {}
        self._pictures: dict[str, Texture | None] = {}
        self._inverted = any(_states_invisible(effect) for effect in root.iter("effect"))
        if self._inverted:
            folder.warn("some materials are invisible as written, by a common mistake of exporters; they are drawn visible")

    def of(self, element: ET.Element) -> DaeMaterial:
        """Return the material of a <material>; grey, with a warning, if its effect cannot be read."""
        if id(element) not in self._made:
            self._made[id(element)] = self._look(element)
        return self._made[id(element)]

    def _look(self, element: ET.Element) -> DaeMaterial:
        name = element.get("name") or element.get("id") or "material"
        instance = element.find("instance_effect")
        effect = None if instance is None else self._find("effect", instance.get("url"))
        technique = None if effect is None else effect.find("profile_COMMON/technique")
        shader = next((s for t in (technique,) if t is not None for s in t if s.tag in SHADERS), None)
        if instance is None or effect is None or technique is None or shader is None:
            self._folder.warn(f"the material {name[:SHOWN]!r} has no common profile, and is drawn grey")
            return DaeMaterial(Material(name))
        params = {p.get("sid", ""): p for p in effect.iter("newparam")}
        params |= {p.get("ref", ""): p for p in instance.findall("setparam")}
        values = {child.tag: self._value(child, params) for child in shader}
        for bump in (b for b in effect.iter() if b.tag in BUMPS and b.find("texture") is not None):
            if "HEIGHT" in bump.get("bumptype", ""):
                self._folder.warn("pictures of heights (bump maps) are left out")
            else:
                values["bump"] = self._value(bump, params)
        left = [tag for tag in NOT_DRAWN if (v := values.get(tag)) is not None and v.element is not None]
        if left:
            self._folder.warn(f"pictures of {', '.join(left)} are left out")
        double_sided = any((e.text or "").strip() in ("1", "true") for e in effect.iter("double_sided"))
        return self._drawn(name, shader, values, double_sided)

    def _drawn(self, name: str, shader: ET.Element, values: dict[str, _Value], double_sided: bool) -> DaeMaterial:
        constant = shader.tag == "constant" and "diffuse" not in values  # light that does not change: its colour is the base
        base = values.get("emission" if constant else "diffuse", _Value())
        glow = _Value() if constant else values.get("emission", _Value())
        bump = values.get("bump", _Value())
        transparent = values.get("transparent", _Value())
        opacity = 1.0 if transparent.element is not None else opacity_of(shader)
        if opacity <= INVISIBLE:
            opacity = 1.0
        elif self._inverted and shader.find("transparency") is not None and _mode(shader) == "A_ONE":
            opacity = 1.0 - opacity if opacity < 1.0 else 1.0
        seen_through = opacity < 1
        if transparent.element is not None:
            same = base.texture is not None and transparent.texture == base.texture
            seen_through = same and _mode(shader) == "A_ONE"
            if not seen_through:
                self._folder.warn("pictures of transparency that are not in the base colour's own are left out")
        shine = values.get("shininess", _Value()).color
        rough = float(np.sqrt(2 / (2 + max(shine[0], 0.0)))) if shine is not None and np.isfinite(shine[0]) else 1.0
        used = {"base_color": base, "emissive": glow, "normal": bump}
        lit = (1.0, 1.0, 1.0) if glow.texture is not None else (0.0, 0.0, 0.0)
        material = Material(
            name,
            base_color=(*_linear(base, (1.0, 1.0, 1.0)), opacity),
            emissive=_linear(glow, lit),
            roughness=rough,
            double_sided=double_sided,
            alpha_mode="BLEND" if seen_through else "OPAQUE",
            textures={slot: v.texture for slot, v in used.items() if v.texture is not None},
            unlit=constant,
        )
        places = {slot: _place(v.element) for slot, v in used.items() if v.texture is not None and v.element is not None}
        return DaeMaterial(material, places)

    def _value(self, channel: ET.Element, params: Mapping[str, ET.Element]) -> _Value:
        """Return the picture of a channel if it can be read, else its colour or number."""
        color, shown = None, _Value()
        for child in channel:
            if child.tag == "param":
                child = next((c for c in params.get(child.get("ref", ""), ()) if c.tag.startswith(("float", "color"))), child)
            if child.tag == "texture":
                shown = self._texture(child, params)
            elif child.tag in ("color", "float", "float2", "float3", "float4"):
                numbers = floats(child.text or "")
                color = numbers if len(numbers) and np.isfinite(numbers).all() else color
        return _Value(color, shown.texture, shown.element)

    def _texture(self, element: ET.Element, params: Mapping[str, ET.Element]) -> _Value:
        name, wrap = element.get("texture", ""), (REPEAT, REPEAT)
        param = params.get(name, params.get(f"{name}-sampler"))  # the second as some robots' meshes are written
        sampler = None if param is None else next((c for c in param if c.tag.lower().startswith("sampler")), None)
        if sampler is not None:
            u, v = (WRAPS.get((sampler.findtext(tag) or "WRAP").strip(), REPEAT) for tag in ("wrap_s", "wrap_t"))
            wrap, instance = (u, v), sampler.find("instance_image")  # the latter in COLLADA 1.5
            name = (sampler.findtext("source") or "").strip() if instance is None else instance.get("url", "")
            param = params.get(name)
        if param is not None:
            name = (param.findtext("surface/init_from") or "").strip() or name
        image = self._find("image", name)
        if image is None and "." not in name:  # with a dot, some exporters write the file's name
            self._folder.warn(f"the picture {name[:SHOWN]!r} of a material is not in the file, and is left out")
            return _Value(None, None, element)
        texture = self._file(name) if image is None else self._picture(image)
        return _Value(None, None if texture is None else replace(texture, wrap=wrap), element)

    def _picture(self, image: ET.Element) -> Texture | None:
        start = image.find("init_from")
        holder = image.find("data") if start is None else start.find("hex")
        if holder is None:
            return self._file(("" if start is None else start.findtext("ref") or start.text or "").strip())
        try:
            data = binascii.unhexlify("".join((holder.text or "").split()))
        except (binascii.Error, ValueError):
            data = b""
        return picture(self._folder, data, image.get("name") or image.get("id") or "image")

    def _file(self, uri: str) -> Texture | None:
        if uri not in self._pictures:
            self._pictures[uri] = picture_file(self._folder, uri)
        return self._pictures[uri]


def _place(texture: ET.Element) -> tuple[str, tuple[float, float], tuple[float, float]]:
    """Return the name of a picture's coordinates, and by what they are repeated and moved (an extra of Maya)."""
    sizes = {e.tag: float(floats(e.text or "", 0.0)[0]) for e in texture.iter() if e is not texture}
    repeat = (sizes.get("repeatU") or 1.0, sizes.get("repeatV") or 1.0)
    return texture.get("texcoord", ""), repeat, (sizes.get("offsetU", 0.0), sizes.get("offsetV", 0.0))


def _mode(shader: ET.Element) -> str:
    transparent = shader.find("transparent")
    return "A_ONE" if transparent is None else transparent.get("opaque", "A_ONE")


def opacity_of(shader: ET.Element) -> float:
    """Return the opacity 0..1 of a shader without pictures of it, as written; see COLLADA 1.5, "Determining Transparency"."""
    if shader.find("transparent") is None and shader.find("transparency") is None:
        return 1.0
    color = floats(shader.findtext("transparent/color") or "")
    color = color if len(color) in (3, 4) and np.isfinite(color).all() else np.ones(4)
    amount = float(floats(shader.findtext("transparency/float") or "", 1.0)[0])
    alpha, bright = (color[3] if len(color) == 4 else 1.0) * amount, float(color[:3] @ LUMINANCE) * amount
    written = {"A_ONE": alpha, "A_ZERO": 1 - alpha, "RGB_ZERO": 1 - bright, "RGB_ONE": bright}
    return float(np.clip(written.get(_mode(shader), alpha), 0, 1))


def _states_invisible(effect: ET.Element) -> bool:
    shaders = [s for tag in SHADERS for s in effect.iter(tag)]
    return any(s.find("transparent/texture") is None and opacity_of(s) <= INVISIBLE for s in shaders)


def _linear(value: _Value, default: tuple[float, float, float]) -> tuple[float, float, float]:
    if value.color is None or value.texture is not None:
        return (1.0, 1.0, 1.0) if value.texture is not None else default
    r, g, b = to_linear(value.color[:3] if len(value.color) > 2 else np.repeat(value.color[0], 3)).tolist()
    return (r, g, b)
