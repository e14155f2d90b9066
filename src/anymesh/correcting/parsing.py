"""Operations on a part, given as text or JSON values, as corrections."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.correcting.copies import copies_of, same_for_copies
from anymesh.correcting.corrections import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Confirm,
    Correction,
    CorrectionError,
    FaceSet,
    FlipSign,
    MergeParts,
    Relabel,
    RemovePart,
    Rename,
    SetAxis,
    SetLimits,
    SetLoop,
    SetMimic,
    SetScrew,
    SplitComponents,
    SplitPart,
    vector,
)
from anymesh.correcting.edits import MAX_LIMIT, apply
from anymesh.correcting.listing import named_part, regions_of
from anymesh.correcting.motions import ranked_motions, told_apart
from anymesh.correcting.operations import OPERATIONS
from anymesh.correcting.tree import joint_of_part, part_number
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import sample_surface
from anymesh.names import listed
from anymesh.types import Asset, Joint, JointType
from anymesh.types.motion import LOOP_KINDS

ANGLES = {"deg": float(np.pi / 180), "°": float(np.pi / 180), "rad": 1.0}
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
QUANTITY = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-z°]*)")
BETWEEN = re.compile(r"\s*(?:,|\.\.)\s*")
AXIS = re.compile(r"([-+]?)([xyz])")
TYPES = {"hinge": "revolute", "slide": "prismatic", "endless": "continuous", **{str(t): str(t) for t in JointType}}
MAX_SLIDES = 3.0  # diagonals of the object: a longer slide is a mistake of units, as in checking/joints.py
NONE = "none"  # instead of a part: what the operation sets is removed
MAX_TEXT = 10_000  # characters of a value


def quantity(value: Any, type_: JointType, unit: str = "") -> float:
    """Parse an angle [deg] of a hinge, or a length [m] of a slide, with or without a unit, and return it in rad or m.

    unit: of a number without one. Raise CorrectionError for anything else.
    """
    units, usual = (LENGTHS, "m") if type_ is JointType.PRISMATIC else (ANGLES, "deg")
    match = QUANTITY.fullmatch(str(value).strip().lower()[:MAX_TEXT])
    if match is None or (match[2] or unit or usual) not in units:
        value = f"{value}{unit}" if match and not match[2] else value
        valid = "such as 0.4, 40cm or 400mm" if type_ is JointType.PRISMATIC else "such as 110, 110deg or 1.9rad"
        kind = "a length" if type_ is JointType.PRISMATIC else "an angle"
        raise CorrectionError(f"{str(value)[:40]!r} is not {kind}; valid are numbers {valid}")
    return float(match[1]) * units[match[2] or unit or usual]


def limits_of(value: Any, type_: JointType, diagonal: float) -> tuple[float, float]:
    """Parse limits, such as "0,110", "-20..90", "0,40cm", 110 or (0, 0.4) [deg, or m; with a unit also others], as rad or m.

    A unit of the last number is also that of a first one without a unit; a single number is the limit beside 0. A slide of
    several times the object's diagonal [m] is refused, since its unit is probably wrong.
    """
    ends = BETWEEN.split(_text(value).strip())
    if len(ends) > 2:
        raise CorrectionError(f"limits are a lower and an upper one, such as 0,110 or 0,40cm; found {_text(value)[:40]!r}")
    last = QUANTITY.fullmatch(ends[-1].strip().lower())
    numbers = [quantity(end, type_, last[2] if last else "") for end in ends]
    lower, upper = (min(0.0, *numbers), max(0.0, *numbers)) if len(numbers) == 1 else numbers
    if type_ is JointType.PRISMATIC and MAX_SLIDES * diagonal < upper - lower <= MAX_LIMIT:
        raise CorrectionError(
            f"a slide over {upper - lower:g} m is far longer than the object ({diagonal:.2g} m); "
            "numbers are in metres, other units are written out, such as 0,40cm"
        )
    return lower, upper


def axis_of(value: Any) -> Float[np.ndarray, " 3"]:
    """Parse a direction: x, -z, or three numbers."""
    text = _text(value).strip().lower()
    if match := AXIS.fullmatch(text):
        return (-1.0 if match[1] == "-" else 1.0) * np.eye(3)["xyz".index(match[2])] + 0.0
    return _triple(text, "an axis", "x, -z or 0,0.6,0.8", "")


def _triple(value: Any, what: str, valid: str, unit: str) -> Float[np.ndarray, " 3"]:
    numbers = BETWEEN.split(_text(value).strip())
    try:
        x, y, z = (quantity(n, JointType.PRISMATIC, unit) for n in numbers)
    except (CorrectionError, ValueError):
        raise CorrectionError(f"{_text(value)[:40]!r} is not {what}; valid are {valid}") from None
    return np.array([x, y, z])


def _text(value: Any) -> str:
    """Return a value of JSON or Python as the text of the command line."""
    text = ",".join(str(v) for v in value) if isinstance(value, (list, tuple, np.ndarray)) else str(value)
    if len(text) > MAX_TEXT:
        raise CorrectionError(f"a value has at most {MAX_TEXT} characters, found {len(text)}")
    return text


class CorrectionPlan:
    """Corrections in the making. asset: as it is after them; part: that the operations are about, None if there is none."""

    def __init__(self, asset: Asset, part: str | None) -> None:
        self.asset, self.part = asset, None if part is None else named_part(asset, part)
        self.corrections: list[Correction] = []

    def add(self, *corrections: Correction) -> None:
        """Apply corrections. Raise CorrectionError if one is not applicable."""
        for correction in corrections:
            self.asset = apply(self.asset, correction)
            self.corrections.append(correction)

    @property
    def name(self) -> str:
        """The part's name. Raise CorrectionError without a part."""
        if self.part is None:
            parts = [p.name for p in self.asset.segmentation.parts]
            raise CorrectionError(f"name the part or joint to correct; the parts are {listed(parts)}")
        return self.part

    @property
    def joint(self) -> Joint:
        """The joint that carries the part. Raise CorrectionError for the root."""
        return joint_of_part(self.asset, self.name)


def corrections_of(asset: Asset, part: str | None, operations: Mapping[str, Any]) -> tuple[Correction, ...]:
    """Return the corrections of some operations (name -> value) on a part, which may be named by its joint.

    They are taken in the order of `OPERATIONS`; what is so already makes no correction. `undo` is not one of them.
    Raise CorrectionError for an unknown operation, a wrong value, or one that is not applicable.
    """
    unknown = [name for name in operations if name not in HANDLERS]
    if unknown:
        raise CorrectionError(f"unknown operation {unknown[0]!r}; valid are {', '.join(HANDLERS)}")
    plan = CorrectionPlan(asset, part)
    for operation in OPERATIONS:
        value = operations.get(operation.name)
        if value is not None and value is not False and operation.name in HANDLERS:
            if operation.metavar and value is True:
                raise CorrectionError(f"{operation.name} needs a value: {operation.metavar}. {operation.help}")
            HANDLERS[operation.name](plan, value, operations)
    return tuple(plan.corrections)


def _merge(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    names = BETWEEN.split(_text(value).strip())
    if len(names) != 2:
        raise CorrectionError(f"merge takes two parts: the first is merged into the second; found {_text(value)[:80]!r}")
    first, second = (named_part(plan.asset, name) for name in names)
    plan.add(MergeParts(first, second))
    plan.part = second if plan.part == first else plan.part


def _new_part(plan: CorrectionPlan, value: Any, operations: Mapping[str, Any]) -> None:
    region, faces = operations.get("region"), operations.get("faces")
    if (region is None) == (faces is None):
        raise CorrectionError("a new part needs the numbers of its regions, or those of its faces")
    if faces is not None:
        chosen = FaceSet.of(_numbers(faces, "face", len(plan.asset.mesh.faces) - 1, 0))
    else:
        groups = regions_of(plan.asset, plan.name)
        chosen = FaceSet.of(np.concatenate([groups[k - 1] for k in _numbers(region, "region", len(groups), 1)]))
    name = str(value)
    label = re.sub(r"_\d+$", "", name)
    plan.add(SplitPart(plan.name, chosen, name, label))
    plan.part = plan.asset.segmentation.parts[-1].name


def _only_with_new_part(_: CorrectionPlan, __: Any, operations: Mapping[str, Any]) -> None:
    if operations.get("new_part") is None:
        raise CorrectionError("regions and faces are those of a new part; also give the name of the new part")


def _numbers(value: Any, what: str, most: int, least: int) -> Int[np.ndarray, " n"]:
    """Parse numbers and runs of numbers such as 3,7-9, all within some limits."""
    runs = []
    for text in BETWEEN.split(_text(value).strip()):
        match = re.fullmatch(r"(\d{1,12})(?:-(\d{1,12}))?", text)
        low, high = (int(match[1]), int(match[2] or match[1])) if match else (-1, -1)
        if not least <= low <= high <= most:
            raise CorrectionError(f"{text[:40]!r} is no {what}; valid are {least} to {most}, and runs such as {least}-{most}")
        runs.append(np.arange(low, high + 1))
    return np.concatenate(runs)


def _parent(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    parent = named_part(plan.asset, _text(value))
    if plan.joint.parent != parent:
        plan.add(ChangeParent(plan.name, parent))


def _motion(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    motions = ranked_motions(plan.asset, plan.name)
    text = _text(value)
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= len(motions)):
        rows = [f"{k} ({words})" for k, words in enumerate(told_apart(plan.asset, motions), 1)]
        valid = f"valid are {', '.join(rows)}" if rows else "nothing is free to move; set type, axis and limits instead"
        raise CorrectionError(f"{plan.name!r} has no motion {text[:40]!r}; {valid}")
    plan.add(motions[int(text) - 1])


def _type(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    type_ = TYPES.get(_text(value).strip().lower())
    if type_ is None:
        raise CorrectionError(f"{_text(value)[:40]!r} is not a type of joint; valid are {', '.join(JointType)}")
    if type_ == JointType.SCREW and plan.joint.type is not JointType.SCREW:
        raise CorrectionError("a screw needs the length by which it moves in a turn: give screw instead of type, such as 3mm")
    if plan.joint.type is not JointType(type_):
        plan.add(ChangeType(plan.name, JointType(type_)))


def _axis(plan: CorrectionPlan, value: Any, operations: Mapping[str, Any]) -> None:
    through = operations.get("through")
    origin = plan.joint.origin if through is None else _point(through)
    plan.add(SetAxis(plan.name, vector(axis_of(value)), vector(origin)))


def _through(plan: CorrectionPlan, value: Any, operations: Mapping[str, Any]) -> None:
    if operations.get("axis") is None:
        plan.add(SetAxis(plan.name, vector(plan.joint.axis), vector(_point(value)), "through a point"))


def _point(value: Any) -> Float[np.ndarray, " 3"]:
    return _triple(value, "a point", "three lengths such as 0.3,0,50cm", "m")


def _limits(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    plan.add(SetLimits(plan.name, *limits_of(value, plan.joint.type, plan.asset.mesh.diagonal)))


def _screw(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    plan.add(SetScrew(plan.name, quantity(_text(value), JointType.PRISMATIC)))


def _mimic(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    leader, *ratio = BETWEEN.split(_text(value).strip())
    if leader == NONE:
        plan.add(SetMimic(plan.name, None))
        return
    match = QUANTITY.fullmatch(ratio[0]) if len(ratio) == 1 else None
    if ratio and (match is None or match[2]):
        raise CorrectionError(f"mimic takes the part that leads, and a ratio such as -0.5; found {_text(value)[:80]!r}")
    plan.add(SetMimic(plan.name, named_part(plan.asset, leader), float(match[1]) if match else 1.0))


def _loop(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    other, *rest = BETWEEN.split(_text(value).strip())
    if other == NONE:
        plan.add(SetLoop(plan.name, None))
        return
    kind = TYPES.get(rest[3]) if len(rest) == 4 else "revolute"
    if len(rest) not in (3, 4) or kind not in LOOP_KINDS:
        valid = f"another part, a point, and one of {', '.join(LOOP_KINDS)}, such as lid,0.3,0,50cm,revolute"
        raise CorrectionError(f"{_text(value)[:80]!r} is no loop; valid is {valid}")
    plan.add(SetLoop(plan.name, named_part(plan.asset, other), vector(_point(rest[:3])), JointType(kind)))


def _press(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    travel = abs(limits_of(value, JointType.PRISMATIC, plan.asset.mesh.diagonal)[1])
    slides = plan.joint.type is JointType.PRISMATIC
    axis = inwards(plan.asset, plan.name, plan.joint.axis if slides else None)
    if not travel > 0:
        raise CorrectionError(f"a part is pushed in by more than 0, found {_text(value)[:40]!r}")
    motion = ChooseMotion(
        plan.name, JointType.PRISMATIC, vector(axis), vector(plan.joint.origin), (0.0, travel), 1.0, "pushed in"
    )
    plan.add(motion)


def inwards(asset: Asset, part: str, axis: Float[np.ndarray, " 3"] | None) -> Float[np.ndarray, " 3"]:
    """Return the direction into the object, of both along an axis, or of all along x, y and z if it is None.

    Opposite to the one in which most of the part's surface sees the open, and least of it the other way.
    """
    mine = asset.segmentation.face_part == part_number(asset, part)
    points = sample_surface(asset.mesh.triangles[mine], 400, 0).points
    rest = RayScene(asset.mesh.vertices, asset.mesh.faces[~mine])
    ways = np.concatenate([np.eye(3), -np.eye(3)]) if axis is None else np.stack([axis, -axis])
    opposite = {k: (k + len(ways) // 2) % len(ways) for k in range(len(ways))}
    seen = [float(np.isinf(rest.first_hit(points, np.tile(way, (len(points), 1))).distance).mean()) for way in ways]
    return ways[max(opposite, key=lambda k: seen[opposite[k]] - seen[k])]


def _accept(plan: CorrectionPlan, _: Any, __: Mapping[str, Any]) -> None:
    if plan.joint.confidence == 1:
        raise CorrectionError(f"{plan.name!r} is no proposal: its joint is certain, and is written")
    plan.add(Confirm(plan.name))


def _copies(plan: CorrectionPlan, _: Any, operations: Mapping[str, Any]) -> None:
    if not operations.get("remove"):
        plan.add(*same_for_copies(plan.asset, plan.name))


def _remove(plan: CorrectionPlan, _: Any, operations: Mapping[str, Any]) -> None:
    copies = copies_of(plan.asset, plan.name, regions=False) if operations.get("copies") else ()
    plan.add(RemovePart(plan.name), *(RemovePart(copy.part) for copy in copies))
    plan.part = None


def _label(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    if plan.asset.segmentation.parts[part_number(plan.asset, plan.name)].label != _text(value).strip():
        plan.add(Relabel(plan.name, _text(value)))


def _rename(plan: CorrectionPlan, value: Any, _: Mapping[str, Any]) -> None:
    name = _text(value)
    if name != plan.name:
        plan.add(Rename(plan.name, name))
        plan.part = name


HANDLERS: dict[str, Callable[[CorrectionPlan, Any, Mapping[str, Any]], None]] = {
    "merge": _merge,
    "split": lambda plan, _, __: plan.add(SplitComponents(plan.name)),
    "new_part": _new_part,
    "region": _only_with_new_part,
    "faces": _only_with_new_part,
    "parent": _parent,
    "motion": _motion,
    "type": _type,
    "axis": _axis,
    "through": _through,
    "flip": lambda plan, _, __: plan.add(FlipSign(plan.name)),
    "limits": _limits,
    "screw": _screw,
    "mimic": _mimic,
    "loop": _loop,
    "press": _press,
    "label": _label,
    "rename": _rename,
    "right": lambda plan, _, __: plan.add(Confirm(plan.name)),
    "accept": _accept,
    "copies": _copies,
    "remove": _remove,
}
"""One function per operation; each adds corrections to a plan."""
