"""What engines make of mechanisms: the fixtures of the tests, what leads moved, and where what follows is then.

python -m benchmarks.consumers.mechanisms WORK [--python NAME=INTERPRETER ...]

MuJoCo and Newton are proved by `anymesh check`. A cell: where the last joint that follows is, and where it should be by what
leads it as it then is. The table is written to benchmarks/reports/mechanisms.md.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import anymesh
from anymesh.errors import AnymeshError
from anymesh.export import write_asset
from anymesh.export.options import ExportOptions
from anymesh.mechanisms.closing import closed
from anymesh.types import Asset
from anymesh.types.motion import led
from benchmarks import REPORTS, ROOT, made_with, parser_of, table_head, table_row
from benchmarks.consumers.readers.moving_ import MARK

sys.path += [str(ROOT / "tests"), str(ROOT / "tests" / "export")]
from mechanical import doors, gears, jar, lever, linkage

LEADS = {
    doors: {"hinge": 1.05, "first": 0.15}, gears: {"wheel_joint": 2.0}, lever: {"lever_joint": 0.5},
    jar: {"thread": 6.0}, linkage: {"crank_joint": 0.4},
}  # fmt: skip
SHOWN = (("twin", "turn"), ("third", "stage"), ("pinion_joint", "endless"), ("right_joint", "ratio 2"))
SHOWN += (("thread_1", "screw"), ("rocker_joint", "loop"))
COLUMNS = [("pinocchio", "urdf"), ("pybullet", "urdf"), ("sapien", "urdf"), ("drake", "urdf"), ("drake", "sdf")]
COLUMNS += [("genesis", "urdf"), ("genesis", "mjcf"), ("physx", "usd")]
PATIENCE = 600.0  # [s]


def moved(engine: str, path: Path, leads: Mapping[str, float], python: str) -> dict[str, float]:
    """Return the positions of joints in an engine. Raise ValueError with what it said if it gives none."""
    reader = Path(__file__).parent / "readers" / "moving_.py"
    env = os.environ | {"PYTHONPATH": str(Path(anymesh.__file__).parents[1])}
    command = [python, str(reader), engine, str(path), json.dumps(leads)]
    done = subprocess.run(command, env=env, capture_output=True, text=True, errors="replace", timeout=PATIENCE, check=False)
    answer = [line for line in done.stdout.splitlines() if line.startswith(MARK)]
    if not answer:
        raise ValueError(" ".join(done.stderr.split())[-80:])
    return json.loads(answer[0].removeprefix(MARK))


def wanted(asset: Asset, at: Mapping[str, float], leads: Mapping[str, float]) -> dict[str, float]:
    """Return where all joints should be by what leads them."""
    leading = {name: at[name] for name in leads}
    right = {name: float(value) for name, value in led(asset.joints, closed(asset, leading)).items()}
    for joint in asset.joints:
        if joint.pitch:
            right |= dict.fromkeys((f"{joint.name}_1", f"{joint.name}_lift"), joint.pitch / 6.283185307 * at[joint.name])
    return right


def column(engine: str, kind: str, work: Path, python: str) -> dict[str, str]:
    """Return a cell for each joint that is shown."""
    cells = dict[str, str]()
    for make, leads in LEADS.items():
        asset, folder = make(), work / make.__name__
        if not (folder / "asset.json").is_file():
            folder.mkdir(parents=True, exist_ok=True)
            write_asset(asset, folder, ExportOptions.parse({"formats": "urdf,mjcf,usd,sdf"}))
        files = {"mjcf": f"{asset.name}.xml", "sdf": "model.sdf"}
        try:
            at = moved(engine, folder / files.get(kind, f"{asset.name}.urdf"), leads, python)
        except (ValueError, subprocess.TimeoutExpired, AnymeshError) as error:
            print(f"{engine} {kind} {asset.name}: {error}", flush=True)
            cells |= dict.fromkeys(asset_joints(asset), "refused")
            continue
        right = wanted(asset, at, leads)
        cells |= {name.replace("_lift", "_1"): f"{at[name]:.3f} of {right[name]:.3f}" for name in at if name in right}
    return cells


def asset_joints(asset: Asset) -> list[str]:
    return [name for j in asset.joints for name in (j.name, f"{j.name}_1")]


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path, metavar="WORK")
    parser.add_argument("--python", action="append", default=[], metavar="NAME=INTERPRETER", help="of the engines")
    options = parser.parse_args()
    homes = dict(pair.split("=", 1) for pair in options.python)
    lines = table_head(["", *(words for _, words in SHOWN)])
    for engine, kind in COLUMNS:
        cells = column(engine, kind, options.work, homes.get(engine, sys.executable))
        lines.append(table_row([f"{engine}, {kind.upper()}", *(cells.get(name, "-") for name, _ in SHOWN)]))
        print(lines[-1], flush=True)
    head = [
        "# Mechanisms in engines",
        "",
        f"`python -m benchmarks.consumers.mechanisms WORK`, {made_with('articulate-anymesh')}",
        "",
    ]
    (REPORTS / "mechanisms.md").write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
