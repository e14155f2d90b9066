"""MTL: the material libraries of OBJ files, with the fields for metallic-roughness that Blender and others write.

Colours are sRGB by convention and become linear. What lights specularly (Ka, Ks, Ns, Ni, Tf, illum) has no counterpart.
"""

from __future__ import annotations

import io
import math
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

from anymesh.formats.polygons_ import with_points
from anymesh.loading.files import Folder, picture_file, quiet_decoder
from anymesh.loading.references import readable
from anymesh.types import Material, Texture
from anymesh.types.mesh import CLAMP, to_linear

SLOTS = {"map_kd": "base_color", "map_ke": "emissive", **dict.fromkeys(("norm", "map_kn", "bump", "map_bump"), "normal")}
HEIGHTS = ("bump", "map_bump")  # pictures of heights, or of normals
PICTURES = {*SLOTS, "map_d", "map_pr", "map_pm"}
OTHERS = {"disp", "decal", "refl", "pc", "pcr", "ps", "aniso", "anisor"}  # with every other map_...: named in a warning
OPTIONS = {"-mm": 2, "-o": 3, "-s": 3, "-t": 3} | dict.fromkeys(  # of a picture: the number of values
    ("-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type", "-colorspace"), 1
)
PLAIN = {"-mm": [0.0, 1.0], "-t": [0.0, 0.0, 0.0]}  # options that are not read, with the values that change nothing
CHANNELS = {"r": "R", "g": "G", "b": "B", "m": "A"}  # of -imfchan
XYZ_TO_RGB = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.204, 1.057]])  # IEC 61966-2-1
BLACK = 0.02 / 12.92  # linear
SHARP = (32, 223, 0.95)  # share of texels nearer to black or white than that, from which a mask cuts out
SOLE = ((1.0, 1.0), (0.0, 0.0))

Placement = tuple[tuple[float, float], tuple[float, float]]  # -s and -o of a picture: u, v are scaled, then moved


@dataclass(frozen=True)
class MtlMaterial:
    """A material, and by the uv_set of its pictures how their texture coordinates follow from those of the OBJ."""

    material: Material
    sets: tuple[Placement, ...] = (SOLE,)


def read_mtl(data: bytes, folder: Folder) -> dict[str, MtlMaterial]:
    """Return materials by name, as written. What cannot be read or has no counterpart gives a warning."""
    materials: dict[str, dict[str, str]] = {}
    current: dict[str, str] = {}
    for line in data.decode("utf-8-sig", "surrogateescape").splitlines():
        key, _, rest = line.strip().replace("\t", " ").partition(" ")
        key, rest = key.lower(), rest.strip()
        if key == "newmtl":
            current = materials.setdefault(rest, {})
        elif rest and not key.startswith("#"):
            current[key] = rest if key in PICTURES or key.startswith("map_") else with_points(rest, folder)
    plain = [f for f in materials.values() if "d" not in f]
    inverse = any(_numbers(f.get("tr", ""))[:1] == [1.0] for f in plain)  # so Tr is the opacity, as photogrammetry writes it
    if inverse:
        folder.warn(
            "the material library writes Tr 1, as photogrammetry does for opaque surfaces; Tr is taken for opacity in it"
        )
    library = _Library(folder, inverse)
    looks = {name: library.material(name, fields) for name, fields in materials.items()}
    if library.unread:
        listed = ", ".join(f"{key} ({count})" for key, count in library.unread.items())
        folder.warn(f"left out of materials, without counterpart: {listed}")
    return looks


class _Library:
    """The materials of one library. unread: what was left out, and how often."""

    def __init__(self, folder: Folder, inverse: bool) -> None:
        self.unread: Counter[str] = Counter()
        self._folder = folder
        self._inverse = inverse
        self._read: dict[str, Texture | None] = {}

    def material(self, name: str, fields: dict[str, str]) -> MtlMaterial:
        self.unread.update(key for key in fields if self._left_out(key, fields))
        pictures = {key: p for key in sorted(PICTURES) if key in fields and (p := self._picture(fields[key])) is not None}
        sets = list(dict.fromkeys(pictures[key][1] for key in sorted(pictures, key=lambda key: key != "map_kd")))
        textures = {}
        for key, slot in SLOTS.items():
            if key in pictures and slot not in textures and (key not in HEIGHTS or self._has_normals(pictures[key][0])):
                texture, place, _ = pictures[key]
                textures[slot] = replace(texture, uv_set=sets.index(place))
        opacity, mode = self._opacity(name, fields), "OPAQUE"
        if "map_d" in pictures:
            textures["base_color"], mode = _cut_out(textures.get("base_color"), pictures["map_d"], sets)
        color, glow = self._color(fields.get("kd", "")), self._color(fields.get("ke", ""))
        if "base_color" in textures and (color is None or max(color) < BLACK):
            color = (1.0, 1.0, 1.0)  # a picture multiplied by black would be black
        plain = Material()
        metallic, roughness = _fraction(fields, "pm", plain.metallic), _fraction(fields, "pr", plain.roughness)
        rough, metal = pictures.get("map_pr"), pictures.get("map_pm")
        if rough or metal:
            textures["metallic_roughness"] = _metallic_roughness(rough, metal, sets)
            metallic = (_fraction(fields, "pm", 1.0) or 1.0) if metal else metallic
            roughness = (_fraction(fields, "pr", 1.0) or 1.0) if rough else roughness
        return MtlMaterial(
            Material(
                readable(name) or plain.name,
                (*(color or plain.base_color[:3]), opacity),
                metallic=metallic,
                roughness=roughness,
                emissive=glow or plain.emissive,
                alpha_mode="BLEND" if opacity < 1 else mode,
                textures=textures,
            ),
            tuple(sets) or (SOLE,),
        )

    def _left_out(self, key: str, fields: dict[str, str]) -> bool:
        if key in ("pc", "pcr", "ps", "aniso", "anisor"):
            return any(_numbers(fields[key]))
        same = key == "map_ka" and _options(fields[key])[1] == _options(fields.get("map_kd", ""))[1]
        return key in OTHERS or (key.startswith("map_") and key not in PICTURES and not same)

    def _picture(self, value: str) -> _Picture | None:
        options, name = _options(value)
        for key, usual in PLAIN.items():
            if key in options and _numbers(" ".join(options[key])) not in (usual, usual[: len(options[key])]):
                self.unread[f"the option {key}"] += 1
        if name not in self._read:
            self._read[name] = picture_file(self._folder, name)
        texture = self._read[name]
        if texture is None:
            return None
        if options.get("-clamp") == ["on"]:
            texture = replace(texture, wrap=(CLAMP, CLAMP))
        strength = _numbers(" ".join(options.get("-bm", [])))
        texture = replace(texture, strength=strength[0] if strength and strength[0] > 0 else 1.0)
        scale, offset = (_numbers(" ".join(options.get(key, [])))[:2] for key in ("-s", "-o"))
        scale, offset = [*scale, 1.0, 1.0][:2], [*offset, 0.0, 0.0][:2]
        return texture, ((scale[0], scale[1]), (offset[0], offset[1])), (options.get("-imfchan") or [""])[0]

    def _has_normals(self, texture: Texture) -> bool:
        """Return whether a bump picture is one of normals, which are mostly blue."""
        red, green, blue = np.asarray(_opened(texture).convert("RGB").resize((32, 32)), float).reshape(-1, 3).mean(0)
        normals = bool(blue > 150 and max(abs(red - 128), abs(green - 128)) < 60 and blue > max(red, green) + 20)
        if not normals:
            self.unread["bump pictures of heights, not of normals"] += 1
        return normals

    def _opacity(self, name: str, fields: dict[str, str]) -> float:
        """Return `d`, or 1 - `Tr`; 1 for a material that would be invisible, as photogrammetry writes opaque ones."""
        dissolve, transparency = _numbers(fields.get("d", "").replace("-halo", "")), _numbers(fields.get("tr", ""))
        opacity = dissolve or [t if self._inverse else 1 - t for t in transparency] or [1.0]
        if opacity[0] <= 0:
            written = "d 0" if dissolve else f"Tr {transparency[0]:g}"
            self._folder.warn(f"material {readable(name)!r} would be invisible ({written}); it is taken for opaque")
            return 1.0
        return min(opacity[0], 1.0)

    def _color(self, value: str) -> tuple[float, float, float] | None:
        """Return a linear colour of one to three numbers, sRGB or CIE XYZ; None if there is none."""
        kind, _, rest = value.partition(" ")
        if kind == "spectral":
            self.unread["spectral colours"] += 1
        numbers = _numbers(rest if kind == "xyz" else value)[:3]
        if not numbers:
            return None
        numbers = numbers if len(numbers) == 3 else numbers[:1] * 3
        r, g, b = (np.clip(XYZ_TO_RGB @ numbers, 0, 1) if kind == "xyz" else to_linear(numbers)).tolist()
        return r, g, b


_Picture = tuple[Texture, Placement, str]  # the last one is the channel of -imfchan


def _opened(texture: Texture) -> Image.Image:
    with quiet_decoder():
        return Image.open(io.BytesIO(texture.data))


def _channel(picture: _Picture) -> Image.Image:
    """Return the channel that -imfchan names; else alpha if it varies, else the luminance."""
    image, wanted = _opened(picture[0]), CHANNELS.get(picture[2].lower())
    if image.has_transparency_data and wanted in ("A", None):
        alpha = image.convert("RGBA").getchannel("A")
        if wanted or np.ptp(alpha.getextrema()):
            return alpha
    return image.convert("RGB").getchannel(wanted) if wanted in ("R", "G", "B") else image.convert("L")


def _saved(image: Image.Image, like: _Picture | Texture, sets: list[Placement]) -> Texture:
    texture = like if isinstance(like, Texture) else replace(like[0], uv_set=sets.index(like[1]))
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return replace(texture, data=buffer.getvalue(), mime="image/png")


def _cut_out(base: Texture | None, mask: _Picture, sets: list[Placement]) -> tuple[Texture, str]:
    """Return the base colour with a mask as its alpha, and the alpha mode: MASK if the mask is nearly black and white."""
    alpha = _channel(mask)
    color = Image.new("RGB", alpha.size, "white") if base is None else _opened(base).convert("RGB")
    size = max(color.size, alpha.size)
    color, alpha = color.resize(size), alpha.resize(size)
    color.putalpha(alpha)
    values = np.asarray(alpha)
    sharp = ((values < SHARP[0]) | (values > SHARP[1])).mean() >= SHARP[2]
    return _saved(color, base or mask, sets), "MASK" if sharp else "BLEND"


def _metallic_roughness(rough: _Picture | None, metal: _Picture | None, sets: list[Placement]) -> Texture:
    """Return roughness as green and metallic as blue, as in glTF."""
    bands = [p and _channel(p) for p in (rough, metal)]
    size = max(band.size for band in bands if band)
    full = Image.new("L", size, 255)
    return _saved(Image.merge("RGB", [full, *(b.resize(size) if b else full for b in bands)]), rough or metal, sets)  # ty: ignore


def _options(value: str) -> tuple[dict[str, list[str]], str]:
    """Return the options of a picture, which stand before or after its name, and the name, which may contain spaces."""
    options: dict[str, list[str]] = {}
    name: list[str] = []
    words = value.split(" ")
    while words:
        word = words.pop(0)
        most = OPTIONS.get(word.lower(), 0) if words else 0
        if not most:
            name.append(word)
            continue
        taken = options[word.lower()] = []
        while words and len(taken) < most and (any(name) or len(words) > 1) and (most == 1 or _numbers(words[0])):
            taken.append(words.pop(0))
    return options, " ".join(name).strip()


def _numbers(text: str) -> list[float]:
    """Return the numbers at the start of a text."""
    numbers = []
    for word in text.split():
        try:
            value = float(word)
        except ValueError:
            break
        numbers.append(value if math.isfinite(value) else 0.0)
    return numbers


def _fraction(fields: dict[str, str], key: str, default: float) -> float:
    value = _numbers(fields.get(key, ""))
    return min(max(value[0], 0.0), 1.0) if value else default
