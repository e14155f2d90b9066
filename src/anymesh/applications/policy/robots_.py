"""Robots of an environment: floating hands (a gripper of boxes, the Shadow hand), and the arms of `anymesh plan`."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.hand_ import Hand, measure_hand
from anymesh.applications.plan.robot_ import RobotArm, add_servo, finger_bodies, load_robot, positions_of, quaternion
from anymesh.applications.plan.robot_packages_ import find_robot
from anymesh.errors import MissingExtraError, OptionError, pip_install
from anymesh.mujoco_ import load_mujoco
from anymesh.types import Brief

SLIDERS, HINGES = ("move_x", "move_y", "move_z"), ("turn_z", "turn_y", "turn_x")  # servos of a floating hand
LIMIT = 10.0  # [m] or [rad] of commands whose servo has no range
REACH = 0.012  # [m] of fingertips ahead of the tool
MOVE_FORCE, TURN_TORQUE = 80.0, 8.0  # [N], [N m] limits of the servos of a floating hand
PRESS = 0.01  # [m] by which a closing command passes beyond closed, to press on what is between the pads
MASS = 0.8  # [kg] of the gripper
STEP, TURN_STEP = 0.03, 0.12  # [m], [rad] of the largest change of the command in one step
SHADOW = "gymnasium_robotics/envs/assets"  # in the wheel gymnasium-robotics: the Shadow hand as MJCF, with meshes
SHADOW_FINGERS = ("ff", "mf", "rf", "lf", "th")
NO_SHADOW = f"gymnasium-robotics is not installed; {pip_install('policy-hand')} brings it"
TOOL_X, TOOL_Y = 0.0, -0.3  # [m] of the tool at home, from the middle of the object; the base of the arm is behind it
JOINT_STEP = 0.06  # [rad] of the largest change of a command in one step
ARMS = ("panda", "ur5e")
MIN_SIZE, MAX_SIZE, MAX_FORCE = 0.001, 1.0, 1000.0  # [m], [m], [N] of sizes and forces of a gripper


@dataclass(frozen=True)
class Gripper:
    """A parallel gripper of boxes. stroke: largest gap [m]; finger: length, width and thickness [m]; force: of a finger [N].

    Raise OptionError for sizes that no gripper has.
    """

    stroke: float = 0.085
    finger: tuple[float, float, float] = (0.072, 0.020, 0.012)
    force: float = 30.0

    def __post_init__(self) -> None:
        if not all(MIN_SIZE <= v <= MAX_SIZE for v in (self.stroke, *self.finger)) or not 0 < self.force <= MAX_FORCE:
            raise OptionError(
                f"a gripper needs a stroke and a length, width and thickness of its fingers from {MIN_SIZE} to {MAX_SIZE} m, "
                f"and a force up to {MAX_FORCE:.0f} N; found {self.stroke}, {self.finger} and {self.force}"
            )

    @classmethod
    def parse(cls, stroke: float, finger: str, force: float) -> Gripper:
        """Parse "LENGTH,WIDTH,THICKNESS" of a finger [m]. Raise OptionError."""
        try:
            length, width, thickness = (float(word) for word in finger.split(","))
        except ValueError:
            raise OptionError(f"--finger: found {finger!r}; valid are LENGTH,WIDTH,THICKNESS in metres") from None
        return cls(stroke, (length, width, thickness), force)


GRIPPER = Gripper()


@dataclass(frozen=True, eq=False)
class TaskRobot(Brief):
    """Robot as a MuJoCo spec, with its tool and the meaning of an action.

    tool: site, z along the approach and y along the closing direction; fingers: bodies of each finger; floating: whether six
    servos move the hand in the world frame; servos: actuators of each dimension of an action; rate: change of their command
    per step, 0 where an action sets the command between low and high; positions: values of joints at the start.
    """

    name: str
    spec: Any
    tool: str
    fingers: tuple[tuple[str, ...], ...]
    floating: bool
    servos: tuple[tuple[str, ...], ...]
    rate: Float[np.ndarray, " a"]
    low: Float[np.ndarray, " a"]
    high: Float[np.ndarray, " a"]
    positions: tuple[tuple[str, float], ...] = ()


def make_robot(name: str, R_world_tool: Float[np.ndarray, "3 3"]) -> TaskRobot:
    """Return a robot by name. R_world_tool: orientation of a floating hand at the start.

    Raise OptionError for an unknown name, MissingExtraError if its files are not installed.
    """
    if name in HANDS:
        return HANDS[name](R_world_tool)
    if name in ARMS:
        return arm_robot(name)
    raise OptionError(f"--robot: found {name!r}; valid are {', '.join(NAMES)}")


def _floating(R_world_tool: np.ndarray) -> tuple[Any, Any]:
    """Return a spec with a mount that six servos move, and the body of the hand on it."""
    mujoco = load_mujoco()
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    body = spec.worldbody.add_body(name="mount", gravcomp=1.0)
    axes = np.eye(3)
    for k, name in enumerate(SLIDERS):
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axes[k], armature=0.2)
    for name, k in zip(HINGES, (2, 1, 0), strict=True):
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=axes[k], armature=0.02)
    body.mass, body.inertia, body.explicitinertial = MASS / 2, [1e-3] * 3, True
    for name in SLIDERS:
        add_servo(spec, name, 1500.0, 80.0, MOVE_FORCE)
    for name in HINGES:
        add_servo(spec, name, 60.0, 3.0, TURN_TORQUE)
    return spec, body.add_body(name="hand", quat=quaternion(R_world_tool), gravcomp=1.0)


def floating_gripper(R_world_tool: np.ndarray, gripper: Gripper = GRIPPER) -> TaskRobot:
    """Return a parallel gripper: a palm and two fingers with box pads, whose tool frame is that of the hand's body."""
    mujoco = load_mujoco()
    spec, hand = _floating(R_world_tool)
    box = mujoco.mjtGeom.mjGEOM_BOX
    half, (length, width, thickness) = gripper.stroke / 2, gripper.finger
    palm = [0.022, half + 0.0125, 0.012]
    hand.add_geom(name="palm", type=box, size=palm, pos=[0, 0, REACH - length - 0.002], mass=MASS / 4)
    hand.add_site(name="tool")
    for name, side in (("left", 1.0), ("right", -1.0)):
        finger = hand.add_body(name=name, pos=[0, side * thickness / 2, 0], gravcomp=1.0)
        finger.add_joint(
            name=f"{name}_finger", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, side, 0], range=[0, half], limited=1,
            armature=0.02,
        )  # fmt: skip
        pad = [width / 2, thickness / 2, length / 2]
        finger.add_geom(name=f"{name}_pad", type=box, size=pad, pos=[0, 0, REACH - length / 2], mass=MASS / 8)
        add_servo(spec, f"{name}_finger", 3000.0, 150.0, gripper.force)
    servos = (*((n,) for n in (*SLIDERS, "turn_z", "turn_x")), ("left_finger", "right_finger"))
    rate = np.array([STEP, STEP, STEP, TURN_STEP, TURN_STEP, 0.0])
    high = np.array([LIMIT] * 5 + [half])
    low = np.array([-LIMIT] * 5 + [-PRESS])
    positions = (("left_finger", half), ("right_finger", half))
    return TaskRobot("gripper", spec, "tool", (("left",), ("right",)), True, servos, rate, low, high, positions)


def floating_shadow(R_world_tool: np.ndarray) -> TaskRobot:
    """Return the Shadow hand of gymnasium-robotics on a floating mount, with 4 + 20 actions."""
    mujoco = load_mujoco()
    try:
        folder = Path(str(metadata.distribution("gymnasium-robotics").locate_file(SHADOW)))
    except metadata.PackageNotFoundError:
        raise MissingExtraError(f"the Shadow hand is not there: {NO_SHADOW}") from None
    spec, hand = _floating(R_world_tool)
    frame = hand.add_frame(pos=[0, 0, -0.385])  # from the forearm to between the fingers
    spec.attach(mujoco.MjSpec.from_string(_shadow_text(folder)), frame=frame, prefix="shadow_")
    spec.body("shadow_robot0:palm").add_site(name="tool", pos=[0, -0.03, 0.10])
    for body in spec.bodies:
        body.gravcomp = 1.0
    fingers = tuple(
        tuple(b.name for b in spec.bodies if b.name.startswith(f"shadow_robot0:{finger}")) for finger in SHADOW_FINGERS
    )
    own = [a for a in spec.actuators if a.name.startswith("shadow_")]
    servos = (*((n,) for n in (*SLIDERS, "turn_z")), *((a.name,) for a in own))
    ranges = np.array([a.ctrlrange for a in own])
    rate = np.array([STEP, STEP, STEP, TURN_STEP] + [0.0] * len(own))
    low, high = (np.concatenate([[s * LIMIT] * 4, ranges[:, k]]) for k, s in ((0, -1), (1, 1)))
    return TaskRobot("shadow", spec, "tool", fingers, True, servos, rate, low, high)


def _shadow_text(folder: Path) -> str:
    """Return the hand alone as MJCF, which the package has only in parts that its scenes include."""
    root = ElementTree.Element("mujoco", model="shadow")
    places = {"meshdir": str(folder / "stls" / "hand"), "texturedir": str(folder / "textures")}
    ElementTree.SubElement(root, "compiler", {"angle": "radian", **places})
    for element in ElementTree.parse(folder / "hand" / "shared.xml").getroot():
        if element.tag not in ("size", "visual"):  # memory sizes that MuJoCo no longer has
            root.append(element)
    ElementTree.SubElement(root, "asset").extend(list(ElementTree.parse(folder / "hand" / "shared_asset.xml").getroot()))
    hand = ElementTree.parse(folder / "hand" / "robot.xml").getroot()
    mount = hand[0]
    mount.attrib.pop("euler", None)
    mount.set("pos", "0 0 0")
    ElementTree.SubElement(root, "worldbody").append(mount)
    return ElementTree.tostring(root, encoding="unicode")


def arm_robot(name: str) -> TaskRobot:
    """Return an arm with its gripper by the name that `anymesh plan` gives it: an action per joint and one for the gripper.

    Raise MissingExtraError or InputError if its files are not there.
    """
    mujoco = load_mujoco()
    arm = load_robot(find_robot(name))
    hand = measure_hand(arm)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.impratio, spec.option.cone = arm.spec.option.impratio, arm.spec.option.cone
    at = _tool_at_home(mujoco, arm, hand)
    yaw = np.pi / 2 - np.arctan2(at[1], at[0])
    base = [TOOL_X, TOOL_Y - float(np.hypot(at[0], at[1])), 0.0]
    turn = [np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2)]
    spec.attach(arm.spec.copy(), frame=spec.worldbody.add_frame(pos=base, quat=turn), prefix="")
    T = hand.T_wrist_tool
    spec.body(arm.wrist).add_site(name="tool", pos=T[:3, 3], quat=quaternion(T[:3, :3]))
    for body in spec.bodies:
        body.gravcomp = 1.0
    motors = [a for a in spec.actuators if a.target in arm.joints]
    own = [a for a in spec.actuators if a.target not in arm.joints]
    for number, motor in enumerate((*motors, *own)):
        motor.name = motor.name or f"servo_{number}"
    order = {a.target: a.name for a in motors}
    servos = (*((order[j],) for j in arm.joints), tuple(a.name for a in own))
    low = np.array([*arm.limits[:, 0], hand.control[0, 0]])
    high = np.array([*arm.limits[:, 1], hand.control[-1, 0]])
    rate = np.array([JOINT_STEP] * len(arm.joints) + [0.0])
    start = dict(zip(arm.joints, arm.home, strict=True)) | dict(zip(arm.fingers, hand.posture[-1], strict=True))
    positions = tuple((n, float(v)) for n, v in start.items())
    fingers = _fingers(mujoco, arm, hand)
    return TaskRobot(name, spec, "tool", fingers, False, servos, rate, low, high, positions)


def _tool_at_home(mujoco: Any, arm: RobotArm, hand: Hand) -> Float[np.ndarray, " 3"]:
    """Return the position of the tool in the frame of the arm's file, at home [m]."""
    model = arm.spec.compile()
    data = mujoco.MjData(model)
    data.qpos[positions_of(model, arm.joints)] = arm.home
    mujoco.mj_kinematics(model, data)
    wrist = int(model.body(arm.wrist).id)
    return data.xpos[wrist] + data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 3]


def _fingers(mujoco: Any, arm: RobotArm, hand: Hand) -> tuple[tuple[str, ...], ...]:
    """Return the bodies of each finger: those that the gripper's joints move, by their side in the tool's frame."""
    model = arm.spec.compile()
    data = mujoco.MjData(model)
    data.qpos[positions_of(model, arm.fingers)] = hand.posture[-1]
    mujoco.mj_kinematics(model, data)
    wrist = int(model.body(arm.wrist).id)
    closing = data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 1]
    center = data.xpos[wrist] + data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 3]
    sides: tuple[list[str], list[str]] = ([], [])
    for body in np.flatnonzero(finger_bodies(model, arm.fingers)):
        geoms = np.flatnonzero(model.geom_bodyid == body)
        middle = data.geom_xpos[geoms].mean(0) if len(geoms) else data.xpos[body]
        sides[int((middle - center) @ closing < 0)].append(model.body(body).name)
    return tuple(tuple(side) for side in sides)


HANDS = {"gripper": floating_gripper, "shadow": floating_shadow}

NAMES = (*HANDS, *ARMS)
