"""Measure how joints answer a hand: the pull that starts them, against asset.json and between engines; what they do then.

python -m benchmarks.behaviour WORK [--engine NAME=PYTHON ...] [--resistance LEVEL] [--kind NAME ...]
                                                        writes reports/behaviour.md and WORK/answers.json

Objects of 36 kinds are written from their true parts and joints, so that the question is resistance, not recognition. Each
engine runs in the interpreter that is named for it (it needs numpy, scipy, jaxtyping and pillow); without any, MuJoCo alone.
WORK: a folder for assets and answers. How an engine gets what it does not take from the file: `behaviour_engines.py`.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.checking.engines.robot import read_urdf
from anymesh.evaluation.datasets.urdf_ import flatten_urdf
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.export import Base, ExportOptions, Format, write_asset
from anymesh.export.model import Model
from anymesh.physics.resistance import ResistanceLevel
from anymesh.types import Asset, JointType, Part
from benchmarks import EXAMPLES, REPORTS, ROOT, parser_of, table_head, table_row
from benchmarks.behaviour_engines import starts

EXAMPLE_KINDS = (
    "bucket", "cabinet", "drill", "fridge", "laptop", "microwave", "sliding_window", "storage_box", "stove", "tilted_drawer",
    "tilting_flap", "toaster", "toy_car", "valve",
)  # fmt: skip
OTHER_KINDS = (
    "hinged_door", "garden_gate", "barn_door", "cat_flap", "casement", "awning", "shutters", "roof_hatch",
    "wardrobe", "filing_cabinet", "blanket_box", "safe", "mailbox", "trash_can", "toilet", "washer", "dishwasher",
    "kettle", "switch_panel", "door_lever_set", "parking_barrier", "bread_box",
)  # fmt: skip
SEED = 72
SLOPE_DEG = 30.0
AGREE = 0.1
SWING = 1.0  # in 2 mm at the handle, or .02 rad: a larger swing back and forth after 2 s is an oscillation
HELD = np.deg2rad(2.0)  # motion in 2 s of a lid that holds at 60 degrees, or in the middle of its range
MEASURED = 0.05  # relative: accuracy of the measured pull
FORMATS = (Format.URDF, Format.MJCF, Format.USD)
HEAD = """# How joints answer a hand

`python -m benchmarks.behaviour WORK --engine NAME=PYTHON ...`: {joints} joints of {kinds} objects, one per kind, written
from true parts and joints, so that the question is resistance and not recognition. A constant force pulls at the handle
stated in `asset.json`, in the stated direction, from rest under gravity, other joints held; halving between pulls gives
the one at which the handle begins to move (2 mm within 1 s, or .02 rad where a torque is stated), read from positions.
Then the ground slopes by one degree in four directions for 4 s; each joint is pushed open with 1.5 times its `most` and
let go, and 2 s later watched for 1 s; lids that are said to hold are let go at 60 degrees, or in the middle of a shorter
range; a toy car with a free base rolls down a plane of 30 degrees, beside the same without dry friction. Each engine
reads the file that its users read; the head of `benchmarks/behaviour_engines.py` and
[engines.md](../../docs/engines.md#resistance-of-joints) state what is set by hand.
"""
TABLE = """Each joint, in N at the handle or N m about the axis. **Bold**: outside the stated bounds (5 % is the accuracy of the
measurement); <, >: less or more than what was tried; -: not measured. Tilt and swing: largest motion of the handle of all
engines, in units of 2 mm or .02 rad."""
Answers = dict[str, dict[str, Any]]


def truths(work: Path, kinds: Sequence[str]) -> Iterator[tuple[str, GroundTruth]]:
    """Yield the ground truth of one object per kind, with part labels."""
    from training.kinds import registry

    examples = {truth.name: truth for truth in example_truths(EXAMPLES)}
    for kind in kinds:
        if kind in examples:
            yield kind, examples[kind]
            continue
        urdf = registry.write(kind, SEED, 0, work / "kinds")
        labels = {link.name: re.sub(r"[_\d]+$", "", link.name) for link in read_urdf(urdf).links}
        yield kind, replace(flatten_urdf(urdf, work / "kinds" / f"{kind}.glb", labels=labels, category=kind), name=kind)


def asset_of(truth: GroundTruth) -> Asset:
    """Return the truth as an asset whose parts have their labels."""
    asset = prepared(truth).asset()
    parts = tuple(Part(p.name, p.label if k else "base") for k, p in enumerate(truth.parts))
    return replace(asset, name=truth.name, segmentation=replace(asset.segmentation, parts=parts))


def written(work: Path, kinds: Sequence[str], level: str) -> list[dict[str, Any]]:
    """Write the assets; return the jobs of the engines."""
    jobs = []
    for kind, truth in truths(work, kinds):
        folder = work / "assets" / kind
        folder.mkdir(parents=True, exist_ok=True)
        write_asset(
            asset_of(truth), folder, ExportOptions(formats=FORMATS, resistance=ResistanceLevel(level)), cache=work / "shapes"
        )
        record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
        sweep = sweep_joints(folder / f"{record['name']}.urdf", steps=40)
        opened = {j.name: list(j.opened) for j in sweep.joints}
        joints = [j | {"opened": opened[j["name"]]} for j in record["joints"] if j["type"] != "fixed"]
        jobs.append({"name": kind, "folder": str(folder), "joints": joints})
    return jobs


def car(work: Path) -> dict[str, Any]:
    """Write the toy car with a free base; return its job, with how far it would roll without friction [m]."""
    truth = next(t for t in example_truths(EXAMPLES) if t.name == "toy_car")
    asset = asset_of(truth)
    folder = work / "assets" / "rolling_car"
    folder.mkdir(parents=True, exist_ok=True)
    model = write_asset(asset, folder, ExportOptions(Base.FREE, FORMATS), cache=work / "shapes")
    down, free = free_roll(asset, model)
    ground = float(asset.mesh.vertices[:, 2].min())
    return {"name": "rolling_car", "folder": str(folder), "down": down.tolist(), "ground": ground, "free": free}


def free_roll(asset: Asset, model: Model) -> tuple[np.ndarray, float]:
    """Return the direction in which a car rolls, and how far without friction in 2 s on a slope of SLOPE_DEG [m]."""
    wheels = [j for j in asset.joints if j.type is JointType.CONTINUOUS and re.fullmatch(r"wheel_\d", j.child)]
    bodies = {body.name: body.inertia for body in model.bodies}
    mass, ground = sum(body.mass for body in bodies.values()), float(asset.mesh.vertices[:, 2].min())
    spun = sum(float(w.axis @ bodies[w.child].tensor @ w.axis) / (w.origin[2] - ground) ** 2 for w in wheels)
    free = 0.5 * 9.81 * np.sin(np.deg2rad(SLOPE_DEG)) * 2.0**2 * mass / (mass + spun)
    return np.cross(wheels[0].axis, (0, 0, 1)), float(free)


def ask(work: Path, engine: str, python: str, jobs: Sequence[Mapping[str, Any]]) -> Answers:
    """Run an engine on all jobs in a process of its own."""
    file, answer = work / "jobs.json", work / f"{engine}.json"
    file.write_text(json.dumps(list(jobs)), encoding="utf-8")
    command = [python, str(Path(__file__).with_name("behaviour_engines.py")), engine, str(file), str(answer)]
    subprocess.run(command, env={**os.environ, "PYTHONPATH": str(ROOT / "src")}, check=True)
    return json.loads(answer.read_text(encoding="utf-8"))


def cell(pull: Mapping[str, float], got: Mapping[str, Any] | None) -> str:
    """Return what an engine measured; in bold outside the stated bounds."""
    if got is None:
        return "-"
    shown = f"{'<' if got['bound'] == 'below' else '>' if got['bound'] == 'above' else ''}{got['begins']:.3g}"
    return shown if inside(pull, got) else f"**{shown}**"


def inside(pull: Mapping[str, float], got: Mapping[str, Any]) -> bool:
    """Return whether a joint begins to move between its stated bounds; MEASURED is the accuracy of the measurement."""
    low, high = (float(pull[end]) for end in ("least", "most"))
    return not got["bound"] and low * (1 - MEASURED) <= got["begins"] <= high * (1 + MEASURED)


def agree(values: Sequence[Mapping[str, Any]]) -> bool:
    """Return whether engines agree on a joint within AGREE."""
    numbers = [v["begins"] for v in values if not v["bound"]]
    return len(numbers) == len(values) > 1 and max(numbers) <= (1 + AGREE) * min(numbers)


def rows(jobs: Sequence[Mapping[str, Any]], answers: Answers) -> Iterator[tuple[str, dict[str, Any], dict[str, Any]]]:
    """Yield each joint: the object, its record, and what each engine measured, with its tilt."""
    for job in (j for j in jobs if "down" not in j):
        some = {engine: a[job["name"]] for engine, a in answers.items() if "error" not in a.get(job["name"], {"error": ""})}
        for joint in job["joints"]:
            name = joint["name"]
            yield (
                job["name"],
                joint,
                {engine: a[name] | ({"tilt": a["tilted"][name]} if "tilted" in a else {}) for engine, a in some.items()},
            )


def stays(joint: Mapping[str, Any]) -> bool:
    """Return whether a joint is one that should stay closed on a slope: it has limits, and does not open by itself."""
    return joint["limits"] is not None and starts(joint)["typical"] > 0


def report(jobs: Sequence[Mapping[str, Any]], answers: Answers) -> str:
    """Return the page: the figures of each engine, their agreement, and each joint."""
    table = list(rows(jobs, answers))
    lines = [*HEAD.format(kinds=len({kind for kind, _, _ in table}), joints=len(table)).splitlines(), ""]
    titles = ("engine", "measured", "between least and most", "within 10 % of typical", "closed at 1 degree")
    lines += table_head((*titles, "lids that hold", "swings 2 s after a push", "toy car in 2 s, and without friction"))
    rolled = next((j for j in jobs if "down" in j), None)
    for engine, answer in answers.items():
        own = [(joint, got[engine]) for _, joint, got in table if engine in got]
        near = sum(not g["bound"] and abs(g["begins"] - starts(j)["typical"]) <= AGREE * starts(j)["typical"] for j, g in own)
        closed = [g["tilt"] <= 1 for j, g in own if stays(j) and "tilt" in g]
        holds = [
            abs(g["holds"]) <= HELD
            for j, g in own
            if j.get("mechanism", {}).get("kind") == "hold" and g.get("holds") is not None
        ]
        swings = [g["swing"] > SWING for _, g in own if "swing" in g]
        car_ = answer.get(rolled["name"], {}) if rolled else {}
        rolls = f"{car_['rolled']:.2f} m, {car_['loose']:.2f} m" if "rolled" in car_ else "-"
        good = sum(inside(starts(j), g) for j, g in own)
        shares = (f"{sum(some)} of {len(some)}" if some else "-" for some in (closed, holds, swings))
        lines.append(table_row((answer["version"], len(own), good, near, *shares, rolls)))
    several = [list(got.values()) for _, _, got in table if len(got) > 1]
    whole = sum(len(some) == len(answers) for some in several)
    lines += [
        "",
        f"Engines agree within 10 % on {sum(map(agree, several))} of {len(several)} joints; all measured {whole} of them.",
        "",
    ]
    lines += [TABLE, ""]
    lines += table_head(("object", "joint", "kind", "unit", "least", "typical", "most", *answers, "agree", "tilt", "swing"))
    for kind, joint, got in table:
        pull = starts(joint)
        stated = (f"{pull[word]:.3g}" for word in ("least", "typical", "most"))
        worst = [max((abs(g[word]) for g in got.values() if word in g), default=0.0) for word in ("tilt", "swing")]
        cells = (cell(pull, got.get(engine)) for engine in answers)
        yes = "yes" if agree(list(got.values())) else "no"
        what = [joint["resistance"].split(":")[0], *([joint["mechanism"]["kind"]] if "mechanism" in joint else [])]
        named = (kind, joint["child"], ", ".join(what), joint["pull"]["unit"])
        lines.append(table_row((*named, *stated, *cells, yes, *(f"{w:.1f}" for w in worst))))
    if rolled is not None:
        lines += ["", f"By hand, without friction and on round wheels, the car rolls {rolled['free']:.2f} m."]
    failed = [
        f"- {job['name']} in {engine}: {answer[job['name']]['error']}"
        for job in jobs
        for engine, answer in answers.items()
        if "error" in answer.get(job["name"], {})
    ]
    return "\n".join([*lines, *(["", "Not measured:", "", *failed] if failed else [])]) + "\n"


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path)
    parser.add_argument("--engine", action="append", default=[], metavar="NAME=PYTHON")
    parser.add_argument("--resistance", default="typical", choices=("light", "typical", "stiff"))
    parser.add_argument("--kind", action="append", help="only these")
    options = parser.parse_args()
    work = options.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    jobs = written(work, options.kind or (*EXAMPLE_KINDS, *OTHER_KINDS), options.resistance)
    jobs += [car(work)] if options.kind is None else []
    pythons = dict(pair.split("=", 1) for pair in options.engine) or {"mujoco": sys.executable}
    answers = {engine: ask(work, engine, python, jobs) for engine, python in pythons.items()}
    (work / "answers.json").write_text(json.dumps({"jobs": jobs, "answers": answers}), encoding="utf-8")
    if options.kind is None:
        (REPORTS / "behaviour.md").write_text(report(jobs, answers), encoding="utf-8")


if __name__ == "__main__":
    main()
