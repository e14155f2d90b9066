"""SAPIEN (PhysX on the CPU), from the URDF without visuals, since these need a graphics device."""

from __future__ import annotations

import tempfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import sapien
from common import Asset, finite, motion, placed, serve, turn_of

KINDS = {"fixed": "fixed", "revolute": "continuous", "prismatic": "prismatic", "revolute_unwrapped": "revolute"}


def bare(path: Path) -> str:
    root = ElementTree.parse(path).getroot()
    for link in root.iter("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    for mesh in root.iter("mesh"):
        mesh.set("filename", str((path.parent / str(mesh.get("filename"))).resolve()))
    return ElementTree.tostring(root, encoding="unicode")


def read(asset: Asset, variant: str) -> dict:
    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    loader = scene.create_urdf_loader()
    loader.fix_root_link = True
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bare.urdf"
        path.write_text(bare(asset.file("urdf")), encoding="utf-8")
        bodies, actors = loader.load_multiple(str(path))  # its other functions refuse a URDF of one link
    version = f"SAPIEN {sapien.__version__}"
    if not bodies:
        (still,) = (a.find_component_by_type(sapien.physx.PhysxRigidDynamicComponent) for a in actors)
        w, x, y, z = still.cmass_local_pose.q
        record = placed(np.eye(4), still.mass, still.cmass_local_pose.p, still.inertia, turn_of(x, y, z, w))
        return {"version": version, "joints": {}, "links": {asset.root: record}}
    (body,) = bodies

    def poses() -> dict[str, np.ndarray]:
        root = body.root.entity_pose.to_transformation_matrix()
        return {n.name: np.linalg.inv(root) @ n.entity_pose.to_transformation_matrix() for n in body.links}

    at = np.zeros(len(body.active_joints))
    body.set_qpos(at)
    rest, links, joints = poses(), {}, {}
    for link in body.links:
        w, x, y, z = link.cmass_local_pose.q
        links[link.name] = placed(rest[link.name], link.mass, link.cmass_local_pose.p, link.inertia, turn_of(x, y, z, w))
    for joint in body.joints:
        if joint.parent_link is None:
            continue
        record = {"type": KINDS[joint.type], "parent": joint.parent_link.name, "child": joint.child_link.name}
        joints[joint.name] = record
        if joint not in body.active_joints:
            continue
        k, amount = body.active_joints.index(joint), asset.amount(joint.name)
        at[k] = amount
        body.set_qpos(at)
        record |= motion(rest[joint.child_link.name], poses()[joint.child_link.name], amount)
        at[k] = 0
        record |= {"limits": finite(*np.asarray(joint.limits).reshape(-1)[:2]), "damping": joint.damping}
        record |= {"friction": joint.friction, "effort": joint.force_limit, "armature": np.ravel(joint.armature)[0]}
        record["velocity"] = np.ravel(joint.max_velocity)[0]
    return {"version": version, "joints": joints, "links": links}


serve(read)
