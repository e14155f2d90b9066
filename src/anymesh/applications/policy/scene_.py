"""MuJoCo model of an environment: the object, fixed or free to be lifted, a robot, and the floor."""

from __future__ import annotations

from typing import Any

import numpy as np

from anymesh.applications.plan.robot_ import quaternion, without_visuals
from anymesh.applications.policy.objects_ import TaskObject
from anymesh.applications.policy.robots_ import TaskRobot
from anymesh.mujoco_ import load_mujoco

OBJECT, ROBOT, STAND, FLOOR = "object/", "robot/", "stand", "floor"
TIMESTEP = 0.005  # [s]
ON_FLOOR, ON_OBJECT, ON_ROBOT, ON_FOOT = 1, 2, 4, 8  # collision bits
HANDLE_RADIUS, HANDLE_HALF = 0.008, 0.04  # [m] of the capsule that thickens a handle, as DexArt does
STIFF = [0.95, 0.99, 0.001, 0.5, 2.0]  # impedance of contacts, limits and dry friction
PRIORITY = 3  # of the object's contacts, so that its friction applies
FOOT = 0.05  # share of the object's height; vertices below it define its foot
HELD_MASS = 0.02  # [kg] least mass of a link; thinner ones of a shell make the contacts of a light handle unstable
MAX_MASS = 1.0  # [kg] of an object that is lifted; heavier ones are made lighter in proportion


def compose(object_: TaskObject, robot: TaskRobot, *, lifts: bool, visuals: bool = False) -> Any:
    """Return the spec of the scene; the object collides with the robot, the robot and a free object with the floor.

    lifts: whether the object is free; its foot, a box, then stands on the floor, and its handle is thickened.
    """
    mujoco = load_mujoco()
    spec = mujoco.MjSpec()
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.timestep = TIMESTEP
    spec.option.iterations = 30
    floor = spec.worldbody.add_geom(name=FLOOR, type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1], rgba=[0.82, 0.82, 0.8, 1])
    _attach_object(mujoco, spec, object_, lifts, visuals)
    spec.attach(robot.spec.copy() if visuals else without_visuals(robot.spec), frame=spec.worldbody.add_frame(), prefix=ROBOT)
    for geom in spec.geoms:
        if not (geom.contype or geom.conaffinity) or geom.name == floor.name:
            continue
        mine = geom.parent.name.startswith(ROBOT)
        geom.contype, geom.conaffinity = (ON_ROBOT, ON_OBJECT | ON_FLOOR) if mine else (ON_OBJECT, ON_ROBOT)
        if not mine:
            geom.condim, geom.priority = 4 if lifts else 3, PRIORITY
            geom.friction = [1.0, 0.02, 1e-3]
            geom.solref, geom.solimp = [0.01, 1.0], STIFF
    floor.contype, floor.conaffinity = ON_FLOOR, ON_ROBOT
    if lifts:
        _add_foot(mujoco, spec, object_)
        _thicken(mujoco, spec, object_)
    joint = spec.joint(OBJECT + object_.thing.joint)
    joint.solref_limit, joint.solimp_limit = [0.01, 1.0], STIFF
    joint.solref_friction, joint.solimp_friction = [0.01, 1.0], STIFF  # creeps less under gravity than by default
    return spec


def _attach_object(mujoco: Any, spec: Any, object_: TaskObject, lifts: bool, visuals: bool) -> None:
    """Attach the object to a body that a reset moves; a free object has a free joint in its place."""
    own = object_.thing.spec.copy() if visuals else without_visuals(object_.thing.spec)
    T = object_.T_world_asset
    stand = spec.worldbody.add_body(name=STAND, pos=T[:3, 3], quat=quaternion(T[:3, :3]))
    if lifts:
        stand.add_freejoint()
        stand.mass, stand.inertia, stand.explicitinertial = 1e-3, [1e-6] * 3, True
    else:
        stand.mocap = True
    spec.attach(own, frame=stand.add_frame(), prefix=OBJECT)


def _add_foot(mujoco: Any, spec: Any, object_: TaskObject) -> None:
    """Add a box below the object that alone touches the floor, which is faster and rests better than its shapes."""
    points = object_.thing.other_triangles.reshape(-1, 3)
    low = points[points[:, 2] <= points[:, 2].min() + FOOT * max(float(np.ptp(points[:, 2])), 1e-6)]
    a, b = low.min(0), low.max(0)
    half = [max((b[0] - a[0]) / 2, 0.02), max((b[1] - a[1]) / 2, 0.02), 0.005]
    foot = spec.body(STAND).add_geom(
        name="foot", type=mujoco.mjtGeom.mjGEOM_BOX, size=half, pos=[*((a + b)[:2] / 2), a[2] + 0.005], mass=0.0,
        rgba=[0, 0, 0, 0], friction=[0.8, 0.02, 1e-3],
    )  # fmt: skip
    foot.contype, foot.conaffinity = ON_FOOT, ON_FLOOR
    spec.geom(FLOOR).conaffinity = ON_ROBOT | ON_FOOT


def _thicken(mujoco: Any, spec: Any, object_: TaskObject) -> None:
    """Add a capsule along the axis at the handle point, so that a thin wire can be held (DexArt thickens its handles too)."""
    part = spec.body(OBJECT + object_.thing.part)
    model = object_.thing.spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    body = int(model.body(object_.thing.part).id)
    R, at = data.xmat[body].reshape(3, 3), data.xpos[body]
    center, axis = R.T @ (object_.handle - at), R.T @ object_.thing.motion.axis
    ends = [*(center - HANDLE_HALF * axis), *(center + HANDLE_HALF * axis)]
    part.add_geom(
        name="thick_handle", type=mujoco.mjtGeom.mjGEOM_CAPSULE, fromto=ends, size=[HANDLE_RADIUS, 0, 0], mass=0.0,
        contype=ON_OBJECT, conaffinity=ON_ROBOT, condim=4, priority=PRIORITY, friction=[1.0, 0.02, 1e-3],
        solref=[0.01, 1.0], solimp=STIFF, rgba=[0.3, 0.3, 0.35, 1],
    )  # fmt: skip


def limit_masses(mujoco: Any, model: Any, lifts: bool) -> None:
    """Give each link of the object a least mass, and a lifted object at most `MAX_MASS`."""
    own = [b for b in range(model.nbody) if model.body(b).name.startswith(OBJECT)]
    total = float(model.body_mass[own].sum())
    factor = MAX_MASS / total if lifts and total > MAX_MASS else 1.0
    for b in own:
        mass = float(model.body_mass[b])
        if mass > 0:
            wanted = max(mass * factor, HELD_MASS)
            model.body_mass[b] = wanted
            model.body_inertia[b] *= wanted / mass
