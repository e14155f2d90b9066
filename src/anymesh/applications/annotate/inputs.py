"""The objects of a collection: a folder, a pattern, a table with options per object, or ids of Objaverse."""

from __future__ import annotations

import csv
import hashlib
import json
import logging
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from anymesh.errors import InputError, OptionError
from anymesh.loading.files import FORMATS
from anymesh.pipeline.options import KIND, FormatOptions, command_fields

log = logging.getLogger("anymesh")
OBJAVERSE = "objaverse:"  # prefix of the source of an object that is fetched by id
READABLE = 60  # characters of a name that are kept in its folder's name
DIGEST = 12  # hex digits that distinguish folders; with 48 bits, two of a million names collide with probability .002
# Options of single objects, and the types of their values in a table.
OPTIONS: dict[str, type] = {
    "parts": str, "up": str, "scale": str, "root": str, "animation": str,
    "category": str, "parts_list": str, "at_least": int, "seed": int, "time_limit": float,
    **{f.name: f.metadata[KIND] for f in command_fields(FormatOptions)},
}  # fmt: skip
TABLES = (".csv", ".parquet")
PATH, UID, NAME = "path", "uid", "name"  # columns of a table, beside OPTIONS
WILD = re.compile(r"[*?\[]")
HEX_UID = re.compile(r"[0-9a-f]{32}")
ANY_FOLDERS = "(?:[^/]+/)*"  # `**/` as a regular expression


@dataclass(frozen=True)
class ObjectRequest:
    """An object. name: unique in its collection; source: path of the mesh, or `objaverse:UID`; options: its own, of OPTIONS.

    refusal: why it cannot be attempted, "" if it can; size: [bytes] and modified: [ns], to detect changes of the file.
    """

    name: str
    source: str
    options: Mapping[str, Any] = field(default_factory=dict)
    refusal: str = ""
    size: int = 0
    modified: int = 0

    @property
    def folder(self) -> str:
        """Relative folder of the object in the output: readable, legal on every system, and unique by a digest."""
        return object_folder(self.name)

    @property
    def options_text(self) -> str:
        """The options as JSON, identical for equal options."""
        return json.dumps(dict(self.options), sort_keys=True)


def object_folder(name: str) -> str:
    """Return the relative folder of an object's output, in one of 256 folders to limit their sizes."""
    digest = hashlib.sha256(name.encode("utf-8", "surrogateescape")).hexdigest()[:DIGEST]
    readable = re.sub(r"[^A-Za-z0-9_-]+", "_", PurePosixPath(name).stem).strip("_-")[:READABLE] or "object"
    return f"objects/{digest[:2]}/{readable}-{digest}"


def find_objects(spec: str, *, without: Path) -> Iterator[ObjectRequest]:
    """Yield the objects that INPUT names, in a fixed order, without the folder `without` (the output).

    Each folder is read once. Raise InputError if nothing is found or a table is not valid, OptionError for invalid ids.
    """
    if spec.startswith(OBJAVERSE):
        yield from _objaverse(spec.removeprefix(OBJAVERSE))
        return
    path = Path(spec)
    if path.is_dir():
        requests = _files(path, (p for p in walk(path, without) if p.suffix.lower() in FORMATS))
    elif path.is_file():
        table = path.suffix.lower() in TABLES
        requests = (_with_file(r) for r in _table(path)) if table else _files(path.parent, [path])
    elif WILD.search(spec):
        requests = _files(*_matches(spec, without))
    else:
        raise InputError(f"found no {spec!r}; valid are a folder, a pattern, a table ({', '.join(TABLES)}), or objaverse:IDS")
    count = 0
    for count, request in enumerate(requests, 1):  # noqa: B007
        yield request
    if not count:
        raise InputError(f"{spec} holds no object; valid are files with {', '.join(FORMATS)}")


def walk(base: Path, without: Path | None = None) -> Iterator[Path]:
    """Yield all files below a folder in the order of their names, including linked folders, each real folder once.

    Unreadable folders and cyclic links are skipped with a warning. `without`: a folder to skip.
    """
    left_out = None if without is None else without.resolve()
    seen: set[tuple[int, int]] = set()
    waiting = [base]
    while waiting:
        folder = waiting.pop()
        try:
            status = folder.stat()
            entries = sorted(os.scandir(folder), key=lambda e: e.name)
        except OSError as error:
            log.warning("%s is left out: %s", folder, error.strerror)
            continue
        if (status.st_dev, status.st_ino) in seen or (left_out is not None and folder.resolve() == left_out):
            continue
        seen.add((status.st_dev, status.st_ino))
        inner = []
        for entry in entries:
            try:
                if entry.is_dir():
                    inner.append(folder / entry.name)
                elif entry.is_file():
                    yield folder / entry.name
            except OSError as error:
                log.warning("%s is left out: %s", entry.path, error.strerror)
        waiting += reversed(inner)


def _files(base: Path, paths: Iterable[Path]) -> Iterator[ObjectRequest]:
    """Return files as objects, named by their path relative to the base."""
    for path in paths:
        yield _with_file(ObjectRequest(path.relative_to(base).as_posix(), str(path.absolute())))


def _with_file(request: ObjectRequest) -> ObjectRequest:
    """Add the file's size and time to the request; mark it as refused if its name is not valid text or there is no file."""
    try:
        f"{request.name}{request.source}".encode()
    except UnicodeEncodeError:
        name = request.name.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
        return ObjectRequest(name, name, refusal="the name of the file is not valid UTF-8; rename it")
    if request.source.startswith(OBJAVERSE):
        return request
    try:
        status = Path(request.source).stat()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        return ObjectRequest(request.name, request.source, request.options, refusal=f"the file cannot be opened: {reason}")
    return ObjectRequest(request.name, request.source, request.options, size=status.st_size, modified=status.st_mtime_ns)


def _matches(pattern: str, without: Path) -> tuple[Path, Iterator[Path]]:
    """Return the folder before the first wildcard, and the matching files below it; `**` matches any folders."""
    parts = Path(pattern).parts
    fixed = next(k for k, part in enumerate(parts) if WILD.search(part))
    base = Path(*parts[:fixed]) if fixed else Path()
    if not base.is_dir():
        raise InputError(f"found no folder {str(base)!r}, where the pattern {pattern!r} begins")
    last = [".*"] if parts[-1] == "**" else [_part_regex(parts[-1])]
    regex = re.compile("/".join([*map(_part_regex, parts[fixed:-1]), *last]).replace(ANY_FOLDERS + "/", ANY_FOLDERS), re.S)
    return base, (p for p in walk(base, without) if p.suffix.lower() in FORMATS and regex.fullmatch(_below(p, base)))


def _below(path: Path, base: Path) -> str:
    return path.relative_to(base).as_posix()


def _part_regex(part: str) -> str:
    if part == "**":
        return ANY_FOLDERS
    tokens = re.findall(r"\[!?\]?[^\]]*\]|.", part, re.S)
    return "".join(_token_regex(token) for token in tokens)


def _token_regex(token: str) -> str:
    match token:
        case "*":
            return "[^/]*"
        case "?":
            return "[^/]"
        case _ if len(token) > 1:
            inner = token[1:-1].replace("\\", "\\\\").replace("[", "\\[").replace("^", "\\^")
            return f"[^/{inner[1:]}]" if inner.startswith("!") else f"[{inner}]"
        case _:
            return re.escape(token)


def _objaverse(text: str) -> Iterator[ObjectRequest]:
    """Yield objects by ids, separated by commas or one per line in a text file; meshes are fetched when processed."""
    path = Path(text)
    is_file = len(text) < 4096 and path.is_file()
    ids = [line.strip() for line in (path.read_text(encoding="utf-8").splitlines() if is_file else text.split(","))]
    ids = list(dict.fromkeys(i.removesuffix(".glb") for i in ids if i))
    wrong = [i for i in ids if not HEX_UID.fullmatch(i)]
    if wrong or not ids:
        raise OptionError(f"objaverse: found {(wrong or [text])[0][:80]!r}; valid are ids of 32 hexadecimal digits, or a file")
    yield from (ObjectRequest(i, f"{OBJAVERSE}{i}") for i in ids)


def _table(path: Path) -> Iterator[ObjectRequest]:
    """Yield the objects of a table, one per row.

    Columns: `path` (relative to the table's folder) or `uid` (of Objaverse), `name` (default: the path or id), and those of
    OPTIONS, where an empty cell is the default; others are ignored with a warning. Raise InputError for an invalid table.
    """
    rows = _csv_rows(path) if path.suffix.lower() == ".csv" else _parquet_rows(path)
    checked = False
    for number, row in enumerate(rows, 2):
        if not checked:
            checked = True
            _check_columns(path, row)
        yield _row_request(path, f"{path.name}, row {number}", row)


def _csv_rows(path: Path) -> Iterator[Mapping[str, str]]:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            for row in csv.DictReader(file, restkey=None):
                yield {str(k).strip(): v or "" for k, v in row.items() if k is not None and not isinstance(v, list)}
    except (csv.Error, UnicodeDecodeError) as error:
        raise InputError(f"{path.name} is not a valid CSV table in UTF-8: {error}") from None


def _parquet_rows(path: Path) -> Iterator[Mapping[str, str]]:
    from anymesh.applications.annotate.parquet_ import read_rows

    return read_rows(path)


def _check_columns(path: Path, row: Iterable[str]) -> None:
    names = set(row)
    if not names & {PATH, UID}:
        columns = ", ".join(sorted(names))[:200]
        raise InputError(f"{path.name}: found the columns {columns}; one of them must be `path` or `uid`")
    unknown = sorted(names - {PATH, UID, NAME, *OPTIONS})
    if unknown:
        log.warning("%s: the columns %s are ignored; options are %s", path.name, ", ".join(unknown)[:200], ", ".join(OPTIONS))


def _row_request(table: Path, where: str, row: Mapping[str, str]) -> ObjectRequest:
    uid, path = row.get(UID, "").strip(), row.get(PATH, "")
    if not (uid or path):
        raise InputError(f"{where}: found neither a path nor a uid")
    options = {k: _parsed(k, v, where) for k in OPTIONS if (v := row.get(k, "")) != ""}
    source = f"{OBJAVERSE}{uid}" if uid else str((table.parent / path).absolute())
    return ObjectRequest(row.get(NAME, "") or uid or path, source, options)


def _parsed(name: str, text: str, where: str) -> Any:
    """Parse the value of an option in a table's cell. Raise InputError if it is not valid."""
    try:
        return OPTIONS[name](text)
    except ValueError:
        kind = "an integer" if OPTIONS[name] is int else "a number"
        raise InputError(f"{where}: found {name} {text[:100]!r}; valid is {kind}") from None
