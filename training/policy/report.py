"""Report of `python -m training.policy`: success rates with a paired test, curves, failures, errors of the joints."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from anymesh.applications.plan.film_ import tiled
from anymesh.applications.policy.tasks import DEXART, Randomization
from anymesh.applications.policy.training_ import Episode, read_curve
from anymesh.evaluation.ground_truth import prepared
from anymesh.evaluation.report import COLORS
from training.policy.statistics import interval, paired_p

TEST_SEED = 7_000_000  # of the starts of evaluated episodes; trainings draw theirs from 0 up
PAPER = {"laptop": (0.408, 0.513), "bucket": (0.339, 0.479)}
TESTS = {"plain": "held-out plain", "designed": "held-out assets", "all": "both", "true": "held-out designs, true joints"}
WIDTH, HEIGHT, MARGIN = 460, 260, 46


def episodes_of(run: Path, name: str) -> list[Episode] | None:
    """The evaluated episodes of a run on a test set, None where it was not evaluated."""
    if name == "all":
        parts = [episodes_of(run, part) for part in ("plain", "designed")]
        return None if None in parts else [e for part in parts for e in part or ()]
    path = run / f"{name}.json"
    return [Episode(**row) for row in json.loads(path.read_text(encoding="utf-8"))] if path.is_file() else None


def rates(runs: Path, arm: str, name: str, seeds: int) -> dict[int, float]:
    """Success rate of every evaluated seed below `seeds`: the mean over objects and poses."""
    found = {}
    for seed in range(seeds):
        episodes = episodes_of(runs / f"{arm}_{seed}", name)
        if episodes is not None:
            found[seed] = float(np.mean([e.success for e in episodes]))
    return found


def table(work: Path, things: Sequence[str], seeds: int) -> list[str]:
    lines = [
        "| task | test set | baseline | augmented | seeds | p | paper |",
        "|---|---|---|---|---|---|---|",
    ]
    for thing in things:
        for name, title in TESTS.items():
            base, more = (rates(work / "runs" / thing, arm, name, seeds) for arm in ("baseline", "augmented"))
            both = sorted(base.keys() & more.keys())
            if not both:
                continue
            first, second = [base[s] for s in both], [more[s] for s in both]
            paper = f"{PAPER[thing][0]:.3f} to {PAPER[thing][1]:.3f}" if name == "all" else ""
            p = paired_p(first, second)
            lines.append(f"| {thing} | {title} | {interval(first)} | {interval(second)} | {len(both)} | {p:.3g} | {paper} |")
    return lines


def by_object(work: Path, thing: str, seeds: int) -> list[tuple[str, float, float]]:
    """Each held-out object with its mean success over seeds, of both arms."""
    found = {}
    for arm in ("baseline", "augmented"):
        for seed in range(seeds):
            for e in episodes_of(work / "runs" / thing / f"{arm}_{seed}", "all") or ():
                found.setdefault(e.asset, {}).setdefault(arm, []).append(e.success)
    return [(k, *(float(np.mean(v.get(a, [0]))) for a in ("baseline", "augmented"))) for k, v in sorted(found.items())]


def joint_errors(assets: Sequence[Path], truths: Mapping[str, Any], task: Any) -> dict[str, tuple[float, float, str]]:
    """Angle between the axes whatever their sign [deg], their distance at the part [share of the diagonal], and the sign."""
    from anymesh.applications.policy.objects_ import task_object

    found = {}
    for path in assets:
        name = json.loads((path / "asset.json").read_text(encoding="utf-8"))["name"]
        sample, thing = prepared(truths[name]), task_object(path, task).thing
        true = sample.joint(sample.truth.joints[0])
        cosine = float(np.clip(thing.motion.axis @ true.axis, -1, 1))
        center = sample.mesh.triangles[sample.labels == 1].reshape(-1, 3).mean(0)
        feet = [o + ((center - o) @ a) * a for o, a in ((thing.motion.origin, thing.motion.axis), (true.origin, true.axis))]
        distance = float(np.linalg.norm(feet[0] - feet[1])) / sample.mesh.diagonal
        found[name] = float(np.rad2deg(np.arccos(abs(cosine)))), distance, "right" if cosine > 0 else "reversed"
    return found


def curve_svg(work: Path, thing: str) -> str:
    """Success in training against steps: the mean of the seeds as a line, each seed thinly."""
    runs = work / "runs" / thing
    before = read_curve(runs / "pretrained")
    offset = before[-1]["steps"] if before else 0.0
    groups = {"pretrained": [before]}
    for arm in ("baseline", "augmented"):
        groups[arm] = [read_curve(run) for run in sorted(runs.glob(f"{arm}_*")) if read_curve(run)]
    last = max([offset, *(offset + c[-1]["steps"] for arm in ("baseline", "augmented") for c in groups[arm])]) or 1.0

    def line(curve: Sequence[Mapping[str, float]], begin: float, style: str) -> str:
        points = " ".join(
            f"{MARGIN + (WIDTH - MARGIN - 10) * (begin + r['steps']) / last:.1f},"
            f"{10 + (HEIGHT - MARGIN - 10) * (1 - r['success']):.1f}"
            for r in curve
        )
        return f'<polyline fill="none" points="{points}" {style}/>'

    lines = []
    for color, (name, curves) in zip(COLORS[2::-1], groups.items(), strict=False):
        begin = 0.0 if name == "pretrained" else offset
        lines += [line(c, begin, f'stroke="{color}" stroke-opacity="0.35"') for c in curves]
        count = min((len(c) for c in curves), default=0)
        mean = [{k: float(np.mean([c[i][k] for c in curves])) for k in ("steps", "success")} for i in range(count)]
        lines.append(line(mean, begin, f'stroke="{color}" stroke-width="2"'))
        lines.append(f'<text x="{MARGIN + 10 + 110 * len(lines) % 330}" y="{HEIGHT - 6}" fill="{color}">{name}</text>')
    lines += [
        f'<text x="{MARGIN - 6}" y="{14 + (HEIGHT - MARGIN - 10) * (1 - v):.0f}" text-anchor="end">{v:g}</text>'
        f'<line x1="{MARGIN}" x2="{WIDTH - 10}" y1="{10 + (HEIGHT - MARGIN - 10) * (1 - v):.1f}" '
        f'y2="{10 + (HEIGHT - MARGIN - 10) * (1 - v):.1f}" stroke="#ddd"/>'
        for v in (0, 0.5, 1)
    ]
    lines += [
        f'<text x="{MARGIN + (WIDTH - MARGIN - 10) * k / 2:.0f}" y="{HEIGHT - MARGIN + 16}" text-anchor="middle">'
        f"{last * k / 2000:.0f}k</text>"
        for k in range(3)
    ]
    style = 'font-family="sans-serif" font-size="11" fill="#333"'
    body = "".join(lines)
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" {style}><rect width="100%" height="100%" fill="#fff"/>{body}</svg>'  # noqa: E501


def failures(work: Path, thing: str, assets: Sequence[Path], task: str, path: Path, count: int = 6) -> None:
    """A contact sheet: the end of the first failing episode of seed 0 of `augmented` on the objects that fail most."""
    from stable_baselines3 import PPO

    from anymesh.applications.policy.env_ import make_env

    run = work / "runs" / thing / "augmented_0"
    episodes = episodes_of(run, "all")
    if not episodes:
        return
    config = json.loads((run / "training.json").read_text(encoding="utf-8"))
    env = make_env(
        [str(a) for a in assets], task, robot=config["robot"], observation=config["observation"],
        randomization=DEXART[task] if config["dexart_poses"] else Randomization(), render_mode="rgb_array",
    )  # fmt: skip
    names = [s.object.name for s in env.simulations]
    failed = {n: [e for e in episodes if e.asset == n and not e.success] for n in names}
    model, frames = PPO.load(run / "policy.zip", device="cpu"), []
    for name in sorted(names, key=lambda n: -len(failed[n]))[:count]:
        if not failed[name]:
            continue
        asset, number = names.index(name), failed[name][0].number
        place = [a for a in names if ("designed" in a) == ("designed" in name)].index(name)  # its number in its own test set
        seen, _ = env.reset(seed=TEST_SEED + 100_003 * place + number, options={"asset": asset})
        done = False
        while not done:
            seen, _, ended, truncated, info = env.step(model.predict(seen, deterministic=True)[0])
            done = ended or truncated
        picture = Image.fromarray(env.render())
        ImageDraw.Draw(picture).text(
            (6, 4), f"{name}: {len(failed[name])} failed, progress {info['progress']:.2f}", fill=(0, 0, 0)
        )
        frames.append(np.asarray(picture))
    if frames:
        Image.fromarray(tiled(frames, min(3, len(frames)))).save(path)


def write_report(work: Path, sets: Mapping[str, Any], tasks: Mapping[str, Any], seeds: int) -> None:
    """Write WORK/report.md, curves and contact sheets."""
    lines = ["Success rates with 95 % intervals over seeds; p of the paired t test.", "", *table(work, list(sets), seeds), ""]
    for thing, s in sets.items():
        lines += [f"## {thing}", "", "| held-out object | baseline | augmented |", "|---|---|---|"]
        lines += [f"| {name} | {base:.2f} | {more:.2f} |" for name, base, more in by_object(work, thing, seeds)]
        lines += ["", "| asset | angle of the axis [deg] | distance [diagonal] | sign |", "|---|---|---|---|"]
        errors = joint_errors([*s.train_designed, *s.test_designed], s.truths, tasks[thing])
        lines += [f"| {n} | {a:.1f} | {d:.3f} | {sign} |" for n, (a, d, sign) in sorted(errors.items())]
        lines += ["", *(f"- not used: {n}: {why}" for n, why in sorted(s.refused.items())), ""]
        (work / f"curve_{thing}.svg").write_text(curve_svg(work, thing), encoding="utf-8")
        failures(work, thing, [*s.test_plain, *s.test_designed], tasks[thing], work / f"failures_{thing}.png")
    (work / "report.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))
