"""Check the output contract without any knowledge of this package."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import trimesh
import yourdfpy

KINDS = ("fixed", "revolute", "continuous", "prismatic")


def faults(folder: Path, source: Path) -> list[str]:
    """What breaks the contract, in words; empty when it holds."""
    urdfs = sorted(folder.glob("*.urdf"))
    if len(urdfs) != 1:
        return [f"{len(urdfs)} .urdf files, one expected"]
    stem = urdfs[0].stem
    missing = [n for n in (f"{stem}.glb", "preview.png", "asset.json") if not (folder / n).is_file()]
    if missing:
        return [f"missing: {missing}"]
    record = json.loads((folder / "asset.json").read_text())
    robot = yourdfpy.URDF.load(str(urdfs[0]), mesh_dir=str(folder), load_meshes=True, build_scene_graph=True)
    told = {j["name"]: j for j in record["joints"] if j["type"] != "fixed"}
    moving = {name: j for name, j in robot.joint_map.items() if j.type != "fixed"}
    found = [f"{name}: type {j.type}" for name, j in robot.joint_map.items() if j.type not in KINDS]
    if set(told) != set(moving):
        found.append(f"joints of URDF {sorted(moving)} and asset.json {sorted(told)}")
    for name in set(told) & set(moving):
        found += _joint_faults(name, told[name], moving[name], robot)
    found += _link_faults(urdfs[0], {j.child for j in moving.values()})
    mesh = trimesh.load(source, force="scene").to_geometry()
    mesh.apply_transform(np.array(record["source"]["T_asset_source"]))
    if np.abs(robot.scene.bounds - mesh.bounds).max() > 0.01 * np.linalg.norm(mesh.extents):
        found.append("the asset at rest is not where the source is")
    raw = (folder / f"{stem}.glb").read_bytes()
    if moving and not json.loads(raw[20 : 20 + int.from_bytes(raw[12:16], "little")]).get("animations"):
        found.append("no animation")
    return found


def _joint_faults(name: str, told: dict, joint, robot) -> list[str]:
    found = []
    T = robot.get_transform(joint.child)
    axis = np.array(told["axis"])
    if abs(np.linalg.norm(axis) - 1) > 1e-6 or not np.allclose(T[:3, :3] @ joint.axis, axis, atol=1e-6):
        found.append(f"{name}: axes differ")
    if told["type"] != "prismatic" and np.linalg.norm(np.cross(T[:3, 3] - told["origin"], axis)) > 1e-6:
        found.append(f"{name}: hinge lines differ")
    limits = told["limits"]
    if told["type"] == "continuous":
        if limits is not None:
            found.append(f"{name}: a continuous joint with limits")
    elif not (limits and limits[0] <= 0 <= limits[1] and limits[0] < limits[1]):
        found.append(f"{name}: limits {limits}")
    elif not np.allclose((joint.limit.lower, joint.limit.upper), limits, atol=1e-9):
        found.append(f"{name}: limits differ")
    if not (0 <= told["confidence"] <= 1 and told["reason"]):
        found.append(f"{name}: confidence and reason")
    return found


def _link_faults(urdf: Path, moving: set[str]) -> list[str]:
    found = []
    for link in ElementTree.parse(urdf).getroot().findall("link"):
        mass = link.find("inertial/mass")
        whole = link.find("visual") is not None and link.find("collision") is not None
        if link.get("name") in moving and (mass is None or float(mass.get("value", "0")) <= 0 or not whole):
            found.append(f"{link.get('name')}: inertial, visual and collision expected")
        found += [
            f"{m.get('filename')}: no such file"
            for m in link.iter("mesh")
            if not (urdf.parent / str(m.get("filename"))).is_file()
        ]
    return found
