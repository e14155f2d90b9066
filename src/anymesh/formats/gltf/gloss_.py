"""KHR_materials_pbrSpecularGlossiness, an archived extension of glTF, as metallic-roughness."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from PIL import Image

from anymesh.types import Material

MAX_SIDE = 2048  # [px] of pictures that are converted


def from_gloss(material: Material, diffuse: tuple[float, ...], specular: tuple[float, ...] | None, gloss: float) -> Material:
    """Return a material with that look; its pictures are the diffuse and, as metallic-roughness, the specular-glossiness one.

    diffuse: RGBA, specular: RGB, linear. What states no specular colour is no metal and keeps its diffuse picture.
    """
    from trimesh.visual.gloss import specular_to_pbr  # when needed: it takes a while

    base, shiny = material.textures.get("base_color"), material.textures.get("metallic_roughness")
    rest = {slot: t for slot, t in material.textures.items() if slot != "metallic_roughness"}
    if shiny is None and specular is None:
        return replace(material, base_color=diffuse, metallic=0.0, roughness=1 - gloss, textures=rest)
    if base is not None and shiny is not None and base.uv_set != shiny.uv_set:  # its mean, which needs no coordinates
        shiny = shiny.painted(shiny.pixels().mean((0, 1), keepdims=True))
    images = [None if t is None else Image.fromarray(t.pixels(MAX_SIDE)) for t in (shiny, base)]
    made: dict[str, Any] = specular_to_pbr(specular, gloss, *images, diffuse)
    like = base or shiny
    for slot, key in (("base_color", "baseColorTexture"), ("metallic_roughness", "metallicRoughnessTexture")):
        if key in made and like is not None:
            rest[slot] = like.painted(np.asarray(made[key]))
    color = tuple(float(c) for c in made.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0)))
    return replace(
        material,
        base_color=color,
        metallic=float(made["metallicFactor"]),
        roughness=float(made["roughnessFactor"]),
        textures=rest,
    )
