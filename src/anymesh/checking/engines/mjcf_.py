"""MJCF files as links and joints, from the model compiled by MuJoCo.

A link's frame is at the anchor of its joint, with the axes of the body at rest. Several joints of one body become links without
shapes between them. Positions are relative to the rest pose of the file (its `ref`).
"""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.locate import find_file
from anymesh.checking.engines.robot import Geometry, Inertial, Robot, RobotJoint, RobotLink, shape_triangles
from anymesh.errors import InputError
from anymesh.formats.in_metres import read_in_metres
from anymesh.mujoco_ import load_mujoco, name_elements
from anymesh.types import Mimic

READ = (".obj", ".stl", ".msh")  # mesh formats that MuJoCo reads


@contextmanager
def load_errors(mujoco: Any, path: Path) -> Generator[None]:
    """Turn MuJoCo's errors about a file into InputError."""
    try:
        yield
    except (ValueError, mujoco.FatalError, InputError) as error:
        raise InputError(f"MuJoCo cannot load {path}: {' '.join(str(error).split())}") from error


def read_spec(mujoco: Any, path: Path) -> Any:
    """Read the file as an editable model, with package:// resolved, and meshes of other formats inserted as data.

    Raise ValueError or InputError if it cannot be read.
    """
    spec = mujoco.MjSpec.from_file(str(path))
    folder = path.parent / spec.meshdir
    for mesh in spec.meshes:
        if not mesh.file or (Path(mesh.file).suffix.lower() in READ and "://" not in mesh.file):
            continue
        mesh_path = find_file(mesh.file, folder)
        if mesh_path is None:
            raise InputError(f"the mesh {mesh.file} is not there")
        if mesh_path.suffix.lower() in READ:
            mesh.file = str(mesh_path.resolve())
        else:
            content = read_in_metres(mesh_path, None)[0]
            mesh.file, mesh.uservert, mesh.userface = "", content.vertices.reshape(-1), content.faces.reshape(-1)
    return spec


def without_ground(spec: Any, mujoco: Any) -> None:
    """Let planes and height fields of the world touch nothing: they are no part of an asset."""
    for geom in spec.worldbody.geoms:
        if geom.type in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD):
            geom.contype = geom.conaffinity = 0


def read_mjcf(path: Path) -> Robot:
    """Read the links and joints of an MJCF. Raise InputError if MuJoCo rejects it, MissingExtraError without MuJoCo."""
    mujoco = load_mujoco()
    path = Path(path)
    with load_errors(mujoco, path):
        spec = read_spec(mujoco, path)
        spec.compiler.fusestatic = False
        for mesh in spec.meshes:
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # flat visuals have no volume
        name_elements(spec)
        model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pictures = tuple(str(Path(spec.texturedir) / t.file) for t in spec.textures if t.file)
    return _Reader(mujoco, model, data).robot(path, spec.modelname, pictures)


class _Reader:
    def __init__(self, mujoco: Any, model: Any, data: Any) -> None:
        self.mujoco, self.model, self.data = mujoco, model, data
        self.kinds = {
            int(mujoco.mjtJoint.mjJNT_HINGE): "revolute",
            int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic",
            int(mujoco.mjtJoint.mjJNT_BALL): "ball",
            int(mujoco.mjtJoint.mjJNT_FREE): "floating",
        }
        self.flat = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))  # the ground
        self.frames = {b: self._frame(b) for b in range(model.nbody)}

    def robot(self, path: Path, name: str, pictures: tuple[str, ...]) -> Robot:
        links: list[RobotLink] = []
        joints: list[RobotJoint] = []
        for body in range(0 if self._world_counts() else 1, self.model.nbody):
            parent = int(self.model.body_parentid[body])
            shown, met = self._shapes(body)
            links.append(RobotLink(self._name(body), shown, met, self._inertial(body)))
            if body == 0 or (parent == 0 and not self._world_counts()):
                continue
            added = self._joints(body, parent)
            joints += added
            links += [RobotLink(j.child) for j in added[:-1]]
        pairs = [(int(s) >> 16, int(s) & 0xFFFF) for s in self.model.exclude_signature]
        excluded = frozenset(frozenset((self._name(a), self._name(b))) for a, b in pairs)
        return Robot(path, name, tuple(links), tuple(joints), excluded, pictures=pictures, format="MJCF")

    def _world_counts(self) -> bool:
        """Return whether the world is a link: it has shapes, several bodies, or a body with joints to it."""
        tops = [b for b in range(1, self.model.nbody) if self.model.body_parentid[b] == 0]
        held = [self._kind(j) for b in tops for j in self._of(b)]
        solid = any(int(t) not in self.flat for t in self.model.geom_type[: int(self.model.body_geomnum[0])])
        return len(tops) != 1 or solid or any(kind != "floating" for kind in held)

    def _name(self, body: int) -> str:
        return self.model.body(body).name

    def _of(self, body: int) -> range:
        first = int(self.model.body_jntadr[body])
        return range(first, first + int(self.model.body_jntnum[body])) if first >= 0 else range(0)

    def _kind(self, joint: int) -> str:
        return self.kinds[int(self.model.jnt_type[joint])]

    def _frame(self, body: int, joint: int | None = None) -> Float[np.ndarray, "4 4"]:
        """Return the pose of a link in the world at rest."""
        own = [j for j in self._of(body) if self._kind(j) != "floating"]
        chosen = joint if joint is not None else (own[-1] if own else None)
        T = np.eye(4)
        T[:3, :3] = self.data.xmat[body].reshape(3, 3)
        T[:3, 3] = self.data.xpos[body] if chosen is None else self.data.xanchor[chosen]
        return T

    def _joints(self, body: int, parent: int) -> list[RobotJoint]:
        own, name, at, before = list(self._of(body)), self._name(body), self.frames[parent], self._name(parent)
        if not own:
            return [RobotJoint(f"{name}_fixed", "fixed", before, name, np.linalg.inv(at) @ self.frames[body], np.eye(3)[2])]
        joints = []
        for joint in own:
            label, T = self.model.joint(joint).name, self._frame(body, joint)
            child = name if joint == own[-1] else f"{name}__{label}"
            kind, limits = self._kind(joint), None
            if self.model.jnt_limited[joint]:
                low, high = self.model.jnt_range[joint] - self.model.qpos0[self.model.jnt_qposadr[joint]]
                limits = (float(low), float(high))
            elif kind == "revolute":
                kind = "continuous"
            axis = T[:3, :3].T @ self.data.xaxis[joint]
            dof = self.model.jnt_dofadr[joint]
            resisting = {
                "friction": float(self.model.dof_frictionloss[dof]),
                "damping": float(self.model.dof_damping[dof]),
                "armature": float(self.model.dof_armature[dof]),
            }
            mimic = self._mimic(joint)
            joints.append(RobotJoint(label, kind, before, child, np.linalg.inv(at) @ T, axis, limits, mimic=mimic, **resisting))
            at, before = T, child
        return joints

    def _mimic(self, joint: int) -> Mimic | None:
        """Return how an equality lets a joint follow another one; None if none does, or not linearly."""
        for e in range(self.model.neq):
            kind, values = self.model.eq_type[e], self.model.eq_data[e]
            couples = kind == self.mujoco.mjtEq.mjEQ_JOINT and self.model.eq_obj2id[e] >= 0 and self.model.eq_active0[e]
            if couples and self.model.eq_obj1id[e] == joint and not values[2:5].any():
                return Mimic(self.model.joint(int(self.model.eq_obj2id[e])).name, float(values[1]), float(values[0]))
        return None

    def _inertial(self, body: int) -> Inertial | None:
        mass = float(self.model.body_mass[body])
        if mass <= 0:
            return None
        link, turn = self.frames[body], self.data.ximat[body].reshape(3, 3)
        turn = link[:3, :3].T @ turn
        center = link[:3, :3].T @ (self.data.xipos[body] - link[:3, 3])
        return Inertial(mass, center, turn @ np.diag(self.model.body_inertia[body]) @ turn.T)

    def _shapes(self, body: int) -> tuple[tuple[Geometry, ...], tuple[Geometry, ...]]:
        """Return visual and collision shapes; without visual-only shapes, the collision shapes are the visuals."""
        first, count = int(self.model.body_geomadr[body]), int(self.model.body_geomnum[body])
        shown, met = [], []
        for geom in range(first, first + count) if count else ():
            T = np.eye(4)
            T[:3, :3], T[:3, 3] = self.data.geom_xmat[geom].reshape(3, 3), self.data.geom_xpos[geom]
            shape = geom_shape(self.mujoco, self.model, geom, np.linalg.inv(self.frames[body]) @ T)
            if shape is not None:
                collides = self.model.geom_contype[geom] or self.model.geom_conaffinity[geom]
                (met if collides else shown).append(shape)
        return tuple(shown or met), tuple(met)


def geom_shape(mujoco: Any, model: Any, geom: int, T: Float[np.ndarray, "4 4"]) -> Geometry | None:
    """Return the shape of a geom whose pose is T; None for planes and height fields, which have no finite surface."""
    kinds, kind = mujoco.mjtGeom, int(model.geom_type[geom])
    size = [float(v) for v in model.geom_size[geom]]
    if kind == int(kinds.mjGEOM_MESH):
        mesh = int(model.geom_dataid[geom])
        start, faces = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
        points = model.mesh_vert[start : start + int(model.mesh_vertnum[mesh])].astype(float)
        triangles = points[model.mesh_face[faces : faces + int(model.mesh_facenum[mesh])]]
        return Geometry("mesh", T, file=model.mesh(mesh).name, triangles=triangles @ T[:3, :3].T + T[:3, 3])
    if kind == int(kinds.mjGEOM_BOX):
        return Geometry("box", T, tuple(2 * v for v in size))
    if kind in (int(kinds.mjGEOM_CYLINDER), int(kinds.mjGEOM_CAPSULE)):
        return Geometry("cylinder" if kind == int(kinds.mjGEOM_CYLINDER) else "capsule", T, (size[0], 2 * size[1]))
    if kind == int(kinds.mjGEOM_SPHERE):
        return Geometry("sphere", T, (size[0],))
    if kind == int(kinds.mjGEOM_ELLIPSOID):
        unit = shape_triangles(Geometry("sphere", np.eye(4), (1.0,))) * size
        return Geometry("ellipsoid", T, tuple(size), triangles=unit @ T[:3, :3].T + T[:3, 3])
    return None
