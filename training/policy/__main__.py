"""The paper's table 2: policies fine-tuned on plain objects, or on these and objects that went through the pipeline.

    python -m training.policy WORK [--size cpu|gpu|smoke] [--seeds 5] [--things laptop,bucket] [--until HH:MM]
                                [--true-joints] [--report-only]

Plain objects have exact joints and stand for PartNet-Mobility. The others are designs (objects.py) written as one mesh
without names, which `anymesh annotate` turns into assets. One policy per thing is trained on plain objects; from it, with equal
steps, `baseline` goes on with plain objects, `augmented` with both. Every policy is evaluated without exploration on held-out
plain objects and held-out assets, each from 100 random poses. Everything finished is kept: the same command resumes.

--until stops before a training that would begin later than that time (UTC). --true-joints also evaluates on the held-out
designs with their true joints in place of the found ones.
"""

from __future__ import annotations

import argparse
import datetime
import json
import subprocess
import sys
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from anymesh.applications.policy.objects_ import find_assets, task_object
from anymesh.applications.policy.tasks import PolicyTask
from anymesh.applications.policy.training_ import SETTINGS, Episode, evaluate_policy, train
from anymesh.errors import AnymeshError
from anymesh.evaluation.ground_truth import GroundTruth, prepared
from anymesh.export import write_asset
from training.policy.objects import write_object
from training.policy.report import TEST_SEED, write_report

TASKS = {"laptop": PolicyTask.OPEN, "bucket": PolicyTask.LIFT}
ARMS = ("baseline", "augmented")


@dataclass(frozen=True)
class Size:
    """How much is trained. plain, designed: objects for training; held_out: of each; steps by thing: pretraining, tuning."""

    plain: int
    designed: int
    held_out: int
    episodes: int
    pretraining: dict[str, int]
    tuning: dict[str, int]


SIZES = {
    "cpu": Size(8, 11, 4, 100, {"laptop": 80_000, "bucket": 1_000_000}, {"laptop": 80_000, "bucket": 100_000}),
    "gpu": Size(40, 60, 15, 100, {"laptop": 5_000_000, "bucket": 10_000_000}, {"laptop": 2_000_000, "bucket": 4_000_000}),
    "smoke": Size(2, 1, 1, 2, {"laptop": 128, "bucket": 128}, {"laptop": 64, "bucket": 64}),
}
MORE = 1.4  # designs made per asset that is needed; some cannot be used


@dataclass(frozen=True)
class Sets:
    """Assets by use; refused: designs whose asset does not fit the task, with the reason; truths: of the designs."""

    train_plain: list[Path]
    train_designed: list[Path]
    test_plain: list[Path]
    test_designed: list[Path]
    test_true: list[Path]
    refused: dict[str, str]
    truths: dict[str, GroundTruth]


def exact_asset(truth: GroundTruth, folder: Path) -> Path:
    """The asset of an object with its true parts and joints."""
    if not (folder / "asset.json").exists():
        sample = prepared(truth)
        asset = sample.asset()
        folder.mkdir(parents=True, exist_ok=True)
        write_asset(replace(asset, source=replace(asset.source, T_asset_source=sample.T)), folder)
    return folder


def prepare(thing: str, size: Size, work: Path) -> Sets:
    """Write the objects, annotate the designs, and divide them by number: first those for training, then the held-out ones."""
    count = size.plain + size.held_out
    plain = [write_object(thing, "plain", k, work / "objects" / f"{thing}_plain") for k in range(count)]
    exact = [exact_asset(t, work / f"plain_{thing}" / t.name) for t in plain]
    wanted = size.designed + size.held_out
    meshes = work / "objects" / f"{thing}_designed"
    truths = {t.name: t for t in (write_object(thing, "designed", k, meshes) for k in range(round(MORE * wanted) or 1))}
    annotated = work / f"annotated_{thing}"
    if not annotated.exists() or len(_assets(annotated)) < len(truths):
        command = [sys.executable, "-c", "from anymesh.cli import main; main()", "annotate", meshes, "-o", annotated]
        subprocess.run([*map(str, command), "--workers", "1", "--quiet"], check=False)  # the report below lists failed objects
    usable, refused = [], dict.fromkeys(truths, "no asset")
    for name, path in sorted(_assets(annotated).items()):
        refused.pop(name, None)
        reason = unfit(path, TASKS[thing])
        if reason:
            refused[name] = reason
        else:
            usable.append(path)
    tested = usable[size.designed : size.designed + size.held_out]
    true = [exact_asset(truths[_name(p)], work / f"true_{thing}" / _name(p)) for p in tested]
    return Sets(exact[: size.plain], usable[: size.designed], exact[size.plain :], tested, true, refused, truths)


def _name(asset: Path) -> str:
    return str(json.loads((asset / "asset.json").read_text(encoding="utf-8"))["name"])


def _assets(folder: Path) -> dict[str, Path]:
    return {_name(p): p for p in find_assets(folder)}


def unfit(asset: Path, task: PolicyTask) -> str:
    """Why an asset cannot be used, found without knowing its true joints; "" where it can."""
    try:
        found = task_object(asset, task)
    except AnymeshError as error:
        return str(error)
    return "" if found.thing.turns else f"its part slides ({found.thing.joint})"


def evaluated(policy: Path, assets: list[Path], name: str, task: str, size: Size, settings_name: str) -> list[Episode]:
    """Evaluate a policy once; the episodes are kept beside it."""
    path = policy.parent / f"{name}.json"
    if not path.is_file():
        episodes = evaluate_policy(
            policy, assets, task, episodes=size.episodes, seed=TEST_SEED, settings=SETTINGS[settings_name]
        )
        path.write_text(json.dumps([asdict(e) for e in episodes]), encoding="utf-8")
    return [Episode(**row) for row in json.loads(path.read_text(encoding="utf-8"))]


def run_seed(thing: str, sets: Sets, seed: int, size: Size, options: argparse.Namespace) -> None:
    """Fine-tune both arms from the shared policy, and evaluate them."""
    settings, task, runs = SETTINGS[options.size], TASKS[thing], options.work / "runs" / thing
    shared = train(
        sets.train_plain, task, runs / "pretrained", steps=size.pretraining[thing], settings=settings, progress=_tell
    )
    for arm in ARMS:
        assets = sets.train_plain + (sets.train_designed if arm == "augmented" else [])
        out = runs / f"{arm}_{seed}"
        policy = train(
            assets, task, out, steps=size.tuning[thing], seed=1000 + seed, start=shared, settings=settings, progress=_tell
        )
        tests = {"plain": sets.test_plain, "designed": sets.test_designed}
        if options.true_joints:
            tests["true"] = sets.test_true
        for name, tested in tests.items():
            found = evaluated(policy, tested, name, task, size, options.size)
            print(f"{thing} {arm} {seed} on {name}: {sum(e.success for e in found) / len(found):.3f}", flush=True)


def _tell(_stage: str, text: str, done: int, total: int) -> None:
    if done % 10_240 < 2_048 or done == total:
        print(f"{_clock()} {text} {done}/{total}", flush=True)


def _clock() -> str:
    return datetime.datetime.now(datetime.UTC).strftime("%H:%M")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=Path)
    parser.add_argument("--size", choices=tuple(SIZES), default="cpu")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--things", default=",".join(TASKS))
    parser.add_argument("--until", metavar="HH:MM")
    parser.add_argument("--true-joints", action="store_true")
    parser.add_argument("--report-only", action="store_true")
    options = parser.parse_args()
    size, things = SIZES[options.size], options.things.split(",")
    sets = {thing: prepare(thing, size, options.work) for thing in things}
    for thing in things:
        s = sets[thing]
        print(f"{thing}: {len(s.train_plain)} plain and {len(s.train_designed)} designed for training, {len(s.test_plain)} and "
              f"{len(s.test_designed)} held out, refused: {s.refused}", flush=True)  # fmt: skip
    for seed in range(0 if options.report_only else options.seeds):
        for thing in things:
            if options.until and _clock() >= options.until:
                print(f"stopped before seed {seed} of {thing}")
                break
            run_seed(thing, sets[thing], seed, size, options)
    write_report(options.work, sets, TASKS, options.seeds)


if __name__ == "__main__":
    main()
