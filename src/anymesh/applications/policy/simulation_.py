"""Simulation of one object and a robot, stepped by actions or by tool poses, without Gymnasium."""

from __future__ import annotations

from typing import Any

import numpy as np
from jaxtyping import Bool, Float, UInt8

from anymesh.applications.plan.film_ import draw_surfaces, drawn_geoms, geom_surface
from anymesh.applications.plan.robot_ import positions_of, quaternion
from anymesh.applications.plan.scene_ import bodies_of
from anymesh.applications.policy.objects_ import TaskObject, apply
from anymesh.applications.policy.robots_ import HINGES, SLIDERS, TaskRobot, make_robot
from anymesh.applications.policy.scene_ import OBJECT, ROBOT, STAND, compose, limit_masses
from anymesh.applications.policy.tasks import NOMINAL, PolicyTask, SceneSample, Situation
from anymesh.mujoco_ import load_mujoco
from anymesh.types.camera import Camera

SUBSTEPS = 10  # of `TIMESTEP` per action: 20 actions per second
HORIZON = 70  # actions
FORWARD = np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]])  # tool's z to +y, its closing direction along x
DOWN = np.array([[-1.0, 0, 0], [0, 1, 0], [0, 0, -1]])  # tool's z down, its closing direction along y
BEFORE, ABOVE = 0.12, 0.10  # [m] of the tool at the start, from the front of the object and from its top
STOPPED = 1e-3  # [rad] or [m] from a limit that holds the part
LEAD = 2.0  # steps that a command may be ahead of its joint, which limits the force
GRAVITY, STAYS = 9.81, 1.5  # [m/s2], and friction over the weight's largest moment about the axis
LOWEST = 0.05  # [m] of the tool at the start
FOV = np.deg2rad(35)
WAY = np.array([-0.75, -0.55, 0.5]) / np.linalg.norm([-0.75, -0.55, 0.5])  # from the object to the camera
ROOM = 0.12  # [m] around the object
FLOOR = 1.2  # [m] side of the square of ground that is drawn


class TaskSimulation:
    """One object with one robot. `reset` sets a sample of the randomization; `act` runs one action.

    robot: a name, or a floating hand; R_world_tool: orientation of a floating hand at the start; by default ahead, or down for
    `lift`; stays: whether friction holds the part everywhere against its weight, else only at the start.
    """

    def __init__(
        self,
        object_: TaskObject,
        task: PolicyTask,
        robot: str | TaskRobot = "gripper",
        horizon: int = HORIZON,
        R_world_tool: Float[np.ndarray, "3 3"] | None = None,
        *,
        stays: bool = True,
    ) -> None:
        self.mujoco = load_mujoco()
        self.object, self.task, self.horizon = object_, task, horizon
        home = DOWN if task is PolicyTask.LIFT else FORWARD
        self._R_home = home if R_world_tool is None else R_world_tool
        self.robot = made = robot if isinstance(robot, TaskRobot) else make_robot(robot, self._R_home)
        lifts = task is PolicyTask.LIFT
        spec = compose(object_, made, lifts=lifts)
        self.model = model = spec.compile()
        limit_masses(self.mujoco, model, lifts)
        self.data = self.mujoco.MjData(model)
        self.mujoco.mj_setConst(model, self.data)
        self._hold_still(everywhere=stays)
        self._nominal = {k: getattr(model, k).copy() for k in ("body_mass", "body_inertia", "dof_damping", "dof_frictionloss")}
        self._free = bool(lifts)
        self._index(model, made)
        start = apply(object_.thing.motion.transform(object_.goal.start), object_.handle)
        self.handle_at_start = apply(object_.T_world_asset, start)
        self.step = 0
        self.reset(NOMINAL)

    def _index(self, model: Any, robot: TaskRobot) -> None:
        """Look up the numbers of joints, actuators and shapes."""
        body = model.geom_bodyid
        self.stand = int(model.body(STAND).id)
        part, own = bodies_of(model, OBJECT, self.object.thing.carried), bodies_of(model, OBJECT)
        self.own_bodies = np.flatnonzero(own)
        own[self.stand] = True
        finger = np.full(model.nbody, -1)
        for k, bodies in enumerate(robot.fingers):
            finger[[int(model.body(ROBOT + b).id) for b in bodies]] = k
        self._is_part, self.is_object, self._finger = part[body], own[body], finger[body]
        self.is_robot = bodies_of(model, ROBOT)[body]
        self._count = len(robot.fingers)
        self.joint = int(model.joint(OBJECT + self.object.thing.joint).qposadr[0])
        self.dof = int(model.joint(OBJECT + self.object.thing.joint).dofadr[0])
        self._part = int(model.body(OBJECT + self.object.thing.part).id)
        self.tool_site = int(model.site(ROBOT + robot.tool).id)
        self._servos = [np.array([int(model.actuator(ROBOT + n).id) for n in group]) for group in robot.servos]
        self._first = np.array([group[0] for group in self._servos])
        self.command_at = np.array([self._position_of(int(a)) for a in self._first])
        self.robot_at = np.array(
            [int(model.jnt_qposadr[j]) for j in range(model.njnt) if model.joint(j).name.startswith(ROBOT)]
        )
        self._handle = self._in_part(self.object.handle)

    def _position_of(self, actuator: int) -> int:
        """Return where the position of an actuator's joint is; of a tendon, that of its first joint."""
        model = self.model
        number = int(model.actuator_trnid[actuator, 0])
        if int(model.actuator_trntype[actuator]) == int(self.mujoco.mjtTrn.mjTRN_TENDON):
            number = int(model.wrap_objid[int(model.tendon_adr[number])])
        return int(model.jnt_qposadr[number])

    def _hold_still(self, *, everywhere: bool) -> None:
        """Give a joint that gravity moves enough friction to stay where it starts, as DexArt's do."""
        model, thing = self.model, self.object.thing
        part = int(model.body(OBJECT + thing.part).id)
        dof = int(model.joint(OBJECT + thing.joint).dofadr[0])
        weight = GRAVITY * float(model.body_subtreemass[part])
        if not everywhere:
            self.data.qpos[int(model.jnt_qposadr[model.dof_jntid[dof]])] = self.object.goal.start
            self.mujoco.mj_forward(model, self.data)
            low, high = np.array(thing.limits if thing.limits is not None else (-np.inf, np.inf)) - self.object.goal.start
            force = float(self.data.qfrc_passive[dof] - self.data.qfrc_bias[dof])
            stopped = (force > 0 and high < STOPPED) or (force < 0 and low > -STOPPED)
            weight = 0.0 if stopped else abs(force)
        elif thing.turns:
            weight *= float(np.linalg.norm(self.object.handle - thing.motion.origin) * np.hypot(*thing.motion.axis[:2]))
        else:
            weight *= abs(float(thing.motion.axis[2]))
        model.dof_frictionloss[dof] = max(float(model.dof_frictionloss[dof]), STAYS * weight)

    def _in_part(self, point: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
        """Return a point of the part, given in the asset frame at rest, in the frame of its body."""
        data, stand = self.data, self.stand
        self.mujoco.mj_resetData(self.model, data)
        self.mujoco.mj_kinematics(self.model, data)
        world = data.xmat[stand].reshape(3, 3) @ point + data.xpos[stand]
        return data.xmat[self._part].reshape(3, 3).T @ (world - data.xpos[self._part])

    def reset(self, sample: SceneSample) -> None:
        """Bring the object to its start in a drawn pose with drawn physics, and the robot before it."""
        model, data, goal = self.model, self.data, self.object.goal
        self.mujoco.mj_resetData(model, data)
        for name, nominal in self._nominal.items():
            getattr(model, name)[:] = nominal
        model.body_mass[self.own_bodies] *= sample.mass
        model.body_inertia[self.own_bodies] *= sample.mass
        model.dof_damping[self.dof] *= sample.damping
        model.dof_frictionloss[self.dof] *= sample.joint_friction
        model.geom_friction[self.is_object, 0] = sample.friction
        pos, quat = self._pose(sample)
        if self._free:
            data.qpos[:7] = [*pos, *quat]
        else:
            data.mocap_pos[0], data.mocap_quat[0] = pos, quat
        for name, value in self.object.thing.opened:
            data.qpos[positions_of(model, [name], OBJECT)] = value
        data.qpos[self.joint] = goal.start + sample.start * (goal.goal - goal.start)
        for name, value in self.robot.positions:
            data.qpos[positions_of(model, [name], ROBOT)] = value
        if self.robot.floating:
            self._place_hand()
        self.command = np.where(self.robot.rate > 0, data.qpos[self.command_at], self.robot.high)
        self._send()
        self.mujoco.mj_forward(model, data)
        self.step, self.start_height = 0, float(data.xpos[self.stand, 2])
        self._tool_height, self._effort = float(self.tool_position[2]), 0.0
        self.measure()

    def _pose(self, sample: SceneSample) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 4"]]:
        """Return position and quaternion of the object, turned about its middle."""
        c, s = np.cos(sample.yaw), np.sin(sample.yaw)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        T = self.object.T_world_asset
        return turn @ T[:3, 3] + [sample.x, sample.y, 0.0], quaternion(turn @ T[:3, :3])

    def _place_hand(self) -> None:
        """Move a floating hand before the front of the object, or above an object that is lifted, whatever the sample."""
        low, high = self.object.box
        middle = (low + high) / 2
        at = np.array([0.0, 0.0, high[2] + ABOVE] if self._free else [0.0, low[1] - BEFORE, max(middle[2], LOWEST)])
        data, model = self.data, self.model
        self.mujoco.mj_kinematics(model, data)
        offset = data.site_xpos[self.tool_site].copy()
        data.qpos[positions_of(model, SLIDERS, ROBOT)] = at - offset

    def act(self, action: Float[np.ndarray, " a"]) -> Situation:
        """Run one action in [-1, 1] and return what it led to."""
        robot, wanted = self.robot, np.clip(action, -1.0, 1.0)
        now, lead = self.data.qpos[self.command_at], LEAD * robot.rate
        moved = np.clip(self.command + robot.rate * wanted, now - lead, now + lead)
        fixed = robot.low + (wanted + 1) / 2 * (robot.high - robot.low)
        self.command = np.clip(np.where(robot.rate > 0, moved, fixed), robot.low, robot.high)
        self._effort = float(np.mean(wanted * wanted))
        self._send()
        return self.advance()

    def advance(self) -> Situation:
        """Run the substeps of one action with the present commands, and measure."""
        before = self._tool_height
        self.mujoco.mj_step(self.model, self.data, SUBSTEPS)
        self.step += 1
        self._tool_height = float(self.tool_position[2])
        return self.measure(self._tool_height - before)

    def aim(self, R: Float[np.ndarray, "3 3"]) -> None:
        """Change the orientation of the floating gripper at the start, in the world frame."""
        self._R_home = R
        self.model.body_quat[int(self.model.body(f"{ROBOT}hand").id)] = quaternion(R)
        self.mujoco.mj_setConst(self.model, self.data)

    def command_tool(
        self, position: Float[np.ndarray, " 3"], R: Float[np.ndarray, "3 3"], gap: float, *, jump: bool = False
    ) -> None:
        """Command a pose of the floating gripper's tool in the world frame, and a gap of its fingers, below 0 to press.

        The orientation must be less than 90 degrees of pitch from that at the start. jump: place the hand there at once.
        """
        turn = R @ self._R_home.T
        yaw, pitch = np.arctan2(turn[1, 0], turn[0, 0]), -np.arcsin(np.clip(turn[2, 0], -1, 1))
        roll = np.arctan2(turn[2, 1], turn[2, 2])
        values = dict(zip((*SLIDERS, *HINGES), (*position, yaw, pitch, roll), strict=True))
        values |= {"left_finger": gap / 2, "right_finger": gap / 2}
        for name, value in values.items():
            self.data.ctrl[int(self.model.actuator(ROBOT + name).id)] = value
            if jump:
                self.data.qpos[positions_of(self.model, [name], ROBOT)] = value

    def _send(self) -> None:
        for number, group in enumerate(self._servos):
            self.data.ctrl[group] = self.command[number]

    @property
    def tool_position(self) -> Float[np.ndarray, " 3"]:
        """Position of the tool in the world frame [m]."""
        return self.data.site_xpos[self.tool_site]

    @property
    def tool_rotation(self) -> Float[np.ndarray, "3 3"]:
        """Orientation of the tool in the world frame."""
        return self.data.site_xmat[self.tool_site].reshape(3, 3)

    @property
    def handle_position(self) -> Float[np.ndarray, " 3"]:
        """Position of the handle point in the world frame [m]."""
        return self.data.xmat[self._part].reshape(3, 3) @ self._handle + self.data.xpos[self._part]

    @property
    def part_pose(self) -> Float[np.ndarray, "4 4"]:
        """Transform from the frame of the part's body to the world frame."""
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.data.xmat[self._part].reshape(3, 3), self.data.xpos[self._part]
        return T

    @property
    def tool_in_part(self) -> Float[np.ndarray, " 3"]:
        """Position of the tool in the frame of the part's body [m]."""
        return self.data.xmat[self._part].reshape(3, 3).T @ (self.tool_position - self.data.xpos[self._part])

    @property
    def value(self) -> float:
        """Value of the joint [rad or m]."""
        return float(self.data.qpos[self.joint])

    def touching(self) -> tuple[Bool[np.ndarray, " f"], bool]:
        """Return which fingers touch the part, and whether the rest of the robot touches the object."""
        in_contact = np.zeros(self._count, bool)
        if self.data.ncon == 0:
            return in_contact, False
        geoms = self.data.contact.geom
        a, b = geoms[:, 0], geoms[:, 1]
        fingers = np.concatenate([self._finger[a][self._is_part[b]], self._finger[b][self._is_part[a]]])
        in_contact[fingers[fingers >= 0]] = True
        hit = (self.is_robot[a] & (self._finger[a] < 0) & self.is_object[b]) | (
            self.is_robot[b] & (self._finger[b] < 0) & self.is_object[a]
        )
        return in_contact, bool(hit.any())

    def measure(self, tool_rise: float = 0.0) -> Situation:
        """Measure the situation."""
        fingers, collides = self.touching()
        self.fingers = fingers
        distance = float(np.linalg.norm(self.handle_position - self.tool_position))
        rise = float(self.data.xpos[self.stand, 2]) - self.start_height
        return Situation(
            distance, int(fingers.sum()), collides, self.object.goal.progress(self.value), rise, tool_rise, self._effort,
            self.step, self.horizon,
        )  # fmt: skip


class ScenePicture:
    """Draws the present state of a simulation."""

    def __init__(self, simulation: TaskSimulation, width: int = 320, height: int = 240) -> None:
        self.simulation, mujoco = simulation, simulation.mujoco
        lifts = simulation.task is PolicyTask.LIFT
        self._model = compose(simulation.object, simulation.robot, lifts=lifts, visuals=True).compile()
        self._data = mujoco.MjData(self._model)
        geoms = [g for g in drawn_geoms(self._model) if self._model.geom_rgba[g, 3] > 0 and not self._is_floor(g)]
        self._shapes = [(g, *geom_surface(mujoco, self._model, self._data, g)) for g in geoms]
        half = FLOOR / 2
        a, b, c, d = ([x, y, 0.0] for x, y in ((-half, -half), (half, -half), (half, half), (-half, half)))
        self._floor = np.array([[a, b, c], [a, c, d]])
        colors = [np.tile([209, 209, 204], (2, 1)), *(np.tile(color, (len(own), 1)) for _, own, color in self._shapes)]
        self._colors = np.concatenate(colors).astype(np.uint8)
        self._camera = self._looking(width, height)

    def _is_floor(self, geom: int) -> bool:
        return self._model.geom(geom).name == "floor"

    def _looking(self, width: int, height: int) -> Camera:
        T = self.simulation.object.T_world_asset
        points = self.simulation.object.points @ T[:3, :3].T + T[:3, 3]
        above = self.simulation.handle_at_start + np.array([0, 0, ROOM])
        points = np.concatenate([points, above[None]])
        low, high = points.min(0), points.max(0)
        center = (low + high) / 2
        radius = float(np.linalg.norm(high - low)) / 2 + ROOM
        return Camera.looking_at(center + WAY * radius / np.sin(FOV / 2), center, FOV, width, height)

    def frame(self) -> UInt8[np.ndarray, "H W 3"]:
        """Draw the object, the robot and the floor."""
        s, data = self.simulation, self._data
        data.qpos[:], data.mocap_pos[:], data.mocap_quat[:] = s.data.qpos, s.data.mocap_pos, s.data.mocap_quat
        s.mujoco.mj_kinematics(self._model, data)
        surfaces: list[Float[np.ndarray, "_ 3 3"]] = [self._floor]
        surfaces += [own @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g] for g, own, _ in self._shapes]
        return draw_surfaces(surfaces, self._colors, self._camera)
