"""Interaction protocol: a scripted gripper moves every joint of a set of assets, reported beside executability."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from anymesh import __version__
from anymesh.applications.plan.film_ import tiled
from anymesh.applications.policy.controller_ import TRIES, Attempt, move_joint
from anymesh.applications.policy.objects_ import find_assets, moving_joints, object_at_rest
from anymesh.applications.policy.simulation_ import ScenePicture
from anymesh.checking.engines.locate import find_description
from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.errors import AnymeshError, OptionError
from anymesh.evaluation.record import OBJECTS, ResultsFolder
from anymesh.names import legal_name, legal_names, listed
from anymesh.runtime import Progress, silent, write_whole

PROTOCOL = "interaction"
REPORT, PICTURES, SHEET = "report.md", "pictures", "failures.png"
SHEET_COLUMNS, SHEET_MOST = 4, 16  # of the contact sheet


@dataclass(frozen=True)
class JointInteraction:
    """Result for one joint.

    kind: hinge or slide, "" if the asset could not be read; goal: motion from rest [rad or m]; share: of it that was made;
    reason: why not, "" on success; contact: grasp or push; tries: attempts; faults: of executability.
    """

    asset: str
    joint: str
    kind: str
    goal: float
    share: float
    success: bool
    reason: str
    contact: str
    tries: int
    faults: tuple[str, ...]

    @property
    def executable(self) -> bool:
        """Whether the joint moves through its range in the simulator, driven by a motor."""
        return not self.faults


def evaluate_interaction(
    assets: str | Path,
    out: str | Path,
    *,
    only: Sequence[str] = (),
    seed: int = 0,
    tries: int = TRIES,
    force: bool = False,
    progress: Progress = silent,
) -> list[JointInteraction]:
    """Move every joint of each asset with the scripted gripper, and write the report to `out`; resume a stopped evaluation.

    assets: an asset, or a folder of several; only: names of assets, the names of their folders or files.
    Raise InputError if there is no asset, OptionError for unknown names, OutputError if `out` holds something else.
    """
    paths = find_assets(assets)
    asset_paths = dict(zip(legal_names([p.stem if p.is_file() else p.name for p in paths]), paths, strict=True))
    unknown = sorted(set(only) - set(asset_paths))
    if unknown:
        raise OptionError(f"--only: found {listed(unknown)}; valid are {listed(sorted(asset_paths))}")
    names = [n for n in sorted(asset_paths) if not only or n in only]
    settings = {"assets": str(assets), "protocol": PROTOCOL, "seed": str(seed), "tries": str(tries), "anymesh": __version__}
    results = ResultsFolder.open(Path(out), settings | {"only": ", ".join(sorted(only))}, force=force)
    rows: list[JointInteraction] = []
    for number, name in enumerate(names):
        progress("interaction", name, number, len(names))
        path = results.folder / OBJECTS / f"{name}.json"
        if not path.is_file():
            made = _evaluated(name, asset_paths[name], results.folder, seed, tries)
            write_whole(path, json.dumps([asdict(row) for row in made], indent=1).encode())
        rows += [_row(record) for record in json.loads(path.read_text(encoding="utf-8"))]
    write_whole(results.folder / REPORT, report_text(rows, settings).encode())
    _write_sheet(results.folder)
    return rows


def _row(record: dict[str, Any]) -> JointInteraction:
    values: dict[str, Any] = {**record, "faults": tuple(record["faults"])}
    return JointInteraction(**values)


def _evaluated(name: str, asset: Path, folder: Path, seed: int, tries: int) -> list[JointInteraction]:
    """Return a row per joint; an asset that cannot be read is one failed row."""
    try:
        joints = moving_joints(asset)
        swept = {j.name: j.faults for j in sweep_joints(find_description(asset)).joints}
    except AnymeshError as error:
        return [JointInteraction(name, "", "", 0.0, 0.0, False, str(error), "", 0, (str(error),))]
    return [_interaction(name, asset, joint, swept.get(joint, ()), folder, seed, tries) for joint in joints]


def _interaction(
    name: str, asset: Path, joint: str, faults: tuple[str, ...], folder: Path, seed: int, tries: int
) -> JointInteraction:
    try:
        object_ = object_at_rest(asset, joint)
    except AnymeshError as error:
        return JointInteraction(name, joint, "", 0.0, 0.0, False, str(error), "", 0, faults)
    made = move_joint(object_, seed=seed, tries=tries)
    if made.failure is not None and made.simulation is not None:
        _draw(made, name, joint, folder)
    reason = "" if made.failure is None else made.failure.value
    contact = "" if made.contact is None else made.contact.value
    kind = "hinge" if object_.thing.turns else "slide"
    return JointInteraction(
        name, joint, kind, object_.goal.goal, round(made.share, 4), made.failure is None, reason, contact, made.tries, faults
    )


def _draw(made: Attempt, name: str, joint: str, folder: Path) -> None:
    """Draw the end of the best failed attempt."""
    if made.simulation is None:
        return
    picture = Image.fromarray(ScenePicture(made.simulation).frame())
    ImageDraw.Draw(picture).text((6, 4), f"{name}, {joint}: {100 * made.share:.0f} %", fill=(0, 0, 0))
    (folder / PICTURES).mkdir(exist_ok=True)
    picture.save(folder / PICTURES / f"{legal_name(name)}-{legal_name(joint)}.png")


def _write_sheet(folder: Path) -> None:
    files = sorted((folder / PICTURES).glob("*.png"))[:SHEET_MOST]
    if files:
        frames = [np.asarray(Image.open(f).convert("RGB")) for f in files]
        Image.fromarray(tiled(frames, min(SHEET_COLUMNS, len(frames)))).save(folder / SHEET)


def summary(rows: Sequence[JointInteraction]) -> dict[str, dict[str, float]]:
    """Return per kind of joint, and for all: joints, and the shares that interact, are executable, and are both."""
    groups = {"all": list(rows)} | {k: [r for r in rows if r.kind == k] for k in ("hinge", "slide")}
    return {
        name: {
            "joints": float(len(some)),
            "interaction": sum(r.success for r in some) / len(some),
            "executable": sum(r.executable for r in some) / len(some),
            "both": sum(r.success and r.executable for r in some) / len(some),
        }
        for name, some in groups.items()
        if some
    }


def report_text(rows: Sequence[JointInteraction], settings: dict[str, str]) -> str:
    """Return the report as Markdown: shares, and a line per joint."""
    lines = ["# Interaction", "", *(f"- {k}: {v}" for k, v in settings.items()), ""]
    lines += ["| joints | count | interaction | executable | both |", "|---|---|---|---|---|"]
    for name, s in summary(rows).items():
        shares = " | ".join(f"{s[k]:.3f}" for k in ("interaction", "executable", "both"))
        lines.append(f"| {name} | {s['joints']:.0f} | {shares} |")
    lines += [
        "",
        "| asset | joint | goal | made | contact | tries | interaction | executable |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        unit = f"{np.rad2deg(r.goal):.0f} deg" if r.kind == "hinge" else f"{1000 * r.goal:.0f} mm"
        cells = (
            r.asset,
            r.joint,
            unit,
            f"{100 * r.share:.0f} %",
            r.contact or "-",
            str(r.tries),
            "yes" if r.success else r.reason,
        )
        lines.append(f"| {' | '.join(cells)} | {'yes' if r.executable else '; '.join(r.faults)} |")
    return "\n".join(lines) + "\n"
