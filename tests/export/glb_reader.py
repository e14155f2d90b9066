"""Content of a GLB, read independently of the writer: its nodes and both physics extensions."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import trimesh
from neutral import KINDS, Body, Read, box, chain, cloud, cylinder, frame, motion
from scipy.spatial.transform import Rotation


def read_glb(folder: Path, name: str) -> Read:
    raw = (folder / f"{name}.glb").read_bytes()
    doc = json.loads(raw[20 : 20 + int.from_bytes(raw[12:16], "little")])
    nodes, joints = doc["nodes"], {}
    for node in nodes[1:]:
        for child in (nodes[i] for i in node.get("children", []) if "joint" in nodes[i].get("extras", {})):
            said = child["extras"]["joint"]
            joints[said["name"]] = {**said, "parent": node["name"], "child": child["name"]}
            joints[said["name"]]["rest"] = frame(child.get("translation", (0, 0, 0)))
            if said["type"] == "fixed":
                del joints[said["name"]]["limits"]
    for stated in doc.get("extensions", {}).get("KHR_physics_rigid_bodies", {}).get("physicsJoints", []):
        for drive in stated.get("drives", []):
            driven = "positionTarget" in drive
            gains = {"drive": (drive["stiffness"], drive["damping"], drive["maxForce"])} if driven else drive
            joints[stated["name"]] |= {key: gains[key] for key in ("drive", "damping") if key in gains}
            joints[stated["name"]] |= {"effort": drive["maxForce"]} if driven else {}
    scene = trimesh.load(folder / f"{name}.glb")  # independent reader of the tree at rest
    up = frame(rotation=Rotation.from_quat(nodes[0]["rotation"]).as_matrix())
    move = chain(joints, nodes[1]["name"], lambda j, q: j["rest"] @ motion(KINDS[j["type"]], j["axis"], q))
    for link, T in move({}).items():
        np.testing.assert_allclose(scene.graph.get(link)[0], up @ T, atol=1e-6)
    bodies, fixed = _glb_bodies(doc, raw[28 + int.from_bytes(raw[12:16], "little") :])
    return Read(joints, bodies, move, fixed)


def _glb_placed(node: dict) -> np.ndarray:
    rotation = Rotation.from_quat(node.get("rotation", (0, 0, 0, 1))).as_matrix()
    return frame(node.get("translation", (0, 0, 0)), rotation)


def _glb_bodies(doc: dict, data: bytes) -> tuple[dict[str, Body], bool]:
    """Return the bodies of both physics extensions, which must agree, and whether the first is static."""
    nodes, bodies = doc["nodes"], {}
    shapes = doc["extensions"].get("KHR_implicit_shapes", {}).get("shapes", [])
    for node in nodes:
        said = node.get("extensions", {})
        if "motion" not in said.get("OMI_physics_body", {}):
            continue
        motion = said["OMI_physics_body"]["motion"]
        theirs = said.get("KHR_physics_rigid_bodies", {}).get("motion")
        assert theirs == (None if motion["type"] == "static" else {k: v for k, v in motion.items() if k != "type"})
        R = Rotation.from_quat(motion["inertiaOrientation"]).as_matrix()
        tensor = (R * np.array(motion["inertiaDiagonal"])) @ R.T
        body = bodies[node["name"]] = Body(motion["mass"], np.array(motion["centerOfMass"]), tensor)
        for child in (nodes[k] for k in node["children"]):
            if "collider" not in child.get("extensions", {}).get("KHR_physics_rigid_bodies", {}):
                continue
            geometry = child["extensions"]["KHR_physics_rigid_bodies"]["collider"]["geometry"]
            own = child["extensions"]["OMI_physics_body"]["collider"]["shape"]
            own = doc["extensions"]["OMI_physics_shape"]["shapes"][own]
            T = _glb_placed(child)
            if "node" in geometry:
                mesh = nodes[geometry["node"]]["mesh"]
                assert geometry["convexHull"]
                assert own == {"type": "convex", "convex": {"mesh": mesh}}
                a = doc["accessors"][doc["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"]]
                start = doc["bufferViews"][a["bufferView"]]["byteOffset"]
                points = np.frombuffer(data, "<f4", 3 * a["count"], start).reshape(-1, 3).astype(float)
                body.supports.append(cloud(points @ T[:3, :3].T + T[:3, 3]))
                continue
            shape = shapes[geometry["shape"]]
            assert own == shape
            if shape["type"] == "box":
                body.supports.append(box(T, shape["box"]["size"]))
            else:
                turned = T @ frame(rotation=Rotation.from_euler("x", -90, degrees=True).as_matrix())  # Y is the axis
                body.supports.append(cylinder(turned, shape["cylinder"]["radiusTop"], shape["cylinder"]["height"]))
    return bodies, "motion" not in nodes[1]["extensions"].get("KHR_physics_rigid_bodies", {})
