"""Genesis on the CPU, from the URDF, without the rotor's inertia of 0.1 that it adds to each joint by default, or the MJCF."""

from __future__ import annotations

from importlib.metadata import version

import genesis
import numpy as np
import torch
from common import Asset, finite, frame, motion, placed, serve, turn_of

KINDS = {"REVOLUTE": "revolute", "PRISMATIC": "prismatic", "FIXED": "fixed"}
genesis.init(backend=genesis.cpu, logging_level="error")


def numbers(tensor) -> np.ndarray:
    return np.asarray(torch.as_tensor(tensor).cpu(), float).reshape(-1)


def read(asset: Asset, variant: str) -> dict:
    scene = genesis.Scene(show_viewer=False)
    if variant == "genesis":
        shape = genesis.morphs.MJCF(file=str(asset.file(variant)))
    else:
        shape = genesis.morphs.URDF(file=str(asset.file(variant)), fixed=True, default_armature=0.0, merge_fixed_links=False)
    body = scene.add_entity(shape)
    scene.build()

    def poses() -> dict[str, np.ndarray]:
        found = {}
        for link in body.links:
            w, x, y, z = numbers(link.get_quat())
            found[link.name] = frame(numbers(link.get_pos()), turn_of(x, y, z, w))
        return {name: np.linalg.inv(found[asset.root]) @ T for name, T in found.items()}

    rest, links, joints = poses(), {}, {}
    masses, centers = numbers(body.get_links_mass()), numbers(body.get_links_COM()).reshape(-1, 3)
    tensors = numbers(body.get_links_inertia()).reshape(-1, 3, 3)
    for link, mass, center, tensor in zip(body.links, masses, centers, tensors, strict=True):
        w, x, y, z = numbers(link.desc.inertial_quat)
        links[link.name] = placed(rest[link.name], mass, center, tensor, turn_of(x, y, z, w))
    lower, upper = (numbers(end) for end in body.get_dofs_limit())
    held = {"damping": body.get_dofs_damping(), "friction": body.get_dofs_frictionloss(), "armature": body.get_dofs_armature()}
    held = {key: numbers(column) for key, column in held.items()} | {"effort": numbers(body.get_dofs_force_range()[1])}
    for joint in body.joints:
        parent = next((link.name for link in body.links if link.idx == joint.link.parent_idx), None)
        if parent is None or joint.name not in asset.joints:
            continue
        record = joints[joint.name] = {"type": KINDS[joint.type.name], "parent": parent, "child": joint.link.name}
        if joint.n_dofs == 0:
            continue
        k, amount = joint.dofs_idx_local[0], asset.amount(joint.name)
        body.set_dofs_position(np.array([amount], np.float32), [k])
        record |= motion(rest[joint.link.name], poses()[joint.link.name], amount)
        body.set_dofs_position(np.zeros(1, np.float32), [k])
        limits = finite(lower[k], upper[k])
        if limits is None and record["type"] == "revolute":
            record["type"] = "continuous"
        record |= {"limits": limits} | {key: column[k] for key, column in held.items()}
    return {"version": f"Genesis {version('genesis-world')}", "joints": joints, "links": links}


serve(read)
