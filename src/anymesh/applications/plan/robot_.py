"""Robot files as an editable MuJoCo model: the joints of the arm, those of the gripper, and their actuators.

Where the robot's file has none, position servos are added.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.applications.plan.robot_packages_ import RobotFiles
from anymesh.checking.engines.locate import find_file
from anymesh.errors import InputError, OptionError
from anymesh.mujoco_ import load_mujoco, name_elements
from anymesh.types import Brief

STIFFNESS = 50.0  # [1/rad] over the effort limit: full effort at a lag of 0.02 rad, as in MuJoCo Menagerie's Panda
DAMPING = 0.1  # [s] damping over stiffness
ARMATURE, FRICTION_DAMPING = 0.1, 1.0  # [kg m2], [N m s/rad] for joints of a URDF, which states no rotor inertia
FINGER_STIFFNESS, FINGER_DAMPING = 400.0, 20.0  # [1/m], [s/m] over the closing force: full force from 2.5 mm on
USUAL_EFFORT = 50.0  # [N m] if a file states none
USUAL_VELOCITY, USUAL_ACCELERATION, DEFAULT_CLOSING_FORCE = 1.0, 2.0, 40.0  # used if a file states none
HAND = "hand_"  # prefix of the names of a mounted gripper


@dataclass(frozen=True, eq=False)
class RobotArm(Brief):
    """Arm with a gripper, alone at the origin.

    xml, assets: the whole model, whose first actuators are one per joint of the arm, in order; joints: of the arm; fingers: of
    the gripper; root: the base link; wrist: the last body that the arm moves; home: (J,) [rad]; limits: (J, 2) [rad];
    velocity, acceleration: (J,) limits [rad/s, rad/s2]; lag: (J,) of the servos per unit of speed [s];
    opened, closed: controls of the gripper's actuators; mesh_files: whether the visual meshes exist.
    """

    name: str
    spec: Any
    joints: tuple[str, ...]
    fingers: tuple[str, ...]
    root: str
    wrist: str
    home: Float[np.ndarray, " J"]
    limits: Float[np.ndarray, "J 2"]
    velocity: Float[np.ndarray, " J"]
    acceleration: Float[np.ndarray, " J"]
    lag: Float[np.ndarray, " J"]
    closing_force: float


def load_robot(files: RobotFiles, *, tool: str | None = None, gripper: Sequence[str] = ()) -> RobotArm:
    """Load an arm with its gripper, which begins where the kinematic tree branches.

    tool: a body of the hand, for robots whose tree branches elsewhere (two arms, a head); gripper: names of the gripper's
    joints. Raise InputError if MuJoCo cannot load the files, OptionError if no arm is found.
    """
    mujoco = load_mujoco()
    velocity = _urdf_velocities(files.arm)
    try:
        spec = _read(mujoco, files.arm)
        if files.hand is not None and files.preset is not None:
            _mount(spec, _read(mujoco, files.hand), files.preset.site)
        name_elements(spec)
        model = without_visuals(spec).compile()
    except (ValueError, mujoco.FatalError, OSError) as error:
        raise InputError(f"MuJoCo cannot load the robot {files.name}: {' '.join(str(error).split())}") from error
    arm, fingers = _split(model, files.name, tool, gripper)
    names = tuple(model.joint(j).name for j in arm)
    limits = np.where(model.jnt_limited[arm, None].astype(bool), model.jnt_range[arm], (-np.pi, np.pi))
    preset = files.preset
    home = np.array(preset.home) if preset is not None else _home(spec, model, arm, limits)
    count = len(arm)
    speeds = np.array(preset.velocity if preset is not None else [velocity.get(n, USUAL_VELOCITY) for n in names], float)
    pushes = np.array(preset.acceleration if preset is not None else [USUAL_ACCELERATION] * count, float)
    closing_force = preset.closing_force if preset is not None else DEFAULT_CLOSING_FORCE
    lag = add_servos(mujoco, spec, model, arm, fingers, closing_force)
    chain = [int(model.jnt_bodyid[j]) for j in arm]
    root = chain[0]
    while model.body_parentid[root]:
        root = int(model.body_parentid[root])
    while len(spec.keys):
        spec.delete(spec.keys[0])
    return RobotArm(
        files.name,
        spec,
        names,
        tuple(model.joint(j).name for j in fingers),
        model.body(root).name,
        model.body(chain[-1]).name,
        home,
        limits,
        speeds,
        pushes,
        lag,
        closing_force,
    )


def quaternion(R: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, " 4"]:
    """Return a rotation as MuJoCo writes it: w, x, y, z."""
    quat = np.zeros(4)
    load_mujoco().mju_mat2Quat(quat, np.ascontiguousarray(R, float).reshape(-1))
    return quat


def positions_of(model: Any, joints: Sequence[str], prefix: str = "") -> Int[np.ndarray, " n"]:
    """Return where the positions of joints are in `qpos`. prefix: of the names in the model."""
    return np.array([int(model.joint(prefix + name).qposadr[0]) for name in joints], int)


def single_joints(model: Any) -> list[int]:
    """Return the numbers of the hinges and slides of a model."""
    kinds = load_mujoco().mjtJoint
    return [j for j in range(model.njnt) if int(model.jnt_type[j]) in (int(kinds.mjJNT_HINGE), int(kinds.mjJNT_SLIDE))]


def bodies_below(model: Any, bodies: Iterable[int]) -> Bool[np.ndarray, " b"]:
    """Return whether each body is one of these or carried by one of them."""
    below = np.isin(np.arange(model.nbody), list(bodies))
    for body in range(1, model.nbody):  # parents come first
        below[body] |= below[int(model.body_parentid[body])]
    return below


def finger_bodies(model: Any, joints: Sequence[str], prefix: str = "") -> Bool[np.ndarray, " b"]:
    """Return whether each body is moved by the joints of a gripper."""
    return bodies_below(model, [int(model.joint(prefix + name).bodyid[0]) for name in joints])


def without_visuals(spec: Any) -> Any:
    """Copy a spec without visual geoms and the meshes that only they use, so that it compiles in milliseconds."""
    bare = spec.copy()
    for geom in [g for g in bare.geoms if not (g.contype or g.conaffinity)]:
        bare.delete(geom)
    used = {g.meshname for g in bare.geoms}
    for mesh in [m for m in bare.meshes if m.name not in used]:
        bare.delete(mesh)
    for geom in bare.geoms:
        geom.material = ""
    for look in (*bare.materials, *bare.textures):
        bare.delete(look)
    return bare


def add_servos(
    mujoco: Any, spec: Any, model: Any, arm: Sequence[int], fingers: Sequence[int], closing_force: float
) -> Float[np.ndarray, " J"]:
    """Add position servos to joints of the arm without one and to a gripper without actuators; return the servos' lag [s]."""
    servo = int(mujoco.mjtBias.mjBIAS_AFFINE)
    at: dict[int, Any] = {}
    drives_fingers = False
    for number, actuator in enumerate(list(spec.actuators)):
        joint = int(model.actuator_trnid[number, 0])
        on_joint = int(model.actuator_trntype[number]) == int(mujoco.mjtTrn.mjTRN_JOINT)
        if on_joint and joint in arm:
            if int(model.actuator_biastype[number]) == servo:
                at[joint] = actuator
            else:
                spec.delete(actuator)
        else:
            drives_fingers = True
    lag = []
    for joint in arm:
        name = model.joint(joint).name
        if joint not in at:
            effort = float(model.jnt_actfrcrange[joint, 1]) if model.jnt_actfrclimited[joint] else USUAL_EFFORT
            at[joint] = add_servo(spec, name, effort * STIFFNESS, effort * STIFFNESS * DAMPING, effort)
            made = spec.joint(name)
            made.armature = max(float(made.armature), ARMATURE)
            made.damping = [max(float(np.ravel(made.damping)[0]), FRICTION_DAMPING), 0, 0]
        lag.append(float(-at[joint].biasprm[2] / at[joint].gainprm[0]))
    if not drives_fingers:
        for joint in fingers:
            force = closing_force / max(len(fingers), 1)
            add_servo(spec, model.joint(joint).name, force * FINGER_STIFFNESS, force * FINGER_DAMPING, force)
            spec.joint(model.joint(joint).name).armature = ARMATURE
    return np.array(lag)


def add_servo(spec: Any, joint: str, stiffness: float, damping: float, effort: float) -> Any:
    """Add a position servo to a joint: stiffness, damping, and the limit of its force, in units of the joint."""
    servo = spec.add_actuator(name=joint, target=joint, trntype=load_mujoco().mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)
    servo.forcelimited, servo.forcerange = 1, [-effort, effort]
    return servo


def _read(mujoco: Any, path: Path) -> Any:
    """Read an MJCF unchanged, or a URDF with its visuals and fixed links but without meshes that MuJoCo cannot read."""
    if not re.search(rb"<robot[\s>]", path.read_bytes()[:100_000]):
        return mujoco.MjSpec.from_file(str(path))
    root = ElementTree.parse(path).getroot()
    settings = ElementTree.SubElement(root, "mujoco")
    ElementTree.SubElement(settings, "compiler", discardvisual="false", fusestatic="false", strippath="false")
    for link in root.findall("link"):
        _resolve(link, path.parent)
    return mujoco.MjSpec.from_string(ElementTree.tostring(root, encoding="unicode"))


def _resolve(link: ElementTree.Element, folder: Path) -> None:
    """Resolve mesh files; replace a visual that MuJoCo cannot read by the collision shape."""
    dropped = False
    for shape in [*link.findall("visual"), *link.findall("collision")]:
        mesh = shape.find("geometry/mesh")
        if mesh is None:
            continue
        mesh_path = find_file(mesh.get("filename") or "", folder)
        readable = mesh_path is not None and mesh_path.suffix.lower() in (".stl", ".obj", ".msh")
        if mesh_path is not None and readable:
            mesh.set("filename", str(mesh_path.resolve()))
        elif shape.tag == "visual":
            link.remove(shape)
            dropped = True
        else:
            raise ValueError(f"the collision mesh {mesh.get('filename')} is missing or neither STL nor OBJ")
    if dropped:
        for shape in link.findall("collision"):
            copied = ElementTree.SubElement(link, "visual")
            copied.extend(list(shape))


def _urdf_velocities(path: Path) -> dict[str, float]:
    """Return the velocity limits per joint [rad/s] of a URDF, which MuJoCo does not keep; empty for an MJCF."""
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise InputError(f"{path.name} is no XML: {error}") from None
    if root.tag != "robot":
        return {}
    limits = ((joint.get("name") or "", joint.find("limit")) for joint in root.findall("joint"))
    return {name: float(limit.get("velocity") or 0) for name, limit in limits if limit is not None and limit.get("velocity")}


def _mount(spec: Any, hand: Any, site: str) -> None:
    """Attach a gripper to a site of the arm."""
    place = next((s for s in spec.sites if s.name == site), None)
    if place is None:
        raise ValueError(f"the arm has no site {site!r} to mount a gripper at")
    spec.attach(hand, site=place, prefix=HAND)


def _split(model: Any, name: str, tool: str | None, gripper: Sequence[str]) -> tuple[list[int], list[int]]:
    """Return the joints of the arm, from its base on, and those of the gripper."""
    moves = single_joints(model)
    bodies = [model.body(b).name for b in range(1, model.nbody)]
    if tool is not None and tool not in bodies:
        raise OptionError(f"--tool: {name} has no body {tool!r}; its bodies are {', '.join(bodies)}")
    known = [model.joint(j).name for j in moves]
    for wrong in (g for g in gripper if g not in known):
        raise OptionError(f"--gripper: {name} has no joint {wrong!r}; its joints are {', '.join(known)}")
    body = model.body(tool).id if tool is not None else _branching(model, moves)
    path = _ancestors(model, body)
    named = [j for j in moves if model.joint(j).name in gripper]
    arm = [j for j in moves if int(model.jnt_bodyid[j]) in path and j not in named]
    arm.sort(key=lambda j: path[::-1].index(int(model.jnt_bodyid[j])))
    fingers = named or [j for j in moves if j not in arm and arm and int(model.jnt_bodyid[arm[-1]]) in _ancestors(
        model, int(model.jnt_bodyid[j]))]  # fmt: skip
    if not 4 <= len(arm) <= 9:
        raise OptionError(
            f"{name} has {len(arm)} joints before its tree branches; an arm has 4 to 9: name the hand's body with --tool "
            f"(bodies: {', '.join(bodies)}) and the gripper's joints with --gripper (joints: {', '.join(known)})"
        )
    return arm, fingers


def _ancestors(model: Any, body: int) -> list[int]:
    """Return a body and all its ancestors."""
    bodies = [body]
    while bodies[-1]:
        bodies.append(int(model.body_parentid[bodies[-1]]))
    return bodies


def _branching(model: Any, moves: Sequence[int]) -> int:
    """Return the first body below the root at which moving joints branch, else the last moving body."""
    carrying = {b for j in moves for b in _ancestors(model, int(model.jnt_bodyid[j]))}
    body = 0
    while True:
        below = [b for b in carrying if b != body and int(model.body_parentid[b]) == body]
        if len(below) != 1:
            return body
        body = below[0]


def _home(spec: Any, model: Any, arm: Sequence[int], limits: np.ndarray) -> np.ndarray:
    """Return the file's first keyframe if it lies within the limits, else the middle of every range."""
    if len(spec.keys) and len(spec.keys[0].qpos) == model.nq:
        posture = np.array(spec.keys[0].qpos)[model.jnt_qposadr[arm]]
        if ((posture >= limits[:, 0]) & (posture <= limits[:, 1])).all():
            return posture
    return limits.mean(1)
