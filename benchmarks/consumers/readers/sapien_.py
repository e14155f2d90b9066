"""SAPIEN (PhysX on the CPU), from the URDF without visuals, since these need a graphics device; also by ManiSkill's loader."""

from __future__ import annotations

import tempfile
from importlib import import_module
from importlib.metadata import version
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


def loaded_by_maniskill(path: str, scene: sapien.Scene) -> tuple[list, list]:
    """Return the articulation that ManiSkill builds, as its cabinets are built, and no actors."""
    backend = import_module("mani_skill.envs.utils.system.backend").parse_sim_and_render_backend("physx_cpu", "none")
    whole = import_module("mani_skill.envs.scene").ManiSkillScene([scene], backend=backend)
    loader = whole.create_urdf_loader()
    loader.fix_root_link = loader.load_multiple_collisions_from_file = True
    parsed = loader.parse(path)
    if not parsed["articulation_builders"]:
        raise ValueError("ManiSkill loads no articulation")
    builder = parsed["articulation_builders"][0]
    builder.initial_pose = sapien.Pose()
    builder.set_scene_idxs([0])
    return [builder.build(name="thing")._objs[0]], []


def plain(name: str) -> str:
    """Return the name of a link or joint, which ManiSkill calls after the scene too."""
    return name.removeprefix("scene-0-thing_")


def handles(asset: Asset, path: Path) -> list[str]:
    """Return the joints whose handle is not called so on the link that they move, where ManiSkill looks for it."""
    robot = ElementTree.parse(path).getroot()
    named = {
        str(li.get("name")) for li in robot.iter("link") if any("handle" in str(v.get("name")) for v in li.findall("visual"))
    }
    return [f"no handle of {name}" for name, j in asset.joints.items() if "handle" in j and j["child"] not in named]


def read(asset: Asset, variant: str) -> dict:
    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    loader = scene.create_urdf_loader()
    loader.fix_root_link = True
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bare.urdf"
        path.write_text(bare(asset.file(variant)), encoding="utf-8")
        if variant == "maniskill":
            bodies, actors = loaded_by_maniskill(str(path), scene)
        else:
            bodies, actors = loader.load_multiple(str(path))  # its other functions refuse a URDF of one link
    said = f"SAPIEN {sapien.__version__}" if variant == "urdf" else f"ManiSkill {version('mani_skill')}"
    if not bodies:
        (still,) = (a.find_component_by_type(sapien.physx.PhysxRigidDynamicComponent) for a in actors)
        w, x, y, z = still.cmass_local_pose.q
        record = placed(np.eye(4), still.mass, still.cmass_local_pose.p, still.inertia, turn_of(x, y, z, w))
        return {"version": said, "joints": {}, "links": {asset.root: record}}
    (body,) = bodies

    def poses() -> dict[str, np.ndarray]:
        found = {plain(n.name): n.entity_pose.to_transformation_matrix() for n in body.links}
        return {name: np.linalg.inv(found[asset.root]) @ T for name, T in found.items()}

    at = np.zeros(len(body.active_joints))
    body.set_qpos(at)
    rest, links, joints = poses(), {}, {}
    for link in body.links:
        w, x, y, z = link.cmass_local_pose.q
        turn, name = turn_of(x, y, z, w), plain(link.name)
        links[name] = placed(rest[name], link.mass, link.cmass_local_pose.p, link.inertia, turn)
    for joint in body.joints:
        if joint.parent_link is None:
            continue
        record = {"type": KINDS[joint.type], "parent": plain(joint.parent_link.name), "child": plain(joint.child_link.name)}
        joints[plain(joint.name)] = record
        if joint not in body.active_joints:
            continue
        k, amount = body.active_joints.index(joint), asset.amount(plain(joint.name))
        at[k] = amount
        body.set_qpos(at)
        record |= motion(rest[record["child"]], poses()[record["child"]], amount)
        at[k] = 0
        record |= {"limits": finite(*np.asarray(joint.limits).reshape(-1)[:2]), "damping": joint.damping}
        record |= {"friction": joint.friction, "effort": joint.force_limit, "armature": np.ravel(joint.armature)[0]}
        record["velocity"] = np.ravel(joint.max_velocity)[0]
    faults = {"faults": handles(asset, asset.file(variant))} if variant == "maniskill" else {}
    return {"version": said, "joints": joints, "links": links, **faults}


serve(read)
