"""Blender by bpy: the USD and the GLB, imported with the options that the dialog has at first."""

from __future__ import annotations

import bpy
import numpy as np
from common import Asset, serve, swept


def read(asset: Asset, variant: str) -> dict:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if variant == "usd":
        bpy.ops.wm.usd_import(filepath=str(asset.file("usd")))
    else:
        bpy.ops.import_scene.gltf(filepath=str(asset.file("glb")))
    names = {p["name"] for p in asset.content["parts"]}
    for thing in bpy.data.objects:  # a link of USD whose only mesh is called after it
        if thing.name.removesuffix("_visual") in names - {o.name for o in bpy.data.objects}:
            thing.name = thing.name.removesuffix("_visual")
    scene = bpy.context.scene

    def poses(time: float) -> dict[str, np.ndarray]:
        scene.frame_set(int(time), subframe=time - int(time))
        return {o.name: np.array(o.matrix_world) for o in bpy.data.objects}

    frames = [a.frame_range for a in bpy.data.actions]
    begin, end = (min(f[0] for f in frames), max(f[1] for f in frames)) if frames else (0, 0)
    seen = [poses(time) for time in np.linspace(begin, end, int(4 * (end - begin)) + 1)]
    rest = seen[0]  # the world's frame, since that of an object of glTF is turned
    links, corners, hulls = {name: {"place": rest[name][:3, 3]} for name in names & set(rest)}, {}, 0
    for thing in bpy.data.objects:
        if thing.type != "MESH" or thing.hide_render:
            continue
        if "collision" in thing.name:
            hulls += 1
            continue
        link = thing
        while link is not None and link.name not in names:
            link = link.parent
        if link is not None:
            points = np.array([v.co for v in thing.data.vertices], float) @ rest[thing.name][:3, :3].T + rest[thing.name][:3, 3]
            corners.setdefault(link.name, []).append(points)
    for name, points in corners.items():
        links[name]["box"] = [np.concatenate(points).min(0), np.concatenate(points).max(0)]
    joints = {}
    for joint in asset.joints.values() if variant == "glb" else ():
        parent, child = joint["parent"], joint["child"]
        extras = bpy.data.objects[child].get("joint") if child in rest else None
        if extras is None:
            continue
        record = joints[extras["name"]] = {"type": extras["type"], "parent": parent, "child": child}
        if joint["type"] != "fixed":
            moves = [np.linalg.inv(at[parent]) @ at[child] for at in seen]
            record |= swept(rest[parent], moves, joint["type"] == "prismatic", list(extras["axis"]))
    said = ["draws collision shapes"] if hulls else []
    return {"version": f"Blender {bpy.app.version_string}", "said": said, "joints": joints, "links": links}


serve(read)
