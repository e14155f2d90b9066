"""Check of asset.json against the schema shipped with this package."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any

from anymesh.checking.report import Finding, failure
from anymesh.checking.tree import CHECK
from anymesh.simulation.robot import Robot

NAME = "asset.json"
MAX_VIOLATIONS = 5  # maximum number of reported violations
FIXED = "fixed"  # an MJCF has no names for such joints
SAME = 1e-6  # tolerance between the numbers of the two files


def check_asset_json(path: Path, robot: Robot) -> Iterator[Finding]:
    """Check that the file follows its schema, and that its links, joints and limits are those of the description."""
    import jsonschema

    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        yield failure(CHECK, NAME, f"cannot be read: {error}")
        return
    schema = json.loads(resources.files("anymesh.export").joinpath("asset.schema.json").read_text(encoding="utf-8"))
    errors = sorted(jsonschema.Draft202012Validator(schema).iter_errors(record), key=lambda e: [str(p) for p in e.path])
    for error in errors[:MAX_VIOLATIONS]:
        yield failure(CHECK, NAME, f"{error.json_path}: {error.message[:200]}")
    if not errors:
        yield from _agreement(record, robot)
        for part in record["parts"]:
            if not (path.parent / part["faces"]).is_file():
                yield failure(CHECK, NAME, f"the file {part['faces']} of part {part['name']!r} is not there")


def _agreement(record: dict[str, Any], robot: Robot) -> Iterator[Finding]:
    for word, recorded, described in (
        ("parts", {p["name"] for p in record["parts"]}, {link.name for link in robot.links}),
        ("joints", {j["name"] for j in record["joints"] if j["type"] != FIXED}, {j.name for j in robot.moving}),
    ):
        if recorded != described:
            yield failure(CHECK, NAME, f"its {word} {sorted(recorded)} are not those of {robot.path.name}: {sorted(described)}")
    limits = {j.name: j.limits for j in robot.joints}
    for joint in record["joints"]:
        other = limits.get(joint["name"])
        if joint["limits"] and other and max(abs(a - b) for a, b in zip(joint["limits"], other, strict=True)) > SAME:
            yield failure(CHECK, NAME, f"the limits of {joint['name']!r} are {joint['limits']}, in {robot.path.name} {other}")
