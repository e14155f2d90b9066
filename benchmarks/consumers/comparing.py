"""Comparison of what a consumer holds with asset.json, value by value."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.robot import read_urdf
from anymesh.formats.in_metres import read_in_metres
from anymesh.types import JointType, Motion

RELATIVE, LENGTH, ANGLE = 1e-4, 1e-4, 2e-3  # share of a value, [m], [rad]: what counts as equal
NUMBERS = ("friction", "damping", "effort", "velocity", "armature")
PROPERTIES = ("types", "axes", "limits", *NUMBERS, "springs", "masses", "inertia", "drawn")


@dataclass(frozen=True)
class Value:
    """One value of asset.json in a consumer. held: in words, None if it has nothing; equal: whether it is right."""

    property: str
    of: str  # joint or link
    wanted: str
    held: str | None
    equal: bool


@dataclass(frozen=True, eq=False)
class Truth:
    """What a consumer should hold, in the asset frame. inertia: link -> center (3), tensor (3, 3); boxes: link -> corners."""

    joints: Mapping[str, dict]
    masses: Mapping[str, float]
    inertia: Mapping[str, tuple[np.ndarray, np.ndarray]]
    boxes: Mapping[str, Float[np.ndarray, "2 3"]]
    places: Mapping[str, Float[np.ndarray, " 3"]]


def truth_of(folder: Path) -> Truth:
    """Read asset.json; centers and tensors, which it does not have, are those of the URDF, and boxes those of its visuals."""
    content = json.loads((folder / "asset.json").read_text(encoding="utf-8"))
    robot = read_urdf(folder / content["files"]["urdf"])
    at = robot.placements({})
    inertia, boxes = {}, {}
    for link in robot.links:
        T = at[link.name]
        if link.inertial is not None:
            center = T[:3, :3] @ link.inertial.center + T[:3, 3]
            inertia[link.name] = (center, T[:3, :3] @ link.inertial.tensor @ T[:3, :3].T)
        files = [folder / str(v.file) for v in link.visuals]
        points = np.concatenate([read_in_metres(file, None)[0].vertices for file in files])
        placed = points @ T[:3, :3].T + T[:3, 3]
        boxes[link.name] = np.array([placed.min(0), placed.max(0)])
    masses = {part["name"]: part["mass"] for part in content["parts"]}
    places = {name: T[:3, 3] for name, T in at.items()}
    return Truth({j["name"]: j for j in content["joints"]}, masses, inertia, boxes, places)


def compare(truth: Truth, record: Mapping) -> list[Value]:
    """Return each value that asset.json states, as a consumer holds it."""
    found: list[Value] = []
    if "joints" in record:
        for name, wanted in truth.joints.items():
            found += _joint(name, wanted, record["joints"].get(name))
    if "links" in record:
        for name in truth.masses:
            found += _link(name, truth, record["links"].get(name, {}))
    return found


def _joint(name: str, wanted: Mapping, held: Mapping | None) -> Iterator[Value]:
    kind = " ".join(wanted[key] for key in ("type", "parent", "child"))
    if held is None:
        yield Value("types", name, kind, None, False)
        return
    said = " ".join(held.get(key) or wanted[key] for key in ("type", "parent", "child"))
    yield Value("types", name, kind, said, said == kind)
    if wanted["type"] == "fixed":
        return
    shown, fault = _motion(wanted, held)
    yield Value("axes", name, "as asset.json", shown, shown is not None and not fault)
    limits = wanted["limits"]
    text = None if "limits" not in held else _range(held["limits"])
    same = text is not None and (limits is None) == (held["limits"] is None)
    same = same and (limits is None or bool(np.allclose(limits, held["limits"], rtol=0, atol=LENGTH)))
    yield Value("limits", name, _range(limits), text, same)
    for key in NUMBERS:
        value, number = wanted.get(key, 0.0), held.get(key)
        same = number is not None and bool(np.isclose(number, value, rtol=RELATIVE, atol=1e-9))
        yield Value(key, name, f"{value:.4g}", None if number is None else f"{number:.4g}", same)
    spring = wanted.get("mechanism", {})
    if "stiffness" in spring:
        pair = [(s.get("stiffness"), s.get("reference")) for s in (spring, held)]
        text = None if None in pair[1] else "{:.4g} about {:.4g}".format(*pair[1])
        same = text is not None and bool(np.allclose(*pair, rtol=RELATIVE, atol=1e-6))
        yield Value("springs", name, "{:.4g} about {:.4g}".format(*pair[0]), text, same)


def _range(limits: object) -> str:
    return "none" if limits is None else "{:.4f}..{:.4f}".format(*limits)  # ty: ignore


def _motion(wanted: Mapping, held: Mapping) -> tuple[str | None, bool]:
    """Return how a consumer moves a joint, in words, and whether that is wrong."""
    slides, axis, origin = wanted["type"] == "prismatic", np.array(wanted["axis"], float), np.array(wanted["origin"], float)
    if "axis" in held:
        way, at = np.array(held["axis"], float), np.array(held["origin"], float)
        away = 0.0 if slides else float(Motion(JointType.REVOLUTE, axis, origin, "asset.json").distance(at[None])[0])
        off = float(np.arccos(np.clip(way @ axis / np.linalg.norm(way), -1, 1)))
        return f"{np.degrees(off):.2f} degrees and {1000 * away:.2f} mm off", off > ANGLE or away > LENGTH
    if "moved" not in held:
        return None, True
    motion = Motion(JointType.PRISMATIC if slides else JointType.REVOLUTE, axis, origin, "asset.json")
    left = np.linalg.inv(motion.transform(held["amount"])) @ np.array(held["moved"])  # the identity if it is right
    off = float(np.arccos(np.clip((np.trace(left[:3, :3]) - 1) / 2, -1, 1)))
    away = float(np.linalg.norm((left - np.eye(4))[:3] @ np.append(origin, 1)))
    return f"{np.degrees(off):.2f} degrees and {1000 * away:.2f} mm off", off > ANGLE or away > LENGTH


def _link(name: str, truth: Truth, held: Mapping) -> Iterator[Value]:
    if "mass" in held or not held:
        wanted, mass = truth.masses[name], held.get("mass")
        same = mass is not None and bool(np.isclose(mass, wanted, rtol=RELATIVE))
        yield Value("masses", name, f"{wanted:.5g} kg", None if mass is None else f"{mass:.5g} kg", same)
    if "inertia" in held:
        center, tensor = truth.inertia[name]
        away = float(np.linalg.norm(center - held["center"]))
        share = float(np.abs(tensor - held["inertia"]).max() / np.abs(tensor).max())
        text = f"center {1000 * away:.2f} mm off, tensor {100 * share:.2f} % off"
        yield Value("inertia", name, "of the URDF", text, away <= LENGTH and share <= 10 * RELATIVE)
    if "place" in held or not held:
        away = float(np.linalg.norm(truth.places[name] - held["place"])) if held else 0.0
        box = np.array(held["box"]) if "box" in held else None
        off = 0.0 if box is None else float(np.abs(truth.boxes[name] - box).max())
        text = f"{1000 * max(away, off):.2f} mm off" if held else None
        yield Value("drawn", name, "there", text, bool(held) and max(away, off) <= LENGTH)
