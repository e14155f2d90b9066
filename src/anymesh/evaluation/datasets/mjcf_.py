"""Articulated MJCF files as objects with known joints, by MuJoCo's own compiler (the extra `sim`).

An object is a child body of the world with all its descendants, if they contain at least one hinge or slide joint; free joints
do not count. If such a body itself rotates or slides against the world, the world's own geoms (without planes) are its base.
The visuals of a body are its geoms that collide with nothing (contype = conaffinity = 0), or all geoms if there are none.
If a body has several joints, the last one is used. A given range is used even if it is not enforced. The rest pose is that of
the file (qpos0).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.evaluation.datasets.dataset_links import Y_UP, DatasetLink, assemble, moved
from anymesh.evaluation.datasets.mjcf_materials_ import GeomMaterials
from anymesh.evaluation.datasets.mjcf_reading_ import compile_mjcf
from anymesh.evaluation.ground_truth import GroundTruth
from anymesh.mujoco_ import load_mujoco
from anymesh.names import legal_name
from anymesh.types import JointType, KnownJoint, Mesh

mujoco = load_mujoco()

TYPES = {int(mujoco.mjtJoint.mjJNT_HINGE): JointType.REVOLUTE, int(mujoco.mjtJoint.mjJNT_SLIDE): JointType.PRISMATIC}
WORLD = 0
ENDLESS = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))  # grounds, not objects


@dataclass(frozen=True, eq=False)
class MjcfModel:
    """A compiled file at rest. Raises InputError if MuJoCo rejects it."""

    path: Path

    @cached_property
    def model(self) -> Any:
        return compile_mjcf(self.path)

    @cached_property
    def data(self) -> Any:
        data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, data)
        return data

    @cached_property
    def _looks(self) -> GeomMaterials:
        return GeomMaterials(self.model)

    def objects(self) -> dict[str, list[int]]:
        """Return object name -> its bodies, the static one first."""
        m = self.model
        trees: dict[int, list[int]] = {}
        for body in range(1, m.nbody):
            trees.setdefault(int(m.body_rootid[body]), []).append(body)
        moving = {root: tree for root, tree in trees.items() if any(self._joint(b) is not None for b in tree)}
        held = {root: tree for root, tree in moving.items() if self._joint(root) is not None}
        groups = {root: tree for root, tree in moving.items() if root not in held}
        if held:
            groups[WORLD] = [WORLD, *(b for tree in held.values() for b in tree)]
        groups = {root: tree for root, tree in groups.items() if self._moves(tree)}
        stem = object_stem(self.path)
        if len(groups) == 1:
            return {stem: next(iter(groups.values()))}
        return {f"{stem}-{legal_name(m.body(root).name or f'body{root}')}": tree for root, tree in sorted(groups.items())}

    def _moves(self, tree: list[int]) -> bool:
        """Return whether a visible part moves against another visible one."""
        head: dict[int, int] = {}
        for body in tree:  # parents come first
            fixed = body != tree[0] and self._joint(body) is None
            head[body] = head[int(self.model.body_parentid[body])] if fixed else body
        return len({head[body] for body in tree if self._shown(body)}) > 1

    def truth(self, own: str, folder: Path, name: str) -> GroundTruth:
        """Write the object `own` of this file as `name`.glb to `folder`. Raise InputError if nothing is visible."""
        tree = self.objects()[own]
        bodies = [moved(self._body(b, b == tree[0]), Y_UP) for b in tree]
        return assemble(name, bodies, folder / f"{name}.glb")

    def _joint(self, body: int) -> int | None:
        """Return the last hinge or slide joint of a body."""
        first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
        own = [j for j in range(first, first + count) if int(self.model.jnt_type[j]) in TYPES]
        return own[-1] if own else None

    def _body(self, body: int, root: bool) -> DatasetLink:
        """Return the body as a link in the world's frame, Z up."""
        m = self.model
        name, parent = self._name(body), None if root else self._name(int(m.body_parentid[body]))
        joint = None if root else self._joint(body)
        return DatasetLink(name, parent, None if joint is None else self._motion(joint), tuple(self._meshes(body)))

    def _name(self, body: int) -> str:
        return self.model.body(body).name or f"body{body}"

    def _motion(self, joint: int) -> KnownJoint:
        m, d = self.model, self.data
        limits, (lower, upper) = None, m.jnt_range[joint]
        if lower < upper:
            rest = float(m.qpos0[m.jnt_qposadr[joint]])
            limits = (float(lower) - rest, float(upper) - rest)
        kind = TYPES[int(m.jnt_type[joint])]
        endless = limits is None and kind is JointType.REVOLUTE
        kind = JointType.CONTINUOUS if endless else kind
        return KnownJoint(kind, d.xanchor[joint].copy(), d.xaxis[joint].copy(), limits, endless or limits is not None)

    def _meshes(self, body: int) -> Iterator[Mesh]:
        for geom in self._shown(body):
            T = np.eye(4)
            T[:3, :3], T[:3, 3] = self.data.geom_xmat[geom].reshape(3, 3), self.data.geom_xpos[geom]
            yield self._looks.mesh(geom).transformed(T)

    def _shown(self, body: int) -> list[int]:
        """Return the geoms that show a body."""
        m = self.model
        first = int(m.body_geomadr[body])
        geoms = [g for g in range(first, first + int(m.body_geomnum[body])) if int(m.geom_type[g]) not in ENDLESS]
        return [g for g in geoms if not m.geom_contype[g] and not m.geom_conaffinity[g]] or geoms


def object_stem(path: Path) -> str:
    """Return the common prefix of the names of a file's objects."""
    return legal_name(path.stem, fallback="object")
