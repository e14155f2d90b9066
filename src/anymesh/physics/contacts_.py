"""Contacts between collision shapes of different links at given joint positions, by MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.mujoco_ import load_mujoco
from anymesh.physics.convex import as_hull
from anymesh.types import Box, Brief, Cylinder, Shape

Pose = Mapping[str, Float[np.ndarray, "4 4"]]  # pose of the frame of each link


@dataclass(frozen=True, eq=False)
class Contact(Brief):
    """The deepest contact of two shapes of different links.

    first, second: (link, index of its shape); depth [m]; normal: unit, from the first to the second, in the frame of the poses;
    point: in the same frame [m].
    """

    first: tuple[str, int]
    second: tuple[str, int]
    depth: float
    normal: Float[np.ndarray, " 3"]
    point: Float[np.ndarray, " 3"]


class ContactBench:
    """The shapes of all links, at any poses. All pairs of links may touch except those in `excluded`.

    margin: distance from which shapes count as touching, with a negative depth [m].
    """

    def __init__(
        self, shapes: Mapping[str, Sequence[Shape]], excluded: Sequence[tuple[str, str]] = (), margin: float = 0.0
    ) -> None:
        mujoco = load_mujoco()
        spec = mujoco.MjSpec()
        spec.memory = 1 << 28
        self._owner: list[tuple[str, int]] = []
        for link, some in shapes.items():
            body = spec.worldbody.add_body(name=link)
            body.add_freejoint()  # MuJoCo skips pairs of bodies that cannot move
            # has no effect here, but shapes may be too small for the default
            body.mass, body.inertia, body.explicitinertial = 1.0, np.ones(3), True
            for number, shape in enumerate(some):
                _add(mujoco, spec, body, f"{link} {number}", shape)
                self._owner.append((link, number))
        for geom in spec.geoms:
            geom.margin = margin
        for a, b in excluded:
            spec.add_exclude(bodyname1=a, bodyname2=b)
        self._mujoco, self._model = mujoco, spec.compile()
        self._data = mujoco.MjData(self._model)
        self._placed: dict[str, np.ndarray] = {}  # last pose of each link; poses share the transforms of static links
        self._address = {link: int(self._model.jnt_qposadr[self._model.body(link).jntadr[0]]) for link in shapes}

    def contacts(self, pose: Pose, least: float) -> list[Contact]:
        """Return all pairs of shapes that penetrate by more than `least` [m], in the order of the shapes."""
        mujoco, model, data = self._mujoco, self._model, self._data
        quat = np.zeros(4)
        for link, k in self._address.items():
            if self._placed.get(link) is pose[link]:
                continue
            mujoco.mju_mat2Quat(quat, np.ascontiguousarray(pose[link][:3, :3]).reshape(-1))
            data.qpos[k : k + 3], data.qpos[k + 3 : k + 7] = pose[link][:3, 3], quat
            self._placed[link] = pose[link]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        contacts = data.contact
        depth, pair = -np.asarray(contacts.dist), np.asarray(contacts.geom)
        deep = np.flatnonzero(depth > least)
        if not len(deep):
            return []
        order = deep[np.lexsort((deep, -depth[deep], pair[deep, 1], pair[deep, 0]))]
        first = np.r_[True, (np.diff(pair[order], axis=0) != 0).any(1)][: len(order)]
        return [
            Contact(*(self._owner[g] for g in pair[k]), float(depth[k]), contacts.frame[k, :3].copy(), contacts.pos[k].copy())
            for k in order[first]
        ]


def _add(mujoco: Any, spec: Any, body: Any, name: str, shape: Shape) -> None:
    quat = np.zeros(4)
    if isinstance(shape, Box | Cylinder):
        mujoco.mju_mat2Quat(quat, np.ascontiguousarray(shape.rotation).reshape(-1))
    match shape:
        case Box():
            size, kind = shape.size / 2, mujoco.mjtGeom.mjGEOM_BOX
        case Cylinder():
            size = np.array([shape.radius, shape.length / 2, 0])
            kind = mujoco.mjtGeom.mjGEOM_CYLINDER
        case _:
            hull = as_hull(shape)
            mesh = spec.add_mesh(name=name)
            mesh.uservert, mesh.userface = hull.vertices.reshape(-1), hull.faces.reshape(-1).astype(np.int32)
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name)
            return
    body.add_geom(type=kind, size=size, pos=shape.center, quat=quat)
