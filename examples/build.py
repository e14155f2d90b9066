"""Builds the example meshes and their truth; `--check` compares with what is there instead. CC0, see README.md here.

    python examples/build.py [--check]      (needs the test extra)

meshes/NAME.glb holds the object with names that say nothing (but named_cabinet); truth/NAME.json the parts and joints in
the file's coordinates (Y up), truth/NAME.npy a part number a face, in the order of the file's nodes.
"""

from __future__ import annotations

import hashlib
import io
import json
import sys
from pathlib import Path

import numpy as np
import trimesh
from objects import Thing, all_things
from PIL import Image
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial

HERE = Path(__file__).parent
TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
COLORS = {
    "body": (0.86, 0.86, 0.84), "panel": (0.25, 0.27, 0.3), "dark": (0.08, 0.08, 0.09), "glass": (0.55, 0.7, 0.75),
    "metal": (0.62, 0.63, 0.65), "wood": (0.6, 0.42, 0.26), "red": (0.7, 0.12, 0.1),
}  # fmt: skip
TEXTURED, BY_VERTEX = ("cabinet", "microwave"), ("toy_car",)


def wood_grain() -> Image.Image:
    """A small picture of planks, the same each time."""
    x, y = np.meshgrid(np.linspace(0, 1, 64), np.linspace(0, 1, 64))
    rings = 0.5 + 0.5 * np.sin(40 * (x + 0.08 * np.sin(7 * y)) + 3 * np.sin(2 * y))
    rgb = np.stack([140 + 50 * rings, 95 + 40 * rings, 55 + 25 * rings], -1)
    return Image.fromarray(rgb.astype(np.uint8))


def fuse(thing: Thing) -> tuple[trimesh.Trimesh, np.ndarray]:
    """All pieces as one watertight surface, its faces told apart by the piece that they lie on."""
    whole = trimesh.boolean.union([s for _, s, _ in thing.pieces])
    centers = whole.triangles_center
    gap = np.stack([trimesh.proximity.closest_point(s, centers)[1] for _, s, _ in thing.pieces])
    owner = (gap + 1e-7 * np.arange(len(gap))[:, None]).argmin(0)
    return whole, np.array([thing.pieces[k][0] for k in owner])


def build(thing: Thing) -> tuple[bytes, np.ndarray]:
    """The GLB file, and a part number a face in the order of its nodes as they are read."""
    numbers = {"base": 0, **{part: k + 1 for k, part in enumerate(thing.joints)}}
    scene, labels = trimesh.Scene(), {}
    if thing.fused:
        whole, owner = fuse(thing)
        groups = [("mesh_0", whole, np.array([numbers[o] for o in owner]), "body")]
    else:
        keys = list(dict.fromkeys((p if thing.name == "named_cabinet" else "", c) for p, _, c in thing.pieces))
        groups = []
        for k, (part, color) in enumerate(keys):
            mine = [(p, s) for p, s, c in thing.pieces if c == color and part in ("", p)]
            mesh = trimesh.util.concatenate([s for _, s in mine])
            label = np.concatenate([np.full(len(s.faces), numbers[p]) for p, s in mine])
            groups.append((f"{part}_{color}" if part else f"mesh_{k}", mesh, label, color))
    for name, mesh, label, color in groups:
        mesh = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
        mesh.apply_transform(TO_Y_UP)
        scene.add_geometry(dressed(mesh, thing.name, color), node_name=name, geom_name=name)
        labels[name] = label
    data = scene.export(file_type="glb")
    order = trimesh.load_scene(io.BytesIO(data), file_type="glb").graph.nodes_geometry
    return data, np.concatenate([labels[n] for n in order]).astype(np.int16)


def dressed(mesh: trimesh.Trimesh, thing: str, color: str) -> trimesh.Trimesh:
    """The mesh with a material, vertex colours, or a texture."""
    rgb = COLORS[color]
    if thing in BY_VERTEX:
        rgba = np.tile((*(int(255 * c) for c in rgb), 255), (len(mesh.vertices), 1)).astype(np.uint8)
        mesh.visual = ColorVisuals(mesh, vertex_colors=rgba)
        return mesh
    material = PBRMaterial(
        name=f"material_{list(COLORS).index(color)}", baseColorFactor=[*(int(255 * c) for c in rgb), 255],
        metallicFactor=0.8 if color == "metal" else 0.0, roughnessFactor=0.6,
    )  # fmt: skip
    uv = np.zeros((len(mesh.vertices), 2))
    if thing in TEXTURED and color in ("wood", "panel"):
        apart = trimesh.Trimesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3), process=False)
        axis = np.abs(mesh.face_normals).argmax(1)
        planes = np.array([[2, 1], [0, 2], [0, 1]])[axis].repeat(3, 0)
        uv = np.take_along_axis(apart.vertices, planes, 1) * 3
        mesh = apart
        material.baseColorTexture = wood_grain()
        material.baseColorFactor = [255, 255, 255, 255] if color == "wood" else [110, 110, 130, 255]
    mesh.visual = TextureVisuals(uv=uv, material=material)
    return mesh


def truth(thing: Thing) -> dict[str, object]:
    """Parts and joints in file coordinates."""
    R = TO_Y_UP[:3, :3]
    joints = [
        {
            "child": part,
            "parent": j.parent,
            "type": j.type,
            "origin": [round(float(v), 6) + 0.0 for v in R @ np.array(j.origin, float)],
            "axis": [round(float(v), 9) + 0.0 for v in R @ np.array(j.axis, float)],
            "limits": None if j.limits is None else [round(float(v), 6) for v in j.limits],
        }
        for part, j in thing.joints.items()
    ]
    parts = [{"name": "base", "label": "base", "parent": None}]
    parts += [{"name": p, "label": j.label, "parent": j.parent} for p, j in thing.joints.items()]
    return {"name": thing.name, "category": thing.category, "parts": parts, "joints": joints}


def main() -> None:
    check, stale = "--check" in sys.argv[1:], []
    for folder in ("meshes", "truth"):
        (HERE / folder).mkdir(exist_ok=True)
    for thing in all_things():
        data, labels = build(thing)
        files = {
            HERE / "meshes" / f"{thing.name}.glb": data,
            HERE / "truth" / f"{thing.name}.json": (json.dumps(truth(thing), indent=1) + "\n").encode(),
        }
        for path, data in files.items():
            if check and (not path.exists() or hashlib.sha256(path.read_bytes()).digest() != hashlib.sha256(data).digest()):
                stale.append(path.name)
            elif not check:
                path.write_bytes(data)
        if not check:
            np.save(HERE / "truth" / f"{thing.name}.npy", labels)
    if stale:
        sys.exit(f"not as built: {', '.join(stale)}")


if __name__ == "__main__":
    main()
