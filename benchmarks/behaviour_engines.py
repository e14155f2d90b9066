"""One engine of `benchmarks.behaviour`, in a process and an environment of its own: how joints answer a hand, by position.

python benchmarks/behaviour_engines.py ENGINE JOBS.json ANSWER.json

Each engine reads the file that its users read, as it is; only what the engine does not take from the file is set by hand:

- MuJoCo: the MJCF, nothing set.
- Newton: the MJCF with `SolverMuJoCo`, whose attributes are registered before it is read; its model is stepped by MuJoCo.
- SAPIEN: the URDF, with its limits of velocity; a drive without stiffness whose force limit is the file's friction; damping and
  springs as forces.
- PhysX (`ovphysx`): the USD, nothing set. Forces act at joints, without gravity, whose share is added afterwards; slopes and
  pushes are left out.
- Drake: the URDF; an actuator per joint whose effort limit is the file's friction, with a velocity gain and no position gain;
  springs as force elements.
"""

from __future__ import annotations

import json
import sys
import tempfile
import traceback
from dataclasses import dataclass, replace
from importlib.metadata import version
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from anymesh.checking.engines import physx_
from anymesh.checking.engines.driving import Motor
from anymesh.checking.engines.pushing import STEP
from anymesh.checking.engines.robot import Robot, read_urdf
from anymesh.checking.engines.sapien_ import without_visuals

DT = 0.004  # [s] step
FINE_DT = 0.001  # [s] of Drake for objects with knobs, wheels and the like: light parts creep in proportion to its step
BRAKE = 1e5  # gain of the brakes that stand for dry friction, per N or N m of friction [s/m or s/rad]
HELD = 1e6  # [N or N m] friction of a joint that is held
REST_S, PULL_S, TILT_S, PUSH_S, CALM_S, WATCH_S = 0.5, 1.0, 4.0, 1.0, 2.0, 1.0  # [s]
MOVED_M, MOVED_RAD = 0.002, 0.02  # motion of the handle, or of a joint that states a torque, that counts as moving
HALVINGS = 8
SLOPE = np.deg2rad(1.0)
GRAVITY = 9.81
FAR_M, FAR_RAD = 0.05, 0.3  # a push that is let go after this motion
Positions = dict[str, float]


@dataclass(frozen=True)
class Stated:
    """What asset.json states: handles by link [m], and springs by joint (stiffness, relaxed position), which a URDF lacks."""

    handles: dict[str, np.ndarray]
    springs: dict[str, tuple[float, float]]
    loose: bool = False  # whether joints have no dry friction, whatever is stated
    dt: float = DT  # [s] step


class World(Protocol):
    """An asset in an engine: its root is fixed, or free above a plane if the height of one is given."""

    def reset(self, positions: Positions, held: frozenset[str]) -> None:
        """Set the joints, at rest; joints that are not named are at 0. held: joints that do not move from now on."""

    def step(self, link: str = "", force: np.ndarray | None = None, torque: np.ndarray | None = None) -> None:
        """Advance by a step with a force at the link's handle and a torque about it [N, N m, axes of the world]."""

    def positions(self) -> Positions: ...

    def root(self) -> np.ndarray:
        """Return the position of the root [m]."""


class Mujoco:
    def __init__(self, folder: Path, robot: Robot, gravity: np.ndarray, stated: Stated, ground: float | None = None) -> None:
        import mujoco

        self.mujoco, self.handles = mujoco, stated.handles
        spec = mujoco.MjSpec.from_file(str(folder / f"{robot.name}.xml"))
        if ground is not None:
            spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1), pos=(0, 0, ground))
        model = spec.compile()
        free = mujoco.mjtJoint.mjJNT_FREE
        joints = {model.joint(k).name: k for k in range(model.njnt) if model.jnt_type[k] != free}
        self.use(model, gravity, stated, joints, {model.body(k).name: k for k in range(model.nbody)})
        self.top = self.bodies[robot.roots[0]]

    def use(self, model: Any, gravity: np.ndarray, stated: Stated, names: dict[str, int], bodies: dict[str, int]) -> None:
        """Take a compiled model, with the indices of joints and bodies by their names in the asset."""
        self.model, self.names, self.bodies = model, names, bodies
        model.opt.gravity[:], model.opt.timestep = gravity, stated.dt
        self.data, self.friction = self.mujoco.MjData(model), model.dof_frictionloss * (not stated.loose)

    def reset(self, positions: Positions, held: frozenset[str]) -> None:
        self.mujoco.mj_resetData(self.model, self.data)
        for name, at in positions.items():
            self.data.qpos[self.model.jnt_qposadr[self.names[name]]] = at
        for name, k in self.names.items():
            dof = self.model.jnt_dofadr[k]
            self.model.dof_frictionloss[dof] = HELD if name in held else self.friction[dof]

    def step(self, link: str = "", force: np.ndarray | None = None, torque: np.ndarray | None = None) -> None:
        self.data.qfrc_applied[:] = 0
        if link:
            zero = np.zeros(3)
            force, torque = zero if force is None else force, zero if torque is None else torque
            self.mujoco.mj_applyFT(
                self.model, self.data, force, torque, self.handles[link], self.bodies[link], self.data.qfrc_applied
            )
        self.mujoco.mj_step(self.model, self.data)

    def positions(self) -> Positions:
        return {name: float(self.data.qpos[self.model.jnt_qposadr[k]]) for name, k in self.names.items()}

    def root(self) -> np.ndarray:
        return self.data.xpos[self.top].copy()


class Sapien:
    def __init__(self, folder: Path, robot: Robot, gravity: np.ndarray, stated: Stated, ground: float | None = None) -> None:
        import sapien

        config = sapien.physx.get_scene_config()
        config.gravity = gravity
        sapien.physx.set_scene_config(config)
        physics = sapien.physx.PhysxCpuSystem()
        self.scene = sapien.Scene([physics])
        physics.timestep = stated.dt
        loader = self.scene.create_urdf_loader()
        loader.fix_root_link = ground is None
        if ground is not None:
            self.scene.add_ground(ground, render=False)
        with tempfile.TemporaryDirectory() as bare:
            file = Path(bare) / robot.path.name
            file.write_text(without_visuals(robot.path), encoding="utf-8")
            self.body = loader.load(str(file))
        self.links = {link.name: link for link in self.body.links}
        self.joints = list(self.body.active_joints)
        by_name = {j.name: replace(j, friction=0.0) if stated.loose else j for j in robot.moving}
        self.files = [by_name[j.name] for j in self.joints]
        for joint, file in zip(self.joints, self.files, strict=True):
            joint.set_max_velocity(file.velocity or 100.0)  # as by default
        for link in self.body.links:  # by default they turn at 50 rad/s at most
            link.set_max_angular_velocity(1e4)
        self.damping = np.array([j.damping for j in self.files])
        self.stiffness, self.relaxed = np.array([stated.springs.get(j.name, (0.0, 0.0)) for j in self.joints]).reshape(-1, 2).T
        self.handles = stated.handles

    def reset(self, positions: Positions, held: frozenset[str]) -> None:
        at = np.array([positions.get(j.name, 0.0) for j in self.joints])
        for joint, file, q in zip(self.joints, self.files, at, strict=True):
            joint.set_friction(0.0)
            if joint.name in held:
                joint.set_drive_properties(HELD, HELD)
                joint.set_drive_target(float(q))
            else:
                joint.set_drive_properties(0.0, BRAKE * max(file.friction, 1e-9), file.friction, "force")
        self.body.set_qpos(at)
        self.body.set_qvel(0 * at)

    def step(self, link: str = "", force: np.ndarray | None = None, torque: np.ndarray | None = None) -> None:
        spring = self.stiffness * (self.relaxed - self.body.get_qpos())
        self.body.set_qf(spring - self.damping * self.body.get_qvel())
        if link and force is not None:
            self.links[link].add_force_at_point(force, self.handles[link])
        if link and torque is not None:
            self.links[link].add_force_torque(np.zeros(3), torque)
        self.scene.step()

    def positions(self) -> Positions:
        return dict(zip((j.name for j in self.joints), map(float, self.body.get_qpos()), strict=True))

    def root(self) -> np.ndarray:
        return np.array(self.body.root.entity_pose.p, float)


class Drake:
    def __init__(self, folder: Path, robot: Robot, gravity: np.ndarray, stated: Stated, ground: float | None = None) -> None:
        import pydrake.all as drake

        builder = drake.DiagramBuilder()
        plant, _ = drake.AddMultibodyPlantSceneGraph(builder, time_step=stated.dt)
        (model,) = drake.Parser(plant).AddModels(str(robot.path))
        self.top = plant.GetBodyByName(robot.roots[0], model)
        if ground is None:
            plant.WeldFrames(plant.world_frame(), self.top.body_frame())
        else:
            place = drake.RigidTransform(np.array([0, 0, ground]))
            plant.RegisterCollisionGeometry(plant.world_body(), place, drake.HalfSpace(), "floor", drake.CoulombFriction(1, 1))
        plant.mutable_gravity_field().set_gravity_vector(gravity)
        for joint in robot.moving:
            friction = 1e-9 if stated.loose else max(joint.friction, 1e-9)
            brake = plant.AddJointActuator(f"{joint.name}_friction", plant.GetJointByName(joint.name), friction)
            brake.set_controller_gains(drake.PdControllerGains(p=0.0, d=BRAKE * friction))
        for name, (stiffness, relaxed) in stated.springs.items():
            joint = plant.GetJointByName(name)
            spring = drake.RevoluteSpring if isinstance(joint, drake.RevoluteJoint) else drake.PrismaticSpring
            plant.AddForceElement(spring(joint, relaxed, stiffness))
        plant.Finalize()
        self.drake, self.plant, self.model, self.handles, self.dt = drake, plant, model, stated.handles, stated.dt
        self.joints = {j.name: plant.GetJointByName(j.name) for j in robot.moving}
        self.diagram = builder.Build()

    def reset(self, positions: Positions, held: frozenset[str]) -> None:
        self.simulator = self.drake.Simulator(self.diagram)
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        for name, joint in self.joints.items():
            self.plant.SetPositions(self.context, self._placed(joint, positions.get(name, 0.0)))
        for name in held:
            self.joints[name].Lock(self.context)
        still = np.zeros(2 * self.plant.num_actuators(self.model))
        self.plant.get_desired_state_input_port(self.model).FixValue(self.context, still)
        self.simulator.Initialize()
        self.time = 0.0

    def _placed(self, joint: Any, at: float) -> np.ndarray:
        q = self.plant.GetPositions(self.context).copy()
        q[joint.position_start()] = at
        return q

    def step(self, link: str = "", force: np.ndarray | None = None, torque: np.ndarray | None = None) -> None:
        forces = []
        if link:
            applied = self.drake.ExternallyAppliedSpatialForce()
            body = self.plant.GetBodyByName(link, self.model)
            applied.body_index = body.index()
            pose = self.plant.EvalBodyPoseInWorld(self.context, body)
            applied.p_BoBq_B = pose.inverse().multiply(self.handles[link])
            zero = np.zeros(3)
            applied.F_Bq_W = self.drake.SpatialForce(zero if torque is None else torque, zero if force is None else force)
            forces = [applied]
        self.plant.get_applied_spatial_force_input_port().FixValue(
            self.context, self.drake.Value[list[self.drake.ExternallyAppliedSpatialForce]](forces)
        )
        self.time += self.dt
        self.simulator.AdvanceTo(self.time)

    def positions(self) -> Positions:
        q = self.plant.GetPositions(self.context)
        return {name: float(q[joint.position_start()]) for name, joint in self.joints.items()}

    def root(self) -> np.ndarray:
        return self.plant.EvalBodyPoseInWorld(self.context, self.top).translation()


class Newton(Mujoco):
    """The model that `SolverMuJoCo` makes of the file, stepped by the MuJoCo below it without Newton's copies of each state."""

    def __init__(self, folder: Path, robot: Robot, gravity: np.ndarray, stated: Stated, ground: float | None = None) -> None:
        import mujoco
        import newton
        import warp

        warp.config.quiet = True
        self.mujoco, self.handles = mujoco, stated.handles
        builder = newton.ModelBuilder(gravity=tuple(gravity.tolist()))
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        builder.add_mjcf(str(folder / f"{robot.name}.xml"), parse_visuals=False)
        if ground is not None:
            builder.add_ground_plane(height=ground)
        self.solver = newton.solvers.SolverMuJoCo(builder.finalize(device="cpu"), use_mujoco_cpu=True)
        model, moving = self.solver.mj_model, {j.name for j in robot.moving}
        joints = {label.rsplit("/", 1)[-1]: label.replace("/", "_") for label in builder.joint_label}
        bodies = {label.rsplit("/", 1)[-1]: model.body(label.replace("/", "_")).id for label in builder.body_label}
        names = {name: model.joint(full).id for name, full in joints.items() if name in moving}
        self.use(model, gravity, stated, names, bodies)
        self.top = bodies[robot.roots[0]]


ENGINES = {"mujoco": Mujoco, "sapien": Sapien, "drake": Drake, "newton": Newton}


class Hand:
    """Measures the joints of one asset in one engine. joints: records of asset.json with `opened`, joints that must be open."""

    def __init__(self, engine: str, folder: Path, robot: Robot, joints: list[dict[str, Any]]) -> None:
        self.engine, self.folder, self.robot, self.joints = ENGINES[engine], folder, robot, {j["name"]: j for j in joints}
        self.dt = FINE_DT if engine == "drake" and any(j["pull"]["unit"] == "N m" for j in joints) else DT
        handles = {j["child"]: np.array(j["pull"]["at"]) for j in joints}
        self.stated = Stated(handles, springs_of(joints), dt=self.dt)
        self.world: World = self.engine(folder, robot, np.array([0, 0, -GRAVITY]), self.stated)

    def step(self, joint: dict[str, Any], amount: float) -> None:
        """Advance with a pull of an amount [N or N m] in the stated direction."""
        vector = amount * np.array(joint["pull"]["direction"])
        if joint["pull"]["unit"] == "N":
            self.world.step(joint["child"], force=vector)
        else:
            self.world.step(joint["child"], torque=vector)

    def motion(self, joint: dict[str, Any], change: float) -> float:
        """Return the motion of the handle, relative to what counts as moving."""
        if joint["pull"]["unit"] != "N" or joint["type"] != "prismatic":
            arm = np.linalg.norm(np.cross(joint["axis"], np.subtract(joint["pull"]["at"], joint["origin"])))
            return change / MOVED_RAD if joint["pull"]["unit"] != "N" else change * max(float(arm), 1e-3) / MOVED_M
        return change / MOVED_M

    def opened(self, joint: dict[str, Any]) -> Positions:
        """Return the positions of the joints that must be open for this one to move."""
        return {o: self.joints[o]["limits"][1] if self.joints[o]["limits"] else 0.0 for o in joint["opened"]}

    def begins(self, joint: dict[str, Any]) -> dict[str, Any]:
        """Find the least pull that moves the handle within PULL_S from rest, by halving between two pulls."""
        name, pull = joint["name"], starts(joint)
        others = frozenset(self.joints) - {name}
        self.world.reset(self.opened(joint), others)
        for _ in range(round(REST_S / self.dt)):
            self.world.step()
        rest = self.world.positions()
        sank = self.motion(joint, abs(rest[name]))

        def moves(amount: float) -> bool:
            self.world.reset(rest, others)
            for _ in range(round(PULL_S / self.dt)):
                self.step(joint, amount)
                if self.motion(joint, abs(self.world.positions()[name] - rest[name])) > 1:
                    return True
            return False

        low, high = 0.5 * min(pull["least"], pull["typical"]), 2 * max(pull["most"], pull["typical"])
        low = max(low, 0.0)
        if moves(low):
            return {"begins": low, "bound": "below", "sank": sank}
        if not moves(high):
            return {"begins": high, "bound": "above", "sank": sank}
        for _ in range(HALVINGS):
            middle = float(np.sqrt(low * high)) if low > 0 else high / 2
            low, high = (low, middle) if moves(middle) else (middle, high)
        return {"begins": float((low + high) / 2), "bound": "", "sank": sank}

    def settles(self, joint: dict[str, Any]) -> dict[str, Any]:
        """Push a joint open, let go, and watch whether it swings back and forth after CALM_S."""
        name, pull = joint["name"], starts(joint)
        self.world.reset(self.opened(joint), frozenset(self.joints) - {name})
        amount = 1.5 * max(pull["typical"], pull["most"], 1e-3)
        far = FAR_RAD if joint["type"] != "prismatic" else FAR_M
        for _ in range(round(PUSH_S / self.dt)):
            self.step(joint, amount)
            if abs(self.world.positions()[name]) > far:
                break
        at = []
        for k in range(round((CALM_S + WATCH_S) / self.dt)):
            self.world.step()
            if k * self.dt >= CALM_S:
                at.append(self.world.positions()[name])
        return {"swing": self.motion(joint, _swing(np.array(at))), "ends": at[-1]}

    def holds(self, joint: dict[str, Any], at: float) -> float:
        """Return how far a joint moves within CALM_S from a position [rad or m]."""
        self.world.reset(self.opened(joint) | {joint["name"]: at}, frozenset(self.joints) - {joint["name"]})
        for _ in range(round(CALM_S / self.dt)):
            self.world.step()
        return self.world.positions()[joint["name"]] - at

    def tilted(self) -> Positions:
        """Return the largest motion of each handle on ground that slopes by one degree, of four directions."""
        worst = dict.fromkeys(self.joints, 0.0)
        for angle in np.arange(4) * np.pi / 2:
            down = np.array([np.cos(angle) * np.sin(SLOPE), np.sin(angle) * np.sin(SLOPE), -np.cos(SLOPE)])
            world: World = self.engine(self.folder, self.robot, GRAVITY * down, self.stated)
            world.reset({}, frozenset())
            for _ in range(round(TILT_S / self.dt)):
                world.step()
            for name, at in world.positions().items():
                worst[name] = max(worst[name], self.motion(self.joints[name], abs(at)))
        return worst


def springs_of(joints: list[dict[str, Any]]) -> dict[str, tuple[float, float]]:
    """Return the springs of joints: stiffness [N/m or N m/rad] and the position at which they are relaxed [m or rad]."""
    some = {j["name"]: j.get("mechanism", {}) for j in joints}
    return {name: (m["stiffness"], m["reference"]) for name, m in some.items() if "stiffness" in m}


def starts(joint: dict[str, Any]) -> dict[str, float]:
    """Return what starts a joint by its asset.json, mechanism included: least, typical, most."""
    pull = joint["pull"]
    more = joint["mechanism"]["force"] - pull["typical"] if "mechanism" in joint else 0.0
    return {word: pull[word] + more for word in ("least", "typical", "most")}


def _swing(at: np.ndarray) -> float:
    """Return the smaller way of the two, forth and back, of a path: 0 if it goes one way or stands."""
    steps = np.diff(at)
    return float(min(steps[steps > 0].sum(), -steps[steps < 0].sum()))


def rolls(engine: str, job: dict[str, Any]) -> dict[str, float]:
    """Return how far a car rolls down a slope of 30 degrees in 2 s, with and without dry friction of its joints [m].

    job: its folder, `ground`, and `down` the slope.
    """
    folder = Path(job["folder"])
    record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
    slope = GRAVITY * (0.5 * np.array(job["down"]) + np.sqrt(0.75) * np.array([0, 0, -1]))
    robot = read_urdf(folder / f"{record['name']}.urdf")
    found = {}
    for word, loose in (("rolled", False), ("loose", True)):
        world: World = ENGINES[engine](folder, robot, slope, Stated({}, {}, loose), job["ground"])
        world.reset({}, frozenset())
        world.step()
        start = world.root()
        for _ in range(round(2.0 / DT)):
            world.step()
        found[word] = float((world.root() - start) @ job["down"])
    return found


def of_physx(job: dict[str, Any]) -> dict[str, Any]:
    """Return the pull that starts each joint in PhysX, from the force at the joint that moves it within PULL_S.

    Springs of joints that are opened for it are balanced: without gravity they would close them.
    """
    folder = Path(job["folder"])
    record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
    robot = read_urdf(folder / f"{record['name']}.urdf")
    world = physx_.World(robot.path, robot, dict.fromkeys((j.name for j in robot.moving), Motor(0.0, 0.0, 0.0, 1.0)))
    answer, springs = {}, springs_of(job["joints"])
    for joint in job["joints"]:
        at, pull, start = world.names.index(joint["name"]), joint["pull"], np.zeros(len(world.names))
        balance = np.zeros(len(world.names))
        for name in joint["opened"]:
            opened = next(j["limits"][1] for j in job["joints"] if j["name"] == name)
            stiffness, relaxed = springs.get(name, (0.0, 0.0))
            start[world.names.index(name)], balance[world.names.index(name)] = opened, stiffness * (opened - relaxed)
        arm = np.cross(joint["axis"], np.subtract(pull["at"], joint["origin"]))
        lever = max(float(np.linalg.norm(arm)), 1e-3) if pull["unit"] == "N" and joint["type"] != "prismatic" else 1.0
        opens = -1.0 if joint["limits"] and sum(joint["limits"]) < 0 else 1.0
        far = MOVED_M if joint["type"] == "prismatic" else MOVED_RAD if pull["unit"] != "N" else MOVED_M / lever

        def moves(
            force: float,
            at: int = at,
            start: np.ndarray = start,
            rest: np.ndarray = balance,
            far: float = far,
            sign: float = opens,
        ) -> bool:
            world.reset(start)
            forces = rest.copy()
            forces[at] = sign * force
            for _ in range(round(PULL_S / STEP)):
                world.push(forces)
            return bool(abs(world.positions()[at] - start[at]) > far)

        stated = starts(joint)
        low, high = 0.3 * joint["friction"], 3 * joint["friction"] + 2 * lever * (stated["typical"] - pull["typical"])
        bound = "below" if moves(low) else "" if moves(high) else "above"
        for _ in range(0 if bound else HALVINGS):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if moves(middle) else (middle, high)
        begins = pull["typical"] + ((low if bound == "below" else high) - joint["friction"]) / lever
        answer[joint["name"]] = {"begins": float(begins), "bound": bound}
    return answer


def measure(engine: str, job: dict[str, Any]) -> dict[str, Any]:
    """Measure one asset. job: folder, joints as in asset.json, each with `opened`."""
    if engine == "ovphysx":
        return of_physx(job)
    folder = Path(job["folder"])
    record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
    robot = read_urdf(folder / f"{record['name']}.urdf")
    hand = Hand(engine, folder, robot, job["joints"])
    answer: dict[str, Any] = {"tilted": hand.tilted()}
    for name, joint in hand.joints.items():
        answer[name] = hand.begins(joint) | hand.settles(joint)
        held = [np.deg2rad(60), *([] if joint["limits"] is None else [joint["limits"][1] / 2])]
        answer[name]["holds"] = hand.holds(joint, float(min(held))) if joint["type"] == "revolute" else None
    return answer


def main() -> None:
    engine, jobs, file = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    answers: dict[str, Any] = {"version": f"{engine} {version(engine)}"}
    for job in json.loads(jobs.read_text(encoding="utf-8")):
        if "down" in job and engine not in ENGINES:
            continue
        try:
            answers[job["name"]] = rolls(engine, job) if "down" in job else measure(engine, job)
        except Exception:  # one asset's failure is a result
            answers[job["name"]] = {"error": traceback.format_exc(limit=3)[-400:]}
        file.with_suffix(".part").write_text(json.dumps(answers), encoding="utf-8")
        print(engine, job["name"], flush=True)
    file.write_text(json.dumps(answers), encoding="utf-8")


if __name__ == "__main__":
    main()
