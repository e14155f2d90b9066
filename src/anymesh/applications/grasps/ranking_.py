"""Rank grasps by what they do: a floating gripper closes on the part in MuJoCo and leads it along its joint."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image, ImageDraw

from anymesh.applications.grasps.candidates import candidates, opening_way
from anymesh.applications.grasps.grasps import Grasp, GraspKind, JointGrasps
from anymesh.applications.plan.asset_ import geom_triangles, shown_geoms
from anymesh.applications.plan.film_ import tiled
from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.applications.plan.robot_ import single_joints
from anymesh.applications.plan.targets import EPS, FACING, sample_surface
from anymesh.applications.policy.controller_ import BACK, DONE, SHORT, InteractionFailure, follow_target, open_gap
from anymesh.applications.policy.objects_ import TaskObject, moving_joints, object_at_rest
from anymesh.applications.policy.robots_ import GRIPPER, REACH, Gripper, floating_gripper
from anymesh.applications.policy.simulation_ import ScenePicture, TaskSimulation
from anymesh.applications.policy.tasks import NOMINAL, PolicyTask, Randomization
from anymesh.errors import AnymeshError, OptionError
from anymesh.geometry.raycast_ import RayScene
from anymesh.mujoco_ import load_mujoco
from anymesh.names import listed
from anymesh.runtime import Progress, read_json, silent, writing
from anymesh.types import JointType
from anymesh.types.triangles import unshared

GOOD, SURE, SCORED = 4, 0.95, 12  # grasps above a score with which the search ends, or that are scored
TRIALS = 5  # of each of these: the first as stated, the others displaced
MIN_SCORE = 0.1  # share of the motion below which a grasp is none
DEEP, STEPS = 1e-3, 6  # [m] by which the open gripper may be within a surface at any of some places on its way
MOST_OPENED = 2  # other joints that may have to be opened first
MOST_DRAWN, COLUMNS = 16, 4  # of the picture
HIDDEN = 0.02  # share of a part's surface that another part is in front of
VARIED = Randomization(0.003, 1.0, (0.5, 1.0), 1.4, 2.0, 2.0, 0.0)  # what docs/plan.md displaces its three tasks by


def rank_grasps(
    asset: str | Path, joint: str | None = None, *, gripper: Gripper = GRIPPER, seed: int = 0, progress: Progress = silent
) -> tuple[JointGrasps, ...]:
    """Return the grasps of each joint that moves, or of one, best first. asset: an asset's folder, a URDF or an MJCF.

    Raise InputError if the asset cannot be read, OptionError for an unknown joint.
    """
    path = Path(asset)
    names, stated = moving_joints(path), _stated(path)
    asked = (joint,) if joint is not None else tuple(n for n in names if not stated or n in stated)
    if joint is not None and joint not in names:
        raise OptionError(f"--joint: found {joint!r}; valid are {listed(names) or 'none, since no joint moves'}")
    ranked = []
    for number, name in enumerate(asked):
        progress("grasps", name, number, len(asked))
        ranked.append(_ranked(path, name, gripper, seed))
    others = [j for n, j in stated.items() if n not in names and j.get("type") != JointType.FIXED] if joint is None else []
    reason = "only hinges and slides are tried, found {}"
    return (*ranked, *(JointGrasps(j["name"], j["child"], 0.0, (), reason=reason.format(j.get("type"))) for j in others))


def _stated(path: Path) -> dict[str, dict[str, Any]]:
    """Return the joints of asset.json by name, none for a file."""
    record = (read_json(path / "asset.json") or {}) if path.is_dir() else {}
    joints = record.get("joints")
    named = [j for j in joints if isinstance(j, dict)] if isinstance(joints, list) else []
    return {str(j["name"]): j for j in named if {"name", "child"} <= j.keys()}


def gripper_simulation(object_: TaskObject, gripper: Gripper) -> TaskSimulation:
    """Return a simulation of an object with a floating gripper."""
    hand = floating_gripper(np.eye(3), gripper)
    return TaskSimulation(object_, PolicyTask.OPEN, hand, R_world_tool=np.eye(3), stays=False)


def _ranked(path: Path, joint: str, gripper: Gripper, seed: int) -> JointGrasps:
    """Return the grasps of a joint at rest; if none does it, also after what is in front of the part has been opened."""
    after: tuple[tuple[str, float], ...] = ()
    made: list[JointGrasps] = []
    for _ in range(MOST_OPENED + 1):
        try:
            object_ = object_at_rest(path, joint, after)
        except AnymeshError as error:
            return JointGrasps(joint, "", 0.0, (), reason=str(error))
        made.append(_of_object(path, object_, gripper, seed))
        blocker = None if _best(made[-1]) >= DONE else _in_front(object_)
        if blocker is None or blocker in dict(after):
            break
        after = (*after, (blocker, object_at_rest(path, blocker).goal.goal))
    return max(made, key=_best)


def _best(found: JointGrasps) -> float:
    return found.grasps[0].score if found.grasps else 0.0


def _of_object(path: Path, object_: TaskObject, gripper: Gripper, seed: int) -> JointGrasps:
    """Return the grasps that move the joint to its goal, or the one that moves it the farthest.

    Grasps come first, pushes only if no grasp does it; for short slides the other way round.
    """
    thing, simulation = object_.thing, gripper_simulation(object_, gripper)
    free = partial(fits, object_, simulation)
    handle = _stated(path).get(thing.joint, {}).get("handle")
    contacts = [GripperContact.GRASP, GripperContact.PUSH]
    if not thing.turns and abs(object_.goal.goal) < SHORT:
        contacts.reverse()
    grasps: list[tuple[bool, Grasp]] = []  # whether it moves the joint to its goal
    why = InteractionFailure.NO_PLACE
    for contact in contacts:
        for kind, target in candidates(object_, gripper, handle, contact, seed=seed, fits=free):
            grasp, failure = _tried(object_, simulation, kind, target, seed)
            why = failure or why
            if failure is None or (grasp.score > MIN_SCORE and grasp.score > max((g.score for _, g in grasps), default=0.0)):
                grasps.append((failure is None, grasp))
            done = [g for good, g in grasps if good]
            if len(done) == SCORED or sum(g.score > SURE for g in done) == GOOD:
                break
        if any(good for good, _ in grasps):
            break
    best = [g for good, g in grasps if good] or [g for _, g in grasps[-1:]]
    best.sort(key=lambda g: (g.score >= DONE, g.prehensile, round(g.score, 2), -g.slip), reverse=True)
    return JointGrasps(thing.joint, thing.part, object_.goal.goal, tuple(best[:GOOD]), thing.opened, "" if best else why.value)


def _tried(
    object_: TaskObject, simulation: TaskSimulation, kind: GraspKind, target: Target, seed: int
) -> tuple[Grasp, InteractionFailure | None]:
    """Move the gripper to a target and lead it along the joint; if that does it, also on objects that are displaced."""
    first = follow_target(object_, target, simulation)
    shares, rng = [first.share], np.random.default_rng(seed)
    if first.failure is None:
        shares += [follow_target(object_, target, simulation, VARIED.draw(rng)).share for _ in range(1, TRIALS)]
    score = float(np.clip(shares, 0, 1).mean())
    pose = in_link(object_, simulation) @ target.T_asset_tool
    return Grasp(kind, pose, target.width, score, first.share * object_.goal.goal, first.slip), first.failure


def in_link(object_: TaskObject, simulation: TaskSimulation) -> Float[np.ndarray, "4 4"]:
    """Return the transform from the asset frame at rest to that of the joint's link."""
    simulation.reset(NOMINAL)
    return np.linalg.inv(simulation.part_pose) @ object_.T_world_asset


def _in_front(object_: TaskObject) -> str | None:
    """Return the joint of what hides the part of the object, in the direction of its motion or else around it, or None."""
    thing, mujoco = object_.thing, load_mujoco()
    model = thing.spec.compile()
    data = mujoco.MjData(model)
    for name, value in thing.opened:
        data.qpos[model.joint(name).qposadr[0]] = value
    mujoco.mj_forward(model, data)
    joint_of = {int(model.jnt_bodyid[j]): model.joint(j).name for j in single_joints(model) if model.jnt_limited[j]}
    shown = shown_geoms(model)
    surfaces = [geom_triangles(mujoco, model, data, geom) for geom in shown]
    bodies = np.repeat(model.body_weldid[model.geom_bodyid[shown]], [len(some) for some in surfaces])
    own, scene = {int(model.body(name).id) for name in thing.carried}, RayScene(*unshared(np.concatenate(surfaces)))
    points, normals = sample_surface(thing.part_triangles, np.random.default_rng(0))
    hits = scene.first_hit(points + EPS * normals, normals)
    met = np.where(np.isfinite(hits.distance), bodies[hits.face], -1)
    ahead = normals @ opening_way(object_) > FACING * np.linalg.norm(opening_way(object_))
    for some in (met[ahead], met):
        names = [joint_of[b] for b in some if b in joint_of and b not in own]
        if len(names) > HIDDEN * len(some):
            return max(sorted(set(names)), key=names.count)
    return None


def fits(object_: TaskObject, simulation: TaskSimulation, target: Target) -> bool:
    """Return whether the gripper, open or closed to push, is free on its way to a target."""
    s, T = simulation, object_.T_world_asset @ target.T_asset_tool
    s.aim(T[:3, :3])
    s.reset(NOMINAL)
    end = -REACH if target.contact is GripperContact.PUSH else 0.0
    for along in np.linspace(end - BACK, end, STEPS):
        s.command_tool(T[:3, 3] + along * T[:3, 2], T[:3, :3], open_gap(s, target), jump=True)
        s.mujoco.mj_kinematics(s.model, s.data)
        s.mujoco.mj_collision(s.model, s.data)
        if any(c.dist < -DEEP and (s.is_robot[c.geom1] != s.is_robot[c.geom2]) for c in s.data.contact[: s.data.ncon]):
            return False
    return True


def placed(asset: str | Path, found: JointGrasps, gripper: Gripper) -> tuple[TaskObject, TaskSimulation, list[Target]]:
    """Return the object of a joint, what had to be opened first being open, its simulation, and the grasps as targets."""
    object_ = object_at_rest(asset, found.joint, found.after)
    simulation = gripper_simulation(object_, gripper)
    T = np.linalg.inv(in_link(object_, simulation))
    contacts = [GripperContact.GRASP if g.prehensile else GripperContact.PUSH for g in found.grasps]
    targets = [Target(c, T @ g.T_link_tool, g.width, g.score) for c, g in zip(contacts, found.grasps, strict=True)]
    return object_, simulation, targets


def write_picture(path: Path, asset: str | Path, found: Sequence[JointGrasps], gripper: Gripper) -> Path | None:
    """Draw what the best grasp of each joint leads to; return None if there is none. Raise OutputError."""
    frames = []
    for joint in [j for j in found if j.grasps][:MOST_DRAWN]:
        object_, simulation, targets = placed(asset, joint, gripper)
        follow_target(object_, targets[0], simulation)
        picture = Image.fromarray(ScenePicture(simulation).frame())
        words = f"{joint.joint}: {joint.grasps[0].kind}, score {joint.grasps[0].score:.2f}"
        ImageDraw.Draw(picture).text((6, 4), words.encode("ascii", "replace").decode(), fill=(0, 0, 0))
        frames.append(np.asarray(picture))
    if not frames:
        return None
    with writing(path):
        Image.fromarray(tiled(frames, min(COLUMNS, len(frames)))).save(path)
    return path
