"""SAPIEN 3 (PhysX on the CPU). Visuals are removed from its input, because they need a graphics device."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, engine_version, finite_limits, load_engine
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError


def without_visuals(path: Path) -> str:
    """Return the text of a URDF without visuals, and with absolute paths of collision meshes."""
    root = ElementTree.fromstring(path.read_bytes())
    for link in root.iter("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    for mesh in root.iter("mesh"):
        file = mesh.get("filename") or ""
        if "://" not in file:
            mesh.set("filename", str((path.parent / file).resolve()))
    return ElementTree.tostring(root, encoding="unicode")


class World:
    """The asset of a URDF in SAPIEN. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        sapien = load_engine("sapien", shown="SAPIEN", extra="sapien")
        self.engine = engine_version("sapien", "sapien")
        physics = sapien.physx.PhysxCpuSystem()
        self.scene = sapien.Scene([physics])
        physics.config.gravity = np.zeros(3)
        physics.timestep = STEP
        loader = self.scene.create_urdf_loader()
        loader.fix_root_link = True
        with tempfile.TemporaryDirectory() as folder:
            bare = Path(folder) / path.name
            bare.write_text(without_visuals(path), encoding="utf-8")
            try:
                bodies, _ = loader.load_multiple(str(bare))
            except Exception as error:  # it passes on many types of errors of its parsers
                raise InputError(f"SAPIEN cannot load {path}: {type(error).__name__}: {error}") from error
        self.body: Any = next(iter(bodies), None)  # one link alone is none of SAPIEN's articulations
        links = () if self.body is None else self.body.links
        for link in links:
            link.disable_gravity = True
        self.active = () if self.body is None else tuple(self.body.active_joints)
        self.limits = {j.name: _limits(j) for j in self.active}
        self.damping = [j.damping for j in self.active]  # of the file, in SAPIEN a drive without stiffness
        for joint in self.active:
            motor = motors[joint.name]
            joint.set_drive_properties(motor.stiffness, motor.damping, motor.effort, "force")
        self.links = {link.name: link for link in links}

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.body.set_qpos(positions)
        self.body.set_qvel(np.zeros(len(self.active)))

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        for joint, target in zip(self.active, targets, strict=True):
            joint.set_drive_target(float(target))
        self.scene.step()

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        for joint, damping in zip(self.active, self.damping, strict=True):
            joint.set_drive_properties(0.0, damping)
        self.body.set_qf(forces)
        self.scene.step()

    def positions(self) -> Float[np.ndarray, " n"]:
        return np.array(self.body.get_qpos(), float)

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        root = self.body.root.entity_pose.to_transformation_matrix()
        return np.linalg.inv(root) @ self.links[link].entity_pose.to_transformation_matrix()


def _limits(joint: Any) -> Limits:
    return finite_limits(*np.asarray(joint.limits).reshape(-1)[:2])
