"""Records of evaluated objects, stored as JSON."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields, is_dataclass
from enum import Enum
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from anymesh.evaluation.score import ObjectScore


@dataclass(frozen=True)
class Record:
    """Result of one object under one change. With an `error`, the score counts every joint as missing."""

    score: ObjectScore
    category: str = "object"
    change: str = "none"
    seconds: float = 0.0  # of both stages
    error: str = ""
    pictures: tuple[tuple[str, str], ...] = ()  # (part, path relative to the report's folder) of joints with errors

    @property
    def title(self) -> str:
        """The object and the change."""
        return self.score.name if self.change == "none" else f"{self.score.name} ({self.change})"


def record_text(record: Record) -> str:
    """Convert a record to one line of JSON. Raise ValueError for numbers that are not finite."""
    return json.dumps(asdict(record), allow_nan=False)


def record_of(text: str) -> Record:
    """Parse the text of `record_text`. Raise ValueError if it is not valid."""
    return _read(Record, json.loads(text, parse_constant=_refuse), "record")


def _read(kind: Any, value: Any, where: str) -> Any:
    """Convert a JSON value to its annotated type: a dataclass, tuple, enum, plain value or a union."""
    if is_dataclass(kind) and isinstance(kind, type):
        return _read_fields(kind, value, where)
    if get_origin(kind) is tuple:
        inner = get_args(kind)
        count = len(value) if isinstance(value, list) else -1
        kinds = [inner[0]] * count if inner[-1] is Ellipsis else list(inner)
        if count != len(kinds):
            raise ValueError(f"{where}: expected a list as {kind}, found {value!r}")
        return tuple(_read(k, v, f"{where}[{n}]") for n, (k, v) in enumerate(zip(kinds, value, strict=True)))
    if isinstance(kind, UnionType):
        return None if value is None else _read(next(k for k in get_args(kind) if k is not NoneType), value, where)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return kind(value)
    if kind is float and type(value) is int:
        return float(value)
    if type(value) is not kind:
        raise ValueError(f"{where}: expected {kind.__name__}, found {value!r}")
    return value


def _read_fields(kind: Any, value: Any, where: str) -> Any:
    names = {f.name for f in fields(kind)}
    if not isinstance(value, dict) or set(value) != names:
        raise ValueError(f"{where}: expected an object with {sorted(names)}, found {value!r:.200}")
    hints = get_type_hints(kind)
    return kind(**{name: _read(hints[name], value[name], f"{where}.{name}") for name in names})


def _refuse(constant: str) -> float:
    raise ValueError(f"expected finite numbers, found {constant}")
