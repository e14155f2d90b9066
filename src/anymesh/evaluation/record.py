"""Records of an evaluation, their folder (so that a stopped evaluation can be resumed), and the worst joints among them."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from anymesh.errors import OutputError
from anymesh.evaluation.score import MIN_MATCH_IOU, JointScore, ObjectScore
from anymesh.runtime import read_json, write_json, writing

SETTINGS = "eval.json"
OBJECTS = "objects"  # folder with one file per object and one line per record
GENERATOR = "articulate-anymesh eval"
NEW = ("date", "python", "numpy", "machine")  # settings that may differ when an evaluation is resumed
STAYS = 0.25  # share of its size: approximate displacement of a missing part at an opening of 30 degrees


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


@dataclass(frozen=True)
class ResultsFolder:
    """Records by object. `settings` are those with which the evaluation started."""

    folder: Path
    settings: Mapping[str, str]

    @classmethod
    def open(cls, folder: Path, settings: Mapping[str, str], *, force: bool = False) -> ResultsFolder:
        """Open a new folder, or one started with the same settings; `force` starts again.

        Raise OutputError if the folder holds anything else, or an evaluation with other settings.
        """
        with writing(folder):
            return cls._open(Path(folder), settings, force)

    @classmethod
    def _open(cls, folder: Path, settings: Mapping[str, str], force: bool) -> ResultsFolder:
        begun = read_json(folder / SETTINGS) if folder.is_dir() else None
        ours = begun is not None and begun.get("generator") == GENERATOR
        if not ours and folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise OutputError(f"{folder} is not empty and not an evaluation of anymesh; choose another folder")
        kept = {k: v for k, v in (begun or {}).items() if k != "generator"}
        differing = sorted(k for k in {*kept, *settings} - {*NEW} if kept.get(k) != settings.get(k))
        if ours and differing and not force:
            pairs = ", ".join(f"{k}: {kept.get(k, '-')} (now {settings.get(k, '-')})" for k in differing)
            raise OutputError(f"{folder} holds an evaluation with other settings: {pairs}; choose another folder, or --force")
        if ours and not force:
            return cls(folder, kept)
        for name in (OBJECTS, "pictures"):
            shutil.rmtree(folder / name, ignore_errors=True)
        (folder / OBJECTS).mkdir(parents=True)
        write_json(folder / SETTINGS, {"generator": GENERATOR, **settings})
        return cls(folder, dict(settings))

    def save(self, name: str, records: Sequence[Record]) -> None:
        """Write all records of an object atomically."""
        path = self._path(name)
        part = path.with_suffix(".part")
        part.write_text("".join(f"{record_text(r)}\n" for r in records), encoding="utf-8")
        part.replace(path)

    def load(self, name: str) -> list[Record]:
        """Read all records of an object; none if it was not evaluated yet, or if its file is damaged."""
        try:
            return [record_of(line) for line in self._path(name).read_text(encoding="utf-8").splitlines()]
        except (OSError, ValueError):
            return []

    def has(self, name: str) -> bool:
        """Return whether an object was evaluated without an error; objects with errors are evaluated again."""
        records = self.load(name)
        return bool(records) and not any(r.error for r in records)

    def _path(self, name: str) -> Path:
        return self.folder / OBJECTS / f"{name}.jsonl"


@dataclass(frozen=True)
class Off:
    """A joint with errors, and its picture."""

    record: Record
    joint: JointScore
    picture: str  # path relative to the report's folder

    @property
    def title(self) -> str:
        """The object and the part."""
        return f"{self.record.title} / {self.joint.part}"


def badness(joint: JointScore) -> float:
    """Return the displacement of the part's points when opened, or an estimate if it was not found."""
    return STAYS * joint.part_size if joint.displacement is None else joint.displacement


def worst(records: Sequence[Record], count: int) -> list[Off]:
    """Return the worst joints among those that were drawn.

    The same joint under another change, and further missing joints of the same object, come last, since they seldom show
    anything new.
    """
    seen: Counter[tuple[str, str]] = Counter()
    ranked = []
    for off in sorted(_drawn(records), key=lambda o: -badness(o.joint)):
        key = off.record.score.name, "" if off.joint.type_found is None else off.joint.part
        ranked.append((seen[key], off))
        seen[key] += 1
    return [off for _, off in sorted(ranked, key=lambda r: r[0])][:count]


def what_is_off(j: JointScore) -> str:
    """Describe the errors of a joint in one line."""
    if j.type_found is None:
        parts = f"nearest part has IoU {j.iou:.2f}" if j.iou < MIN_MATCH_IOU else "its part has no joint"
        return f"{j.type_true}, not found: {parts}" if j.iou else f"{j.type_true}, not found"
    errors = [f"{j.type_found} instead of {j.type_true}" if not j.type_right else str(j.type_true)]
    errors += [] if j.angle is None else [f"angle {j.angle:.1f} deg"]
    errors += [] if j.at_part is None else [f"line off {j.at_part:.3f}"]
    errors += [] if j.displacement is None else [f"points off {j.displacement:.3f}"]
    errors += ["opens the wrong way"] if j.opens_right is False and j.type_right else []
    errors += [] if j.range_iou is None else [f"range IoU {j.range_iou:.2f}"]
    errors += ["wrong parent"] if j.parent_right is False else []
    return ", ".join(errors)


def _drawn(records: Sequence[Record]) -> Iterator[Off]:
    for record in records:
        joints = {j.part: j for j in record.score.joints}
        for part, path in record.pictures:
            yield Off(record, joints[part], path)
