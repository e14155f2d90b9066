"""Questions as bytes and answers as JSON objects, so that another process can check, show and correct an answer.

The fields of a question besides its pictures (tables, regions, labels) are written as JSON with separate arrays. Only frozen
dataclasses and enums of this package's own questions and types are read back, so a file cannot refer to other code.
"""

from __future__ import annotations

import importlib
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.prompted.questions.grounding import MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import (
    OTHER,
    JointAppearance,
    KindAnswer,
    MotionPick,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions
from anymesh.types import JointType, Picture
from anymesh.types.motion import Recognition, RecognizedLabel
from anymesh.types.questions import Question

HOMES = ("anymesh.prompted.questions.", "anymesh.types.", "anymesh.geometry.")
SAVED_NAMES = {  # modules whose name in files stays that of the first version, so that files of all versions can be read
    "anymesh.prompted.questions.grounding": "anymesh.reasoning.grounding",
    "anymesh.prompted.questions.prompting": "anymesh.reasoning.prompting",
    "anymesh.prompted.questions.recognition": "anymesh.reasoning.recognition",
}
RECORD = "record"  # name of the array with the JSON text
TAG = "is"  # field of a tagged value with its type
SAVED_CLASSES = {  # the same for classes
    "anymesh.types.motion:JointType": "anymesh.types.motion:MotionKind",
    "anymesh.reasoning.prompting:JointAppearance": "anymesh.reasoning.prompting:JointKind",
}
CLASSES = {saved: name for name, saved in SAVED_CLASSES.items()}
RENAMED = {("anymesh.types.motion:MotionKind", "TURN"): "REVOLUTE", ("anymesh.types.motion:MotionKind", "SLIDE"): "PRISMATIC"}
"""Enum members that files of earlier versions hold under another name."""


def pack_question(question: Question[Any]) -> bytes:
    """Write a question without its pictures. Raise TypeError for a field that cannot be written."""
    arrays: dict[str, np.ndarray] = {}
    values = {f.name: _pack(getattr(question, f.name), arrays) for f in _fields(question) if f.name != "pictures"}
    record = {"class": _name(type(question)), "fields": values}
    buffer = io.BytesIO()
    arrays[RECORD] = np.frombuffer(json.dumps(record).encode(), np.uint8)
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def unpack_question(content: bytes, pictures: tuple[Picture, ...]) -> Question[Any]:
    """Read a question with its pictures. Raise InputError for bytes that are no question, or from another version."""
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            arrays = dict(archive)
        record = json.loads(arrays[RECORD].tobytes())
        values = {name: _unpack(value, arrays) for name, value in record["fields"].items()}
        return _class(record["class"])(**values, pictures=pictures)
    except Exception as error:  # files of another version may raise any error
        raise InputError(
            f"the saved question cannot be read ({type(error).__name__}); ask it again with this version"
        ) from None


def _fields(value: Any) -> tuple[Any, ...]:
    if not is_dataclass(value):
        raise TypeError(f"a question must be a dataclass, found {type(value).__name__}")
    return tuple(f for f in fields(value) if f.init)


def _name(kind: type) -> str:
    if not kind.__module__.startswith(HOMES):
        raise TypeError(f"{kind.__module__}.{kind.__qualname__} is no type of a question")
    name = f"{SAVED_NAMES.get(kind.__module__, kind.__module__)}:{kind.__qualname__}"
    return SAVED_CLASSES.get(name, name)


def _class(name: str) -> Any:
    saved, _, cls = CLASSES.get(name, name).partition(":")
    names = [module for module, saved_name in SAVED_NAMES.items() if saved_name == saved] or [saved]
    if not all(module.startswith(HOMES) for module in names):
        raise ValueError(name)
    modules = [importlib.import_module(module) for module in names]
    kind = next((getattr(module, cls) for module in modules if hasattr(module, cls)), None)
    if not isinstance(kind, type) or not (is_dataclass(kind) or issubclass(kind, Enum)):
        raise ValueError(name)
    return kind


def _pack(value: Any, arrays: dict[str, np.ndarray]) -> Any:
    if isinstance(value, Enum):
        return {TAG: "enum", "class": _name(type(value)), "name": value.name}
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.ndarray | np.generic):
        name = f"a{len(arrays)}"
        arrays[name] = np.asarray(value)
        return {TAG: "array", "name": name}
    if isinstance(value, tuple | list | frozenset | set):
        kind = next(k for k in ("tuple", "list", "frozenset", "set") if type(value).__name__ == k)
        return {TAG: kind, "items": [_pack(v, arrays) for v in value]}
    if isinstance(value, Mapping):
        return {TAG: "dict", "items": [[_pack(k, arrays), _pack(v, arrays)] for k, v in value.items()]}
    packed = {f.name: _pack(getattr(value, f.name), arrays) for f in _fields(value)}
    return {TAG: "object", "class": _name(type(value)), "fields": packed}


def _unpack(value: Any, arrays: Mapping[str, np.ndarray]) -> Any:
    if not isinstance(value, dict):
        return value
    match value[TAG]:
        case "enum":
            return _class(value["class"])[RENAMED.get((value["class"], value["name"]), value["name"])]
        case "array":
            return arrays[value["name"]]
        case "object":
            return _class(value["class"])(**{name: _unpack(v, arrays) for name, v in value["fields"].items()})
        case "dict":
            return {_unpack(k, arrays): _unpack(v, arrays) for k, v in value["items"]}
        case kind:
            maker = {"tuple": tuple, "list": list, "frozenset": frozenset, "set": set}[kind]
            return maker(_unpack(v, arrays) for v in value["items"])


def answer_object(question: Question[Any], answer: Any) -> dict[str, Any]:
    """Return the object whose parse is this answer. Raise TypeError for an unknown kind of question."""
    match question:
        case Recognize():
            return _recognition(question, answer)
        case RecognizeRegions():
            regions = [{"region": k, "labels": []} for k in range(1, max(question.regions) + 1)]
            left = {r.label for r in answer}
            gone = [r.label for r in question.known if r.label not in left]
            return {"regions": regions, **_parts([_label(r) for r in answer]), "withdrawn": gone}
        case WhichViews():
            return _parts([{"label": label, "views": [v + 1 for v in views]} for label, views in answer.items()])
        case WhichMarks():
            return _marks(question, answer)
        case WhichKinds():
            return _parts([_kind(k, a, bool(question.labels)) for k, a in enumerate(answer, 1)])
        case WhichPoints():
            return _parts([{"part": k, "points": [row + 1 for row in rows]} for k, rows in enumerate(answer, 1)])
        case WhichArrows():
            return _parts([{"part": k, "arrow": row + 1} for k, row in enumerate(answer, 1)])
        case WhichMotions():
            return _parts([_motion(question, k, a) for k, a in enumerate(answer, 1)])
    raise TypeError(type(question).__name__)


def _parts(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    return {"parts": list(rows)}


def _marks(question: WhichMarks, answer: MarksAnswer) -> dict[str, Any]:
    rows = []
    for p in answer.parts:
        view = {} if question.consistent or p.view is None else {"view": p.view + 1}
        rows.append({"label": p.label, "instance": p.instance, **view, "marks": list(p.marks)})
    split = {"split": list(answer.split)} if question.splittable else {}
    return {**_parts(rows), "unsure": list(answer.unsure), **split}


def _kind(number: int, answer: KindAnswer, labelled: bool) -> dict[str, Any]:
    label = {"label": answer.label or OTHER} if labelled else {}
    return {"part": number, "joint": answer.kind.value, "endless": answer.endless, **label}


def _motion(question: WhichMotions, number: int, pick: MotionPick) -> dict[str, Any]:
    kind = _kind(number, pick.attached or KindAnswer(JointAppearance.FIXED), bool(question.labels)) if question.ask_kind else {}
    fit = {"part_is": pick.part.value} if question.ask_fit else {}
    coupled = {"with": 0 if pick.leader is None else pick.leader + 1} if question.ask_with else {}
    return {"part": number, "motion": 0 if pick.motion is None else pick.motion + 1, **kind, **fit, **coupled}


def _recognition(question: Recognize, answer: Recognition) -> dict[str, Any]:
    front = question.azimuths.index(answer.front) + 1 if answer.front in question.azimuths else 0
    labels = [_label(label) for label in answer.labels]
    object_ = {"category": answer.category, "longest_side_m": answer.size, "front": front, "machine": answer.machine}
    return {**object_, **_parts(labels)}


def _label(label: RecognizedLabel) -> dict[str, Any]:
    unit = np.pi / 180 if label.moves is JointType.REVOLUTE else 0.01
    lower, upper = (0.0, 0.0) if label.limits is None else (end / unit for end in label.limits)
    moves = None if label.moves is None else label.moves.value
    ends = {"lower": lower, "upper": upper, "count": label.count or 0}
    return {"label": label.label, "moves": moves, "parent": label.parent, **ends}
