"""COLLADA visuals, one file per link beside its OBJ, for viewers and simulators that do not read OBJ.

A file states its unit and that Z is up, as in link frames; glTF is Y up, and readers of URDF disagree on who turns it. Pictures
of the base colour and of emission are shared with the OBJ; viewers of COLLADA show no others, and no colours of vertices.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from anymesh.export.links import Primitive
from anymesh.export.meshes import display_color, material_names, texture_files, visible
from anymesh.export.model import ExportConfig, ExportLink, Model
from anymesh.export.notation import document
from anymesh.types import Material
from anymesh.types.mesh import to_srgb
from anymesh.types.triangles import face_cross

NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"
DATE = "1980-01-01T00:00:00Z"  # the same bytes every time
SLOTS = {"base_color": "diffuse", "emissive": "emission"}
SEMANTICS = {"positions": "VERTEX", "normals": "NORMAL", "uv": "TEXCOORD"}
AXES = {"positions": "XYZ", "normals": "XYZ", "uv": "ST"}
sub = ElementTree.SubElement
Element = ElementTree.Element


def write_dae(model: Model, folder: Path, config: ExportConfig) -> None:
    """Write meshes/<link>.dae of each link into an asset folder whose pictures are there."""
    files = texture_files(model.tinted.asset.mesh, model.tiled.asset.mesh)
    for body in model.tiled.bodies:
        text = _dae_text(model.tiled, body, files, config)
        (folder / body.visual_path(model.how.visuals)).write_text(text, encoding="utf-8", newline="\n")


def _dae_text(model: Model, body: ExportLink, files: Mapping[bytes, str], config: ExportConfig) -> str:
    mesh, primitives = model.asset.mesh, visible(body.link, config)
    names = material_names(mesh.materials)
    looks = {p.material: display_color(mesh, p) for p in primitives}  # links have one primitive per material
    root = Element("COLLADA", xmlns=NAMESPACE, version="1.4.1")
    asset = sub(root, "asset")
    for tag in ("created", "modified"):
        sub(asset, tag).text = DATE
    sub(asset, "unit", name="meter", meter="1")
    sub(asset, "up_axis").text = "Z_UP"
    images, effects, materials = (sub(root, f"library_{kind}") for kind in ("images", "effects", "materials"))
    for k, color in looks.items():
        entry = sub(materials, "material", id=f"{names[k]}-material", name=names[k])
        sub(entry, "instance_effect", url=f"#{names[k]}-effect")
        _add_effect(effects, images, names[k], mesh.materials[k], files if mesh.corner_uv is not None else {}, color)
    if not len(images):
        root.remove(images)
    geometry = sub(sub(root, "library_geometries"), "geometry", id="visual-mesh", name=body.name)
    _add_geometry(sub(geometry, "mesh"), primitives, names)
    node = sub(sub(sub(root, "library_visual_scenes"), "visual_scene", id="scene"), "node", id=body.name, name=body.name)
    technique = sub(sub(sub(node, "instance_geometry", url="#visual-mesh"), "bind_material"), "technique_common")
    for k in looks:
        bound = sub(technique, "instance_material", symbol=names[k], target=f"#{names[k]}-material")
        sub(bound, "bind_vertex_input", semantic="UVMap", input_semantic="TEXCOORD", input_set="0")
    sub(sub(root, "scene"), "instance_visual_scene", url="#scene")
    return document(root)


def _add_effect(
    effects: Element, images: Element, name: str, material: Material, files: Mapping[bytes, str], color: Sequence[float]
) -> None:
    """Add the pictures of a material, and its colour (sRGB)."""
    profile = sub(sub(effects, "effect", id=f"{name}-effect"), "profile_COMMON")
    colors = {"emission": to_srgb(np.array(material.emissive) / max(1.0, *material.emissive)), "diffuse": color[:3]}
    pictures = {SLOTS[slot]: files[t.data] for slot, t in material.textures.items() if slot in SLOTS and t.data in files}
    for channel, file in pictures.items():
        image = f"{name}-{channel}-image"
        sub(sub(images, "image", id=image), "init_from").text = file
        surface = sub(sub(profile, "newparam", sid=f"{channel}-surface"), "surface", type="2D")
        sub(surface, "init_from").text = image
        sampler = sub(sub(profile, "newparam", sid=f"{channel}-sampler"), "sampler2D")
        sub(sampler, "source").text = f"{channel}-surface"
    shader = sub(sub(profile, "technique", sid="common"), "lambert")
    for channel, rgb in colors.items():
        element = sub(shader, channel)
        if channel in pictures:
            sub(element, "texture", texture=f"{channel}-sampler", texcoord="UVMap")
        else:
            sub(element, "color").text = " ".join(f"{c:.6g}" for c in (*rgb, 1.0))
    if material.opacity < 1:
        sub(sub(shader, "transparent", opaque="A_ONE"), "color").text = "1 1 1 1"
        sub(sub(shader, "transparency"), "float").text = f"{material.opacity:.6g}"


def _add_geometry(element: Element, primitives: Sequence[Primitive], names: Sequence[str]) -> None:
    """Add the sources, and one list of triangles per material; faces without normals get those of their planes."""
    sources: dict[str, list[np.ndarray]] = {"positions": [], "normals": [], "uv": []}
    lists = []
    for p in primitives:
        corners = {"positions": (p.positions, p.triangles), "normals": _normals(p)}
        if p.uv is not None:
            corners["uv"] = p.uv, p.triangles
        starts = {kind: sum(map(len, sources[kind])) for kind in corners}
        for kind, (rows, _) in corners.items():
            sources[kind].append(rows)
        lists.append((p.material, {kind: indices + starts[kind] for kind, (_, indices) in corners.items()}))
    for kind, rows in sources.items():
        if rows:
            _add_source(element, kind, np.concatenate(rows))
    sub(sub(element, "vertices", id="vertices"), "input", semantic="POSITION", source="#positions")
    for material, corners in lists:
        triangles = sub(element, "triangles", count=str(len(corners["positions"])), material=names[material])
        for offset, kind in enumerate(corners):
            source = "#vertices" if kind == "positions" else f"#{kind}"
            entry = sub(triangles, "input", semantic=SEMANTICS[kind], source=source, offset=str(offset))
            if kind == "uv":
                entry.set("set", "0")
        sub(triangles, "p").text = " ".join(map(str, np.stack(list(corners.values()), -1).reshape(-1).tolist()))


def _normals(p: Primitive) -> tuple[np.ndarray, np.ndarray]:
    """Return the normals of a primitive, and those of the corners of its triangles."""
    if p.normals is not None:
        return p.normals, p.triangles
    cross = face_cross(p.positions[p.triangles])
    length = np.linalg.norm(cross, axis=1, keepdims=True)
    flat = np.where(length > 0, cross / np.maximum(length, 1e-300), (0.0, 0.0, 1.0))
    return flat, np.repeat(np.arange(len(flat))[:, None], 3, axis=1)


def _add_source(element: Element, kind: str, rows: np.ndarray) -> None:
    source = sub(element, "source", id=kind)
    array = sub(source, "float_array", id=f"{kind}-array", count=str(rows.size))
    array.text = " ".join(f"{v:.8g}" for v in (rows + 0.0).reshape(-1).tolist())
    accessor = sub(sub(source, "technique_common"), "accessor", source=f"#{kind}-array", count=str(len(rows)))
    accessor.set("stride", str(rows.shape[1]))
    for name in AXES[kind]:
        sub(accessor, "param", name=name, type="float")
