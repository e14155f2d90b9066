"""SAPIEN 3 (PhysX on the CPU). Visuals are removed from its input, because they need a graphics device."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, ReadBack, drive
from anymesh.checking.engines.motors import Motor, motors_of, readable
from anymesh.checking.engines.outside import engine_version, load_engine
from anymesh.checking.engines.report import SweepReport
from anymesh.checking.engines.urdf import read_urdf
from anymesh.errors import InputError


def sweep_joints(path: Path) -> SweepReport:
    """Drive every joint of a URDF over its range. Raise InputError if SAPIEN cannot load it, MissingExtraError without it."""
    sapien = load_engine("sapien", shown="SAPIEN", extra="sapien")
    robot = readable(read_urdf(path))
    return drive(_World(sapien, Path(path), motors_of(robot)), robot)


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


class _World:
    def __init__(self, sapien: Any, path: Path, motors: tuple[Motor, ...]) -> None:
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
                self.body = loader.load(str(bare))
            except Exception as error:  # it passes on many types of errors of its parsers
                raise InputError(f"SAPIEN cannot load {path}: {type(error).__name__}: {error}") from error
        for link in self.body.links:
            link.disable_gravity = True
        self.active = list(self.body.active_joints)
        by_name = {m.joint: m for m in motors}
        self.joints = [ReadBack(j.name, j.child_link.name, _limits(j)) for j in self.active]
        for joint in self.active:
            motor = by_name[joint.name]
            joint.set_drive_properties(motor.stiffness, motor.damping, motor.effort, "force")
        self.links = {link.name: link for link in self.body.links}

    def reset(self) -> None:
        self.body.set_qpos(np.zeros(len(self.active)))
        self.body.set_qvel(np.zeros(len(self.active)))

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        for joint, target in zip(self.active, targets, strict=True):
            joint.set_drive_target(float(target))
        self.scene.step()

    def positions(self) -> Float[np.ndarray, " n"]:
        return np.array(self.body.get_qpos(), float)

    def _placed(self, link: str) -> Float[np.ndarray, "4 4"]:
        root = self.body.root.entity_pose.to_transformation_matrix()
        return np.linalg.inv(root) @ self.links[link].entity_pose.to_transformation_matrix()

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        return self._placed(link)[:3, 3]

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        return self._placed(link)[:3, :3]


def _limits(joint: Any) -> tuple[float, float] | None:
    lower, upper = (float(v) for v in np.asarray(joint.limits).reshape(-1)[:2])
    return (lower, upper) if np.isfinite([lower, upper]).all() else None
