"""Every joint of some assets, opened by a floating gripper that is given only the frame of its handle in asset.json.

    python -m benchmarks.handles FOLDER [--out TABLE.md]

FOLDER holds assets of `anymesh articulate`. A joint is opened if it makes 90 % of the way from rest to its farther limit (at
most 90 degrees), with the hand led along the joint. One grasp is tried, in the simulation of `--protocol interaction`.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.applications.policy.controller_ import ROOM, follow_target
from anymesh.applications.policy.objects_ import find_assets, object_at_rest
from anymesh.applications.policy.robots_ import PAD, REACH, STROKE
from anymesh.errors import AnymeshError

CLEAR = 0.002  # [m] that fingertips keep from what is behind a handle


def target_of(handle: dict[str, Any]) -> Target:
    """Return where the tool grasps a handle: as deep as its fingers reach, at most to the handle's middle."""
    z, y = np.array(handle["approach"]), np.array(handle["closing"])
    deep = np.clip(min(handle["depth"] - REACH - CLEAR, handle["width"] / 2), 0, PAD[0])
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = np.stack([np.cross(y, z), y, z], 1), np.array(handle["place"]) + deep * z
    return Target(GripperContact.GRASP, T, handle["width"], 1.0)


def opened(folder: Path, joint: dict[str, Any]) -> tuple[float, str]:
    """Return the share of the way that a joint made, and why it is not open; "" if it is."""
    handle = joint.get("handle")
    if handle is None:
        return 0.0, "no handle"
    if handle["width"] > STROKE - ROOM:
        return 0.0, f"{1000 * handle['width']:.0f} mm wide"
    try:
        made = follow_target(object_at_rest(folder, joint["name"]), target_of(handle))
    except AnymeshError as error:
        return 0.0, str(error)
    return made.share, "" if made.failure is None else made.failure.value


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path)
    args = parser.parse_args()
    rows, good, held = ["| asset | joint | made | why not |", "|---|---|---|---|"], [], []
    for folder in find_assets(args.folder):
        record = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
        for joint in (j for j in record["joints"] if j["type"] != "fixed"):
            share, why = opened(folder, joint)
            good.append(not why)
            held.append("handle" in joint)
            rows.append(f"| {record['name']} | {joint['name']} | {100 * share:.0f} % | {why or '-'} |")
    rows += ["", f"{sum(good)} of {len(good)} joints are opened, of which {sum(held)} have a handle."]
    text = "\n".join(rows) + "\n"
    print(text, end="")
    if args.out:
        args.out.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
