"""The paper's three tasks (4.2): plan on a digital twin, replay open loop on the true object, somewhat off, fifty times.

    python -m benchmarks.plan WORK [--robot panda] [--trials 50] [--first-trial 0] [--tasks trigger,door,wheel]
        [--twins ours,corrected,truth,paper] [--pictures] [--markdown FILE]

A second MuJoCo simulation with the true joints stands in for the real robot. Twins: ours (`anymesh articulate` on the mesh),
corrected (ours with the sign of the joint set right by hand), truth (the true parts and joints: an upper bound), paper (the
paper's rule alone for every joint, `verify="off"`, with ground truth in the place of the model), scan (ours of a simulated
RGB-D scan of the object, by `anymesh scan`) and answered (the drill's scan again, with the recorded blind answers of a general
model that saw the pictures, `recordings/scans/`). The last two are not among the defaults. Where a
twin allows less than the task's value, the nearest value that the planner names is planned and asked of the true object, if it
is at least half of it.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections import Counter
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from PIL import Image

from anymesh.applications.plan.asset_ import ArticulatedObject, open_object
from anymesh.applications.plan.film_ import Film, tiled
from anymesh.applications.plan.planner import Arm, Settings, open_arm, plan_motion
from anymesh.applications.plan.plans import BasePose, MotionPlan, Phase, PlanError
from anymesh.applications.plan.replay_ import Physics, replay
from anymesh.config import Config
from anymesh.correcting import FlipSign, HistoryEntry, Opened, open_asset, save_asset
from anymesh.errors import AnymeshError
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, prepared, read_ground_truth
from anymesh.evaluation.oracle import oracle
from anymesh.export import write_asset
from anymesh.pipeline import articulate
from anymesh.pipeline.solving import solve
from benchmarks import EXAMPLES, RECORDINGS, parser_of, table_head, table_row

TWINS = ("ours", "corrected", "truth", "paper")
MIN_SHARE = 0.5  # of the task's value, that a twin must allow
LEAN = 35.0  # [deg] of the wheel's axis from the horizontal
RADIUS, TUBE, HUB = 0.16, 0.012, np.array([0.0, -0.06, 0.33])  # [m] of the rim; where the hub is


def steering_wheel():
    """Build a wheel of three spokes on a leaning column, clamped to a box, as a `Thing` of examples/objects.py.

    [m, Z up, the driver at -Y]. It is no example, as sets of examples are trained and reported on.
    """
    sys.path.insert(0, str(EXAMPLES))
    try:
        from objects import Thing, spin
        from solids import box, cut, join, moved, ring, rod, turned
    finally:
        sys.path.remove(str(EXAMPLES))
    up, away = np.sin(np.deg2rad(LEAN)), np.cos(np.deg2rad(LEAN))
    axis = np.array([0.0, -away, up])
    t = Thing("steering_wheel", "steering wheel")

    def placed(solid):
        """From the wheel's own frame, its axis along z, to where it is."""
        return moved(turned(solid, (1, 0, 0), 90 - LEAN, (0, 0, 0)), tuple(HUB))

    t.add("base", box((-0.12, 0.12), (0.03, 0.23), (0.0, 0.2)))
    t.add("base", placed(rod("z", 0.018, 0.16, (0, 0, -0.1))), color="dark")
    hub = cut(rod("z", 0.035, 0.03, (0, 0, 0), 40), rod("z", 0.0085, 0.1, (0, 0, 0), 24))
    t.add("base", placed(rod("z", 0.008, 0.06, (0, 0, -0.01), 24)), color="metal")
    spokes = [turned(box((0.03, RADIUS), (-0.011, 0.011), (-0.005, 0.005)), (0, 0, 1), a, (0, 0, 0)) for a in (0, 180, 270)]
    t.add("wheel", placed(join(ring("z", RADIUS, TUBE, (0, 0, 0)), hub, *spokes)), color="dark")
    t.joints["wheel"] = spin(tuple(HUB), tuple(axis), "wheel")
    return t


def true_object(name: str, folder: Path) -> GroundTruth:
    """The mesh file of an object and its truth; the steering wheel is written into a folder."""
    if name != "steering_wheel":
        return read_ground_truth(EXAMPLES / "truth" / f"{name}.json", EXAMPLES / "meshes" / f"{name}.glb")
    sys.path.insert(0, str(EXAMPLES))
    try:
        from build import build, truth
    finally:
        sys.path.remove(str(EXAMPLES))
    thing = steering_wheel()
    data, labels = build(thing)
    folder.mkdir(parents=True, exist_ok=True)
    mesh = folder / f"{name}.glb"
    mesh.write_bytes(data)
    (folder / f"{name}.json").write_text(json.dumps(truth(thing), indent=1), encoding="utf-8")
    np.save(folder / f"{name}.npy", labels)
    return read_ground_truth(folder / f"{name}.json", mesh)


@dataclass(frozen=True)
class Task:
    """What is done to which object. value: of the true joint [rad or m]; damping, friction, spring: of the true joint."""

    name: str
    thing: str
    part: str
    value: float
    damping: float
    friction: float
    spring: float = 0.0


TASKS = {
    t.name: t
    for t in (
        Task("trigger", "drill", "trigger", -0.01, damping=20.0, friction=2.0, spring=600.0),
        Task("door", "microwave", "door", float(np.deg2rad(75)), damping=0.3, friction=0.3),
        Task("wheel", "steering_wheel", "wheel", float(np.deg2rad(60)), damping=0.2, friction=0.3),
    )
}


def perturbed(rng: np.random.Generator, spring: float) -> Physics:
    """The true object, off by up to 3 mm and 1 degree, with other friction and weight than anybody knew."""
    x, y = rng.uniform(-0.003, 0.003, 2)
    return Physics(
        friction=float(rng.uniform(0.5, 1.0)),
        mass=float(rng.uniform(0.7, 1.4)),
        damping=float(np.exp(rng.uniform(np.log(0.5), np.log(2)))),
        joint_friction=float(np.exp(rng.uniform(np.log(0.5), np.log(2)))),
        spring=spring * float(rng.uniform(0.7, 1.3)),
        shift=(float(x), float(y), float(rng.uniform(-0.001, 0.001))),
        yaw=float(np.deg2rad(rng.uniform(-1, 1))),
    )


def true_asset(task: Task, subject: EvalSample, folder: Path) -> Path:
    """The object with its true parts and joints, written once."""
    if not (folder / "asset.json").exists():
        asset = subject.asset()
        own = f"{task.part}_joint"
        source = replace(asset.source, T_asset_source=subject.T)
        folder.mkdir(parents=True)
        write_asset(replace(asset, source=source), folder)
        path = folder / f"{asset.name}.xml"
        written = ElementTree.parse(path)
        for joint in written.iterfind(f".//joint[@name='{own}']"):
            joint.attrib |= {"damping": str(task.damping), "frictionloss": str(task.friction)}
        written.write(path)
    return folder


def twin(kind: str, task: Task, subject: EvalSample, work: Path) -> Path:
    """The folder of a twin, made if it is not there."""
    folder = work / kind / task.thing
    if (folder / "asset.json").exists():
        return folder
    if kind == "truth":
        return true_asset(task, subject, work / "true" / task.thing)
    if kind == "ours":
        articulate(subject.truth.mesh, folder)
    elif kind == "corrected":
        shutil.copytree(twin("ours", task, subject, work), folder)
        part = matched(folder, task, subject)[1]
        opened = open_asset(folder)
        flipped = opened.history.do(HistoryEntry(FlipSign(part), time="2026-01-01T00:00:00+00:00", author="benchmark"))
        save_asset(Opened(opened.folder, flipped, opened.version))
    elif kind == "paper":
        segmentation, joints = solve(subject.mesh, config=Config(verify="off"), answerer_factory=lambda _: oracle(subject))
        asset = replace(subject.asset(), segmentation=segmentation, joints=joints)
        folder.mkdir(parents=True)
        write_asset(replace(asset, source=replace(asset.source, T_asset_source=subject.T)), folder)
    return folder


def scanned(subject: EvalSample, task: Task, kind: str, work: Path) -> tuple[Path, np.ndarray]:
    """Return the twin made from a scan of the true object, 60 rendered RGB-D frames with noise, and `T_true_file` of `matched`.

    kind: "scan" by geometry, "answered" with the recorded blind answers.
    """
    module = import_module("anymesh.applications.scan")
    folder, asset = work / "scans" / task.thing, work / kind / task.thing
    if not (folder / "T.json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        module.render_frames(subject.mesh, folder / "frames", views=60, noise=0.0015, seed=0)
        report = module.scan(folder / "frames", folder / "scan.glb", force=True)
        truth = json.loads((folder / "frames" / "truth.json").read_text(encoding="utf-8"))
        T_glb_scan = np.eye(4)
        T_glb_scan[:3, :3] = import_module("anymesh.applications.scan.scanning").TO_GLTF
        T = np.linalg.inv(T_glb_scan @ np.array(report.T_scan_world) @ np.array(truth["T_world_mesh"]))
        (folder / "T.json").write_text(json.dumps(T.tolist()), encoding="utf-8")
    if not (asset / "asset.json").exists():
        answerer = f"replay:{RECORDINGS / 'scans' / task.thing}" if kind == "answered" else "geometry"
        articulate(folder / "scan.glb", asset, force=True, answerer=answerer)
    return asset, np.array(json.loads((folder / "T.json").read_text(encoding="utf-8")))


def placement(folder: Path) -> np.ndarray:
    return np.array(json.loads((folder / "asset.json").read_text(encoding="utf-8"))["source"]["T_asset_source"], float)


def matched(
    folder: Path, task: Task, subject: EvalSample, T_true_file: np.ndarray | None = None
) -> tuple[ArticulatedObject, str, np.ndarray]:
    """The twin's joint whose part has most nearly the true part's box, the part's name, and the twin's frame in the true one.

    T_true_file: from the coordinates of the twin's mesh file to the true asset frame; None where the twin was made of the
    very mesh file of the true object.
    """
    T = (subject.T if T_true_file is None else T_true_file) @ np.linalg.inv(placement(folder))
    number = next(k for k, p in enumerate(subject.truth.parts) if p.name == task.part)
    true = subject.mesh.triangles[subject.labels == number].reshape(-1, 3)
    corners = np.stack([true.min(0), true.max(0)])
    record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
    names = [j["name"] for j in record["joints"] if j["type"] != "fixed"]
    things = [open_object(folder, n) for n in names]

    def off(thing: ArticulatedObject) -> float:
        own = thing.part_triangles.reshape(-1, 3) @ T[:3, :3].T + T[:3, 3]
        return float(np.linalg.norm(np.stack([own.min(0), own.max(0)]) - corners))

    best = min(things, key=off)
    return best, best.part, T


def twin_value(task: Task, subject: EvalSample, thing: ArticulatedObject, T: np.ndarray) -> float:
    """The same motion in the twin's numbers: a person sees which way is meant, so the sign is that of its axis."""
    true = subject.joint(next(j for j in subject.truth.joints if j.child == task.part))
    return task.value * float(np.sign((T[:3, :3] @ thing.motion.axis) @ true.axis))


def moved_base(base: BasePose, T: np.ndarray) -> BasePose:
    """A base in the true object's frame."""
    x, y, z = T[:3, :3] @ [base.x, base.y, base.z] + T[:3, 3]
    return BasePose(float(x), float(y), float(z), base.yaw + float(np.arctan2(T[1, 0], T[0, 0])))


@dataclass(frozen=True, eq=False)
class Row:
    """A line of the table. value: of the true joint, as planned [rad or m]."""

    task: str
    twin: str
    value: float
    seconds: float
    done: int
    trials: int
    failures: Counter[str]
    plan: MotionPlan | None = None
    note: str = ""


def run(
    task: Task, kind: str, twin_of: tuple[Path, np.ndarray | None], subject: EvalSample, true: Path, arm: Arm, trials: range
) -> tuple[Row, ArticulatedObject, np.ndarray]:
    """One line of the table. twin_of: the twin's folder, and `T_true_file` of `matched`; trials: seeds of the perturbations."""
    thing, _, T = matched(twin_of[0], task, subject, twin_of[1])
    real = open_object(true, f"{task.part}_joint")
    begin = time.perf_counter()
    try:
        found, value = nearest_plan(thing, arm, twin_value(task, subject, thing, T))
    except PlanError as error:
        return no_plan(task, kind, len(trials), time.perf_counter() - begin, error), real, T
    took = time.perf_counter() - begin
    base, failures, value = moved_base(found.base, T), Counter[str](), float(np.copysign(value, task.value))
    for trial in trials:
        physics = perturbed(np.random.default_rng([trial, len(task.name)]), task.spring)
        seen = replay(found.trajectory, real, arm.robot, arm.hand, base, value, physics=physics)
        if seen.failure is not None:
            failures[seen.failure.value] += 1
    return Row(task.name, kind, value, took, len(trials) - failures.total(), len(trials), failures, found), real, T


def no_plan(task: Task, kind: str, trials: int, seconds: float, error: AnymeshError) -> Row:
    return Row(task.name, kind, task.value, seconds, 0, trials, Counter({"no plan": trials}), note=str(error))


def nearest_plan(thing: ArticulatedObject, arm: Arm, value: float) -> tuple[MotionPlan, float]:
    """Return a plan and the value that it brings the joint to: the one asked for, else the nearest that the planner names."""
    try:
        return plan_motion(thing, arm, value, settings=Settings(seconds=30)), value
    except PlanError as error:
        if error.nearest is None or error.nearest / value < MIN_SHARE:
            raise
        return plan_motion(thing, arm, error.nearest, settings=Settings(seconds=30)), error.nearest


def picture(row: Row, real: ArticulatedObject, T: np.ndarray, task: Task, arm: Arm, path: Path) -> None:
    """Frames of the first trial: the whole, and the hand."""
    if row.plan is None:
        return
    physics = perturbed(np.random.default_rng([0, len(task.name)]), task.spring)
    base = moved_base(row.plan.base, T)
    seen = replay(row.plan.trajectory, real, arm.robot, arm.hand, base, row.value, physics=physics, rate=20)
    film = Film(real, arm.robot, arm.hand, base, physics)
    phases = np.array([p.value for p in row.plan.trajectory.phase])
    times = [row.plan.trajectory.time[np.flatnonzero(phases == p.value)[k]] for p, k in (
        (Phase.APPROACH, -1), (Phase.MOVE, 0), (Phase.HOLD, -1))]  # fmt: skip
    move = row.plan.trajectory.time[phases == Phase.MOVE.value]
    times = sorted([*times, move[len(move) // 2]])
    states = seen.states[[min(int(t * 20), len(seen.states) - 1) for t in times]]
    whole, close = film.camera(states), film.camera(states[1:], close=True)
    frames = [film.frame(q, camera) for camera in (whole, close) for q in states]
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(tiled(frames, len(states))).save(path)


def table(rows: list[Row], robot: str) -> str:
    lines = table_head("task, robot, twin, value, planning [s], trajectory [s], successes, failures".split(", "))
    for r in rows:
        times = ("-", "-") if r.plan is None else (f"{r.seconds:.1f}", f"{r.plan.trajectory.duration:.1f}")
        causes = ", ".join(f"{n} {cause}" for cause, n in r.failures.most_common()) or "none"
        lines.append(table_row((r.task, robot, r.twin, said(r), *times, f"**{r.done}/{r.trials}**", causes)))
    return "\n".join(lines)


def said(row: Row) -> str:
    """The planned way, with its unit."""
    return f"{1000 * abs(row.value):.0f} mm" if row.task == "trigger" else f"{np.rad2deg(abs(row.value)):.0f} deg"


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path)
    parser.add_argument("--robot", default="panda")
    parser.add_argument("--trials", type=int, default=50)
    parser.add_argument("--first-trial", type=int, default=0, help="other numbers give other perturbations")
    parser.add_argument("--tasks", default=",".join(TASKS))
    parser.add_argument("--twins", default=",".join(TWINS))
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--markdown", type=Path)
    options = parser.parse_args()
    arm, rows = open_arm(options.robot), []
    trials = range(options.first_trial, options.first_trial + options.trials)
    for name in options.tasks.split(","):
        task = TASKS[name]
        subject = prepared(true_object(task.thing, options.work / "objects"))
        true = true_asset(task, subject, options.work / "true" / task.thing)
        wanted = [k for k in options.twins.split(",") if k not in ("corrected", "answered") or name == "trigger"]
        twins: dict[str, tuple[Path, np.ndarray | None]] = {}
        for kind in wanted:
            if kind in ("scan", "answered"):
                twins[kind] = scanned(subject, task, kind, options.work)
            else:
                twins[kind] = twin(kind, task, subject, options.work), None
        for kind, which in twins.items():
            try:
                row, real, T = run(task, kind, which, subject, true, arm, trials)
            except AnymeshError as error:
                rows.append(no_plan(task, kind, options.trials, 0.0, error))
                continue
            rows.append(row)
            print(f"{name} {kind}: {row.done}/{row.trials} {dict(row.failures)} {row.seconds:.1f} s {row.note}", flush=True)
            if options.pictures:
                picture(row, real, T, task, arm, options.work / "pictures" / f"{options.robot}_{name}_{kind}.png")
    text = table(rows, options.robot)
    print(text)
    if options.markdown:
        options.markdown.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
