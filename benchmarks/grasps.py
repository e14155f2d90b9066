"""Every joint of some assets, moved by a floating gripper that is given only the best pose of grasps.json.

    python -m benchmarks.grasps FOLDER [--out TABLE.md] [--trials 10] [--joints 6]

FOLDER holds assets (of `anymesh articulate`, or of known parts and joints); grasps.json is written where there is none. Of one
with more joints, as many are measured, spread over its list. A joint is moved if it makes 90 % of the way from rest to its
farther limit (at most 90 degrees, 60 if it is endless), with the hand led along the joint. The first try is as stated. In the
others the object is displaced by up to 3 mm and 1 degree without the gripper knowing, with other friction, mass and damping,
drawn with another seed than those by which the poses were ranked.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from anymesh.applications.grasps.grasps import NAME, JointGrasps, read_grasps, write_grasps
from anymesh.applications.grasps.ranking_ import VARIED, placed, rank_grasps
from anymesh.applications.policy.controller_ import DONE, follow_target
from anymesh.applications.policy.objects_ import find_assets, moving_joints
from anymesh.applications.policy.robots_ import GRIPPER, Gripper
from anymesh.errors import AnymeshError

SEED = 1


def moved(asset: Path, found: JointGrasps, gripper: Gripper, trials: int) -> tuple[float, float]:
    """Return the share of the way that the best pose makes, and the share of displaced trials in which it moves the joint."""
    object_, simulation, targets = placed(asset, found, gripper)
    rng = np.random.default_rng(SEED)
    share = follow_target(object_, targets[0], simulation).share
    others = [follow_target(object_, targets[0], simulation, VARIED.draw(rng)).share >= DONE for _ in range(trials)]
    return share, float(np.mean(others))


def grasps_of(asset: Path, most: int) -> tuple[Gripper, tuple[JointGrasps, ...]]:
    """Return what grasps.json says of some joints, or of joints ranked now."""
    if not (asset / NAME).is_file():
        names = moving_joints(asset)
        some = [names[k * len(names) // most] for k in range(most)] if len(names) > most else names
        write_grasps(asset / NAME, [rank_grasps(asset, name)[0] for name in some], GRIPPER, 0)
    return read_grasps(asset / NAME)


def rows(folder: Path, trials: int, most: int) -> Iterator[tuple[str, JointGrasps, float, float]]:
    for asset in find_assets(folder):
        try:
            gripper, joints = grasps_of(asset, most)
        except AnymeshError as error:
            print(f"{asset.name}: {error}")
            continue
        for found in joints:
            yield asset.name, found, *(moved(asset, found, gripper, trials) if found.grasps else (0.0, 0.0))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--joints", type=int, default=6)
    args = parser.parse_args()
    lines = ["| asset | joint | pose | score | made | displaced | why not |", "|---|---|---|---|---|---|---|"]
    made: dict[str, list[tuple[bool, float]]] = {}
    for name, found, share, others in rows(args.folder, args.trials, args.joints):
        best, score = (found.grasps[0].kind.value, f"{found.grasps[0].score:.2f}") if found.grasps else ("-", "-")
        made.setdefault(name, []).append((share >= DONE, others))
        why = found.reason or "-" if not found.after else f"after {', '.join(n for n, _ in found.after)}"
        lines.append(f"| {name} | {found.joint} | {best} | {score} | {100 * share:.0f} % | {100 * others:.0f} % | {why} |")
    lines += ["", "| asset | joints | moved | share of displaced trials |", "|---|---|---|---|"]
    for name, some in (*made.items(), ("all", [one for each in made.values() for one in each])):
        displaced = float(np.mean([others for _, others in some]))
        lines.append(f"| {name} | {len(some)} | {sum(good for good, _ in some)} | {displaced:.2f} |")
    shares = [np.mean([good for good, _ in some]) for some in made.values()]
    lines += ["", f"Mean of the shares of joints moved, over {len(made)} assets: {np.mean(shares):.2f}."]
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if args.out:
        args.out.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
