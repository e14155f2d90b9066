"""PyBullet, from the URDF, with the inertia of the file."""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
import pybullet
from common import Asset, finite, frame, motion, placed, serve, turn_of

KINDS = {pybullet.JOINT_REVOLUTE: "revolute", pybullet.JOINT_PRISMATIC: "prismatic", pybullet.JOINT_FIXED: "fixed"}


def read(asset: Asset, variant: str) -> dict:
    pybullet.connect(pybullet.DIRECT)
    body = pybullet.loadURDF(str(asset.file("urdf")), useFixedBase=True, flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
    names = {-1: asset.root}
    infos = [pybullet.getJointInfo(body, k) for k in range(pybullet.getNumJoints(body))]
    names |= {info[0]: info[12].decode() for info in infos}

    def pose(link: int) -> np.ndarray:
        if link < 0:  # what it tells of the base is the frame of its inertia
            dynamics = pybullet.getDynamicsInfo(body, -1)
            at, turn = pybullet.getBasePositionAndOrientation(body)
            return frame(at, turn_of(*turn)) @ np.linalg.inv(frame(dynamics[3], turn_of(*dynamics[4])))
        state = pybullet.getLinkState(body, link, computeForwardKinematics=1)
        return np.linalg.inv(pose(-1)) @ frame(state[4], turn_of(*state[5]))

    rest = {k: pose(k) for k in names if k >= 0} | {-1: np.eye(4)}
    links = {}
    for k, name in names.items():
        mass, _, diagonal, at, turn = pybullet.getDynamicsInfo(body, k)[:5]
        links[name] = placed(rest[k], mass, at, diagonal, turn_of(*turn))
    joints = {}
    for info in infos:
        name, k, kind = info[1].decode(), info[0], KINDS[info[2]]
        record = joints[name] = {"type": kind, "parent": names[info[16]], "child": names[k]}
        if kind == "fixed":
            continue
        amount = asset.amount(name)
        pybullet.resetJointState(body, k, amount)
        record |= motion(rest[k], pose(k), amount)
        pybullet.resetJointState(body, k, 0)
        limits = finite(info[8], info[9])
        if limits is None and kind == "revolute":
            record["type"] = "continuous"
        record |= {"limits": limits, "damping": info[6], "friction": info[7], "effort": info[10], "velocity": info[11]}
    pybullet.disconnect()
    return {"version": f"PyBullet {version('pybullet')}", "joints": joints, "links": links}


serve(read)
