"""MTL, the materials of OBJ files. Its colours are sRGB by convention and are converted to linear."""

from __future__ import annotations

import math

from anymesh.loading.folder import Folder
from anymesh.loading.pictures import picture_file
from anymesh.types import Material, Texture
from anymesh.types.mesh import to_linear

SLOTS = {"map_kd": "base_color", "norm": "normal", "map_ke": "emissive"}
VALUES = {"-mm": 2, "-o": 3, "-s": 3, "-t": 3}  # options of a picture with more than one value
FLAGS = {"-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type", "-colorspace"}
BLACK = 0.02


def read_mtl(data: bytes, folder: Folder) -> dict[str, Material]:
    """Return materials by name. A texture that cannot be read gives a warning."""
    materials: dict[str, dict[str, str]] = {}
    current: dict[str, str] = {}
    for line in data.decode("utf-8-sig", "replace").splitlines():
        key, _, rest = line.strip().replace("\t", " ").partition(" ")
        if key.lower() == "newmtl":
            current = materials.setdefault(rest.strip(), {})
        elif rest and not key.startswith("#"):
            current[key.lower()] = rest.strip()
    return {name: _material(name, fields, folder) for name, fields in materials.items()}


def _material(name: str, fields: dict[str, str], folder: Folder) -> Material:
    textures: dict[str, Texture] = {}
    for key, value in fields.items():
        if key in SLOTS:
            texture = picture_file(folder, _picture_name(value))
            if texture is not None:
                textures[SLOTS[key]] = texture
    color = _numbers(fields.get("kd", ""))
    if "base_color" in textures and (len(color) < 3 or max(color[:3]) < BLACK):
        color = [1.0, 1.0, 1.0]  # a picture multiplied by black would be black
    alpha = _numbers(fields.get("d", "").replace("-halo", ""))
    alpha = alpha or [1 - t for t in _numbers(fields.get("tr", ""))] or [1.0]
    opacity = min(max(alpha[0], 0.0), 1.0)
    glow = _numbers(fields.get("ke", ""))
    plain = Material()
    r, g, b = to_linear(color[:3]).tolist() if len(color) >= 3 else plain.base_color[:3]
    return Material(
        name or plain.name,
        (r, g, b, opacity),
        metallic=_fraction(fields, "pm", plain.metallic),
        roughness=_fraction(fields, "pr", plain.roughness),
        emissive=tuple(to_linear(glow[:3]).tolist()) if len(glow) >= 3 else plain.emissive,
        alpha_mode="BLEND" if opacity < 1 else "OPAQUE",
        textures=textures,
    )


def _picture_name(value: str) -> str:
    """Return the file name, which may contain spaces, after its options."""
    words = value.split(" ")
    while len(words) > 1 and (words[0].lower() in VALUES or words[0].lower() in FLAGS):
        most = VALUES.get(words[0].lower(), 1)
        words = words[1:]
        taken = 0
        while len(words) > 1 and taken < most and (most == 1 or _numbers(words[0])):
            words, taken = words[1:], taken + 1
    return " ".join(words)


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
