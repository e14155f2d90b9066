"""What simulators, viewers and validators hold of our files, compared with asset.json by number.

python -m benchmarks.consumers WORK [--only CONSUMER ...] [--example NAME ...] [--python NAME=INTERPRETER ...]

WORK keeps the written assets and what each consumer said of them, so that a stopped run goes on; --anew begins again.
Consumers do not get on in one environment, so each may have an interpreter of its own, which needs numpy (for --drive also
scipy and jaxtyping); for `node` it is the folder whose node_modules has three, urdf-loader, jsdom and gltf-validator. --drive
also moves every joint to both limits in the engines of `anymesh check`. The reports of what was run (consumers.md, targets.md)
are rewritten, and with --page the tables between the page's marks.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks import EXAMPLES, REPORTS, parser_of
from benchmarks.consumers.driven import drive
from benchmarks.consumers.report import page_part, report

READERS = Path(__file__).parent / "readers"
FORMATS = "urdf,mjcf,usd,sdf,glb"
MARKS = ("<!-- {}: begin -->\n", "<!-- {}: end -->\n")
PATIENCE = 900.0  # [s] for one asset, some of which compile at first
FEW = ("microwave", "cabinet", "toy_car")  # examples for consumers that need minutes for each


@dataclass(frozen=True)
class Consumer:
    """A consumer of a format of ours. reader: script in `readers`; home: name of its interpreter; slow: for a few examples."""

    title: str
    reader: str
    variant: str
    home: str
    slow: bool = False

    @property
    def key(self) -> str:
        return f"{self.reader}-{self.variant}".lower()


CONSUMERS = (
    Consumer("MuJoCo, MJCF", "mujoco", "mjcf", "mujoco"),
    Consumer("MuJoCo, URDF", "mujoco", "urdf", "mujoco"),
    Consumer("Newton, URDF", "newton", "urdf", "newton"),
    Consumer("Newton, MJCF", "newton", "mjcf", "newton"),
    Consumer("Newton, USD", "newton", "usd", "newton"),
    Consumer("SAPIEN, URDF", "sapien", "urdf", "sapien"),
    Consumer("PyBullet, URDF", "pybullet", "urdf", "pybullet"),
    Consumer("Drake, URDF", "drake", "urdf", "drake"),
    Consumer("Drake, SDF", "drake", "sdf", "drake"),
    Consumer("Pinocchio, URDF", "pinocchio", "urdf", "pinocchio"),
    Consumer("Genesis, URDF", "genesis", "urdf", "genesis", slow=True),
    Consumer("PhysX, USD", "ovphysx", "usd", "ovphysx"),
    Consumer("OpenUSD, USD", "openusd", "usd", "openusd"),
    Consumer("libsdformat, SDF", "sdformat", "sdf", "sdformat"),
    Consumer("Blender, USD", "bpy", "usd", "bpy"),
    Consumer("Blender, GLB", "bpy", "glb", "bpy"),
    Consumer("three.js, URDF", "three", "urdf", "node"),
    Consumer("three.js, USD", "three", "usd", "node"),
    Consumer("three.js, GLB", "three", "glb", "node"),
    Consumer("glTF validator, GLB", "gltf_validator", "glb", "node"),
    Consumer("Newton, SimReady", "newton", "simready", "newton"),
    Consumer("PhysX, SimReady", "ovphysx", "simready", "ovphysx"),
    Consumer("OpenUSD, SimReady", "openusd", "simready", "openusd"),
    Consumer("SimReady validator, SimReady", "simready", "simready", "simready"),
    Consumer("robosuite, target", "mujoco", "robosuite", "robosuite"),
    Consumer("RoboCasa, target", "mujoco", "robocasa", "robocasa"),
    Consumer("ManiSkill, target", "sapien", "maniskill", "maniskill"),
    Consumer("Genesis, target", "genesis", "genesis", "genesis", slow=True),
    Consumer("PhysX, target Isaac Lab", "ovphysx", "isaaclab", "ovphysx"),
    Consumer("OpenUSD, target Isaac Lab", "openusd", "isaaclab", "openusd"),
)
TARGETS = ("robosuite", "robocasa", "maniskill", "genesis", "isaaclab")


HOMES = tuple(dict.fromkeys(c.home for c in CONSUMERS))


def write_asset(mesh: Path, folder: Path) -> None:
    """Write the asset of an example, unless it is there."""
    if (folder / "asset.json").is_file():
        return
    command = [sys.executable, "-m", "anymesh", "articulate", str(mesh), "-o", str(folder), "--formats", FORMATS]
    subprocess.run([*command, "--profile", "simready", "--quiet"], check=True)
    for target in TARGETS:  # an asset has one; here all are kept
        subprocess.run([*command[:3], "export", str(folder), "--target", target, "--quiet"], check=True)
        shutil.move(folder / target, folder.parent / f".{target}")
    for target in TARGETS:
        shutil.move(folder.parent / f".{target}", folder / target)


def ask(consumer: Consumer, folders: Sequence[Path], work: Path, homes: dict[str, str]) -> None:
    """Let a consumer read what it has not read yet, in a process that starts again after an asset that ends it."""
    place = work / consumer.key
    place.mkdir(parents=True, exist_ok=True)
    home = homes.get(consumer.home, sys.executable)
    env = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    if consumer.home == "node":
        home, env["NODE_MODULES"] = sys.executable, str(Path(home).absolute())
    while waiting := [f for f in folders if not (place / f"{f.name}.json").is_file()]:
        pairs = [str(p) for f in waiting for p in (f, place / f"{f.name}.json")]
        command = [home, str(READERS / f"{consumer.reader}_.py"), consumer.variant, *pairs]
        try:
            done = subprocess.run(
                command, env=env, capture_output=True, text=True, errors="replace", timeout=PATIENCE * len(waiting), check=False
            )
            why = f"ended its process with code {done.returncode}: {' '.join(done.stderr.split())[-200:]}"
        except subprocess.TimeoutExpired:
            why = f"over {PATIENCE:.0f} s"
        failed = next((f for f in waiting if not (place / f"{f.name}.json").is_file()), None)
        if failed is not None:
            (place / f"{failed.name}.json").write_text(json.dumps({"error": why}), encoding="utf-8")


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path, metavar="WORK")
    parser.add_argument("--only", action="append", metavar="CONSUMER", help=f"of {', '.join(c.key for c in CONSUMERS)}")
    parser.add_argument("--example", action="append", metavar="NAME")
    parser.add_argument("--python", action="append", default=[], metavar="NAME=INTERPRETER", help=f"of {', '.join(HOMES)}")
    parser.add_argument("--anew", action="store_true", help="forget what these consumers said before")
    parser.add_argument("--drive", action="store_true", help="also drive every joint in the engines")
    parser.add_argument("--page", type=Path, help="a page with the two marks")
    options = parser.parse_args()
    names = sorted(path.stem for path in (EXAMPLES / "meshes").glob("*.glb"))
    wrong = sorted(set(options.example or ()) - set(names)) + sorted(set(options.only or ()) - {c.key for c in CONSUMERS})
    if wrong:
        parser.error(f"found {', '.join(wrong)}; valid examples are {', '.join(names)}")
    homes = dict(pair.split("=", 1) for pair in options.python)
    folders = [options.work / "assets" / name for name in options.example or names]
    for folder in folders:
        write_asset(EXAMPLES / "meshes" / f"{folder.name}.glb", folder)
    for consumer in CONSUMERS:
        if options.only and consumer.key not in options.only:
            continue
        if options.anew:
            shutil.rmtree(options.work / consumer.key, ignore_errors=True)
        begin = time.perf_counter()
        ask(consumer, [f for f in folders if not consumer.slow or f.name in FEW], options.work, homes)
        print(f"{consumer.title}: {time.perf_counter() - begin:.0f} s", flush=True)
    if options.drive:
        drive(folders, [f for f in folders if f.name in FEW[:1]], options.work, homes)
    loaders = [c for c in CONSUMERS if c.variant in TARGETS]
    for name, consumers in (("consumers", [c for c in CONSUMERS if c not in loaders]), ("targets", loaders)):
        if any((options.work / c.key).is_dir() for c in consumers):
            (REPORTS / f"{name}.md").write_text(report(consumers, options.work), encoding="utf-8")
            if options.page:
                begin, end = (mark.format(name) for mark in MARKS)
                before, rest = options.page.read_text(encoding="utf-8").split(begin)
                text = before + begin + page_part(consumers, options.work) + end + rest.split(end)[1]
                options.page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
