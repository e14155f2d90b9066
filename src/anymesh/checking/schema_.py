"""Check of asset.json against the schema shipped with this package."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from anymesh.checking.content import Content
from anymesh.checking.engines.locate import PACKAGES
from anymesh.checking.engines.robot import Robot
from anymesh.checking.report import Finding, failure, warning
from anymesh.names import legal_name
from anymesh.types import Mimic

SCHEMA = "schema"
NAME = "asset.json"
MAX_VIOLATIONS = 5  # maximum number of reported violations
CHAINS = ("screw", "ball", "free")  # types that a URDF writes as several joints, with links between them
FIXED = "fixed"  # an MJCF has no names for such joints
SAME = 1e-6  # tolerance between the numbers of the two files
NAMING = "naming"
LEGAL_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")


def check_tree(robot: Robot) -> Iterator[Finding]:
    """Check for unique names, existing links, one root and no cycle, which all other checks require."""
    for subject, text in robot.problems:
        yield failure(SCHEMA, subject, text)
    if not robot.links:
        yield failure(SCHEMA, "", "it holds no link; at least one is needed")
        return
    for word, names in (("link", [b.name for b in robot.links]), ("joint", [j.name for j in robot.joints])):
        for name, count in Counter(names).items():
            if count > 1 or not name:
                shown = f"{count} {word}s are called {name!r}" if name else f"{count} {word}s have no name"
                yield failure(SCHEMA, name, f"{shown}; names must be unique and not empty")
    known = {link.name for link in robot.links}
    for joint in robot.joints:
        for word, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in known:
                yield failure(SCHEMA, joint.name, f"its {word} is the link {link!r}, which is not there")
    for child, count in Counter(j.child for j in robot.joints).items():
        if count > 1:
            yield failure(SCHEMA, child, f"{count} joints have this link as their child; one is valid")
    if len(robot.roots) != 1:
        roots = ", ".join(robot.roots) or "none, since the joints form a cycle"
        yield failure(SCHEMA, "", f"the links that no joint carries are: {roots}; valid is one")
    elif len(robot.carried(robot.roots[0])) < len(known):
        lost = sorted(known - robot.carried(robot.roots[0]))
        yield failure(SCHEMA, lost[0], f"the links {lost} are not connected to the root {robot.roots[0]!r}; valid is a tree")


def check_files(content: Content) -> Iterator[Finding]:
    """Check that mesh files exist, and that their paths are portable."""
    for link, file in content.missing:
        yield failure(SCHEMA, link, f"the mesh {file} is not there")
    for link in content.robot.links:
        for file in dict.fromkeys(s.file for s in (*link.visuals, *link.collisions) if s.file):
            if file.startswith(("/", "file:")) or file[1:2] == ":":
                yield warning(SCHEMA, link.name, f"the mesh path {file} is absolute; a relative path works everywhere")
            elif "\\" in file:
                yield warning(SCHEMA, link.name, f"the mesh path {file} has backslashes; forward slashes work everywhere")
            elif "://" in file and not PACKAGES.match(file):
                yield warning(SCHEMA, link.name, f"the mesh path {file} is a URL; engines read relative paths and package://")


def check_asset_json(path: Path, robot: Robot) -> Iterator[Finding]:
    """Check that the file follows its schema, that its files are complete, and that it agrees with the description."""
    import jsonschema

    try:
        record = json.loads(path.read_text(encoding="utf-8"), parse_constant=_finite, parse_float=_finite)
    except (OSError, ValueError) as error:
        yield failure(SCHEMA, NAME, f"cannot be read: {error}")
        return
    schema = json.loads(resources.files("anymesh.export").joinpath("asset.schema.json").read_text(encoding="utf-8"))
    errors = sorted(jsonschema.Draft202012Validator(schema).iter_errors(record), key=lambda e: [str(p) for p in e.path])
    for error in errors[:MAX_VIOLATIONS]:
        yield failure(SCHEMA, NAME, f"{error.json_path}: {error.message[:200]}")
    if not errors:
        yield from _agreement(record, robot)
        yield from _files(record, path.parent)
        for part in record["parts"]:
            if not (path.parent / part["faces"]).is_file():
                yield failure(SCHEMA, NAME, f"the file {part['faces']} of part {part['name']!r} is not there")


def _finite(number: str) -> float:
    if not math.isfinite(value := float(number)):
        raise ValueError(f"found the number {number}; valid are finite numbers")
    return value


def _files(record: dict[str, Any], folder: Path) -> Iterator[Finding]:
    """Check that the main file of each format is there, and is complete if it is XML."""
    for kind, file in record["files"].items():
        if not (folder / file).is_file():
            yield failure(SCHEMA, NAME, f"the {kind} file {file} is not there")
        elif kind in ("urdf", "mjcf", "sdf"):
            try:
                ElementTree.parse(folder / file)
            except ElementTree.ParseError as error:
                yield failure(SCHEMA, file, f"is broken or truncated: {error}")


def _agreement(record: dict[str, Any], robot: Robot) -> Iterator[Finding]:
    """Check parts, joints and limits against those of the description, whose joints form a tree."""
    joints, parts = record["joints"], [p["name"] for p in record["parts"]]
    links, moving, above = [link.name for link in robot.links], robot.moving, {j.child: j.parent for j in robot.joints}
    if any(j["type"] in CHAINS for j in joints):  # a chain counts as one joint
        known = {j["name"] for j in joints}
        links, moving = [n for n in links if n in parts], tuple(j for j in moving if j.name in known)

        def part_above(link: str) -> str:
            return link if link in parts or link not in above else part_above(above[link])

        above = {child: part_above(parent) for child, parent in above.items() if child in parts}
    for word, recorded, described in (
        ("parts", parts, links),
        ("joints", [j["name"] for j in joints if j["type"] != FIXED], [j.name for j in moving]),
        ("parents", [(j["child"], j["parent"]) for j in joints], [*above.items()]),
    ):
        if sorted(recorded) != sorted(described):
            yield failure(
                SCHEMA, NAME, f"its {word} {sorted(recorded)} are not those of {robot.path.name}: {sorted(described)}"
            )
    limits = {j.name: j.limits for j in robot.joints}
    for joint in (j for j in joints if j["type"] not in CHAINS):
        other = limits.get(joint["name"])
        if joint["limits"] and other and max(abs(a - b) for a, b in zip(joint["limits"], other, strict=True)) > SAME:
            yield failure(SCHEMA, NAME, f"the limits of {joint['name']!r} are {joint['limits']}, in {robot.path.name} {other}")
    yield from _couplings({j["name"]: j for j in joints}, robot)


def _couplings(joints: dict[str, dict[str, Any]], robot: Robot) -> Iterator[Finding]:
    """Check what follows what, and the pitch of screws, of which a slide follows the turn; descriptions have no chains."""
    described = {j.name: j.mimic for j in robot.joints}
    slides = [m for name, m in described.items() if m is not None and name not in joints]
    for name, joint in joints.items():
        lead, ratio, offset = name, 1.0, 0.0
        for _ in joints:
            if (m := joints.get(lead, {}).get("mimic")) is not None:
                lead, ratio, offset = m["joint"], ratio * m["ratio"], offset + ratio * m["offset"]
        stated, other = None if lead == name else Mimic(lead, ratio, offset), described.get(name)
        if name in described and not _same(stated, other):
            yield failure(SCHEMA, NAME, f"what {name!r} follows is {_words(stated)}, in {robot.path.name} {_words(other)}")
        rate = joint.get("pitch", 0.0) / (2 * math.pi)
        if joint["type"] == "screw" and not any(_same(Mimic(lead, rate * ratio, rate * offset), m) for m in slides):
            yield failure(SCHEMA, NAME, f"the pitch of {name!r} is {joint.get('pitch')}, in {robot.path.name} another")


def _same(a: Mimic | None, b: Mimic | None) -> bool:
    if a is None or b is None:
        return a is b
    return a.joint == b.joint and max(abs(a.ratio - b.ratio), abs(a.offset - b.offset)) < SAME


def _words(m: Mimic | None) -> str:
    return "none" if m is None else f"{m.joint!r} by {m.ratio:.6g} from {m.offset:.6g}"


def beyond_urdf(record: dict[str, Any], robot: Robot) -> set[str]:
    """Return the joints of a description that say only a part of a mechanism: chains for one joint, and what is on loops.

    They are proved on the MJCF. record: asset.json.
    """
    joints = {j["name"]: j for j in record.get("joints", ())}
    chains = {name for name, j in joints.items() if j["type"] in CHAINS}
    helpers = {j.name for j in robot.joints} - joints.keys() if chains else set()
    above = {j["child"]: j for j in joints.values()}
    looped = set[str]()
    for loop in record.get("loops", ()):
        ways = []
        for link in loop["links"]:
            way = set[str]()
            while link in above:
                way.add(above[link]["name"])
                link = above[link]["parent"]
            ways.append(way)
        looped |= ways[0] ^ ways[1]
    return chains | helpers | looped


def check_naming(robot: Robot) -> Iterator[Finding]:
    """Check that names have only letters, digits, underscore, point and hyphen, and differ by more than case."""
    for word, names in (("link", [b.name for b in robot.links]), ("joint", [j.name for j in robot.joints])):
        for name in names:
            if name and not LEGAL_NAME.fullmatch(name):
                legal = legal_name(name, fallback=word)
                yield warning(NAMING, name, f"the name of this {word} is changed or refused by some engines; {legal} is valid")
        seen: dict[str, str] = {}
        for name in names:
            other = seen.setdefault(name.lower(), name)
            if other != name:
                problem = f"differs from the {word} {other!r} only in case; their files would overwrite each other"
                yield warning(NAMING, name, problem)
