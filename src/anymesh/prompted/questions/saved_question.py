"""Conversion of a question to bytes and back, so that an answer can be checked in another process.

The fields of a question besides its pictures (tables, regions, labels) are written as JSON with separate arrays. Only frozen
dataclasses and enums of this package's own questions and types are read back, so a file cannot refer to other code.
"""

from __future__ import annotations

import importlib
import io
import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.types import Picture
from anymesh.types.questions import Question

HOMES = ("anymesh.prompted.questions.", "anymesh.types.", "anymesh.geometry.")
SAVED_NAMES = {  # modules whose name in files stays that of the first version, so that files of all versions can be read
    "anymesh.prompted.questions.grounding": "anymesh.reasoning.grounding",
    "anymesh.prompted.questions.prompting": "anymesh.reasoning.prompting",
    "anymesh.prompted.questions.motion_choice": "anymesh.reasoning.prompting",
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
    """Write a question without its pictures.

    Raise TypeError for a field that cannot be written.
    """
    arrays: dict[str, np.ndarray] = {}
    values = {f.name: _pack(getattr(question, f.name), arrays) for f in _fields(question) if f.name != "pictures"}
    record = {"class": _name(type(question)), "fields": values}
    buffer = io.BytesIO()
    arrays[RECORD] = np.frombuffer(json.dumps(record).encode(), np.uint8)
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def unpack_question(content: bytes, pictures: tuple[Picture, ...]) -> Question[Any]:
    """Read a question with its pictures.

    Raise InputError for bytes that are no question, or from another version.
    """
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
