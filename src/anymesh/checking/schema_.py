"""Check of asset.json against the schema shipped with this package."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from anymesh.checking.engines.robot import Robot
from anymesh.checking.report import Finding, failure
from anymesh.checking.tree import CHECK

NAME = "asset.json"
MAX_VIOLATIONS = 5  # maximum number of reported violations
FIXED = "fixed"  # an MJCF has no names for such joints
SAME = 1e-6  # tolerance between the numbers of the two files


def check_asset_json(path: Path, robot: Robot) -> Iterator[Finding]:
    """Check that the file follows its schema, that its files are complete, and that it agrees with the description."""
    import jsonschema

    try:
        record = json.loads(path.read_text(encoding="utf-8"), parse_constant=_finite, parse_float=_finite)
    except (OSError, ValueError) as error:
        yield failure(CHECK, NAME, f"cannot be read: {error}")
        return
    schema = json.loads(resources.files("anymesh.export").joinpath("asset.schema.json").read_text(encoding="utf-8"))
    errors = sorted(jsonschema.Draft202012Validator(schema).iter_errors(record), key=lambda e: [str(p) for p in e.path])
    for error in errors[:MAX_VIOLATIONS]:
        yield failure(CHECK, NAME, f"{error.json_path}: {error.message[:200]}")
    if not errors:
        yield from _agreement(record, robot)
        yield from _files(record, path.parent)
        for part in record["parts"]:
            if not (path.parent / part["faces"]).is_file():
                yield failure(CHECK, NAME, f"the file {part['faces']} of part {part['name']!r} is not there")


def _finite(number: str) -> float:
    if not math.isfinite(value := float(number)):
        raise ValueError(f"found the number {number}; valid are finite numbers")
    return value


def _files(record: dict[str, Any], folder: Path) -> Iterator[Finding]:
    """Check that the main file of each format is there, and is complete if it is XML."""
    for kind, file in record["files"].items():
        if not (folder / file).is_file():
            yield failure(CHECK, NAME, f"the {kind} file {file} is not there")
        elif kind in ("urdf", "mjcf", "sdf"):
            try:
                ElementTree.parse(folder / file)
            except ElementTree.ParseError as error:
                yield failure(CHECK, file, f"is broken or truncated: {error}")


def _agreement(record: dict[str, Any], robot: Robot) -> Iterator[Finding]:
    """Check parts, joints and limits against those of the description, whose joints form a tree."""
    joints = record["joints"]
    for word, recorded, described in (
        ("parts", [p["name"] for p in record["parts"]], [link.name for link in robot.links]),
        ("joints", [j["name"] for j in joints if j["type"] != FIXED], [j.name for j in robot.moving]),
        ("parents", [(j["child"], j["parent"]) for j in joints], [(j.child, j.parent) for j in robot.joints]),
    ):
        if sorted(recorded) != sorted(described):
            yield failure(CHECK, NAME, f"its {word} {sorted(recorded)} are not those of {robot.path.name}: {sorted(described)}")
    limits = {j.name: j.limits for j in robot.joints}
    for joint in joints:
        other = limits.get(joint["name"])
        if joint["limits"] and other and max(abs(a - b) for a, b in zip(joint["limits"], other, strict=True)) > SAME:
            yield failure(CHECK, NAME, f"the limits of {joint['name']!r} are {joint['limits']}, in {robot.path.name} {other}")
