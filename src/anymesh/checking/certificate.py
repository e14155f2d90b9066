"""Certificates: one file that binds every byte of an asset to what was checked, by which engines and rules, with which figures.

It is no signature: who can write the asset can certify it anew. It states no time and no path of a machine.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from importlib import resources
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import anymesh
from anymesh.checking.check import check_asset
from anymesh.checking.engines.locate import MJCF, find_description, find_file, kind_of
from anymesh.checking.engines.mjcf_ import read_mjcf
from anymesh.checking.engines.robot import read_urdf
from anymesh.checking.report import CheckReport
from anymesh.errors import InputError
from anymesh.runtime import read_json, write_whole

NAME = "certificate.json"
UNBOUND = (NAME, "timing.json")  # the second differs from run to run
STAGES = "stages"  # a folder that zips of an asset leave out; if it is there, its files are bound too
MAX_FILES, MAX_BYTES = 20_000, 1 << 26  # files that one certificate binds, and bytes of a certificate
LIBRARIES = ("mujoco", "numpy", "scipy")  # whose versions figures depend on, beside the engines


def certify(path: str | Path, *, engines: Sequence[str] = ("mujoco",)) -> tuple[CheckReport, Path | None]:
    """Check an asset, and write its certificate beside its description if it passes; return the report and the certificate.

    Raise InputError as `check_asset`, and if there are more than MAX_FILES files, or links that lead out of the folder.
    """
    report = check_asset(path, engines=engines)
    if not report.ok:
        return report, None
    place = find_description(Path(path)).parent / NAME
    write_whole(place, _text(_record(Path(path), report, engines)).encode())
    return report, place


def verify(path: str | Path) -> tuple[list[str], str]:
    """Return what contradicts the certificate of an asset, empty if it holds, and in words what was verified.

    All bytes are compared; the check is run again if its rules and libraries are those of the certificate.

    Raise InputError if there is no certificate.
    """
    description = find_description(Path(path))
    place = description.parent / NAME
    if not place.is_file() or place.stat().st_size > MAX_BYTES:
        raise InputError(f"{place} is not there, or too large; `anymesh check {path} --certificate` writes one")
    record = read_json(place) or {}
    if place.read_bytes() != _text(record).encode() or not isinstance(record.get("files"), dict):
        return [f"{NAME} was changed: it does not match its own sha256"], ""
    problems = list(_different(record["files"], bound_files(description)))
    problems += [] if record.get("description") == description.name else [f"it is of {record.get('description')}"]
    words = f"{len(record['files'])} files, {record['failures']} failures, {record['warnings']} warnings"
    if problems:
        return problems, words
    if record["rules"] != _rules() or record["libraries"] != _libraries():
        return [], f"{words}; not checked again, since rules or libraries differ from those here"
    engines = record["engines"]["asked"]
    again = _record(Path(path), check_asset(path, engines=engines), engines)
    if again["engines"] != record["engines"]:
        return [], f"{words}; not checked again, since the engines here are {', '.join(again['engines']['ran']) or 'none'}"
    changed = [key for key in record if key not in ("sha256",) and record[key] != again.get(key)]
    return [f"the check gives other {key} than the certificate states" for key in changed], f"{words}; checked again"


def bound_files(description: Path) -> dict[str, str]:
    """Return the sha256 of each file of an asset by its path, relative to the description's folder.

    Bound are all files below that folder, and below the folders of meshes elsewhere; hidden ones and UNBOUND are not.
    """
    folder = description.parent
    places = {folder.resolve(): folder}
    robot = read_mjcf(description) if kind_of(description) == MJCF else read_urdf(description)
    for shape in (s for link in robot.links for s in (*link.visuals, *link.collisions)):
        mesh = None if shape.file is None else find_file(shape.file, folder)
        if mesh is not None and not mesh.resolve().is_relative_to(folder.resolve()):
            places[mesh.resolve().parent] = mesh.parent
    digests: dict[str, str] = {}
    for real in places:
        for file in _files(real):
            name = Path(os.path.relpath(file, folder.resolve())).as_posix()
            if name not in UNBOUND:
                digests[name] = _digest(file, real)
            if len(digests) > MAX_FILES:
                raise InputError(f"{folder} holds over {MAX_FILES} files; valid is the folder of one asset")
    return dict(sorted(digests.items()))


def _files(folder: Path) -> Iterator[Path]:
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield from (Path(place, name) for name in sorted(files) if not name.startswith("."))


def _digest(file: Path, folder: Path) -> str:
    if not file.is_file() or not file.resolve().is_relative_to(folder):
        raise InputError(
            f"{file.name} is no plain file in {folder.name}, or a link that leads out of it, and cannot be certified"
        )
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()


def _different(stated: Mapping[str, str], found: Mapping[str, str]) -> Iterator[str]:
    zipped = not any(name.startswith(f"{STAGES}/") for name in found)
    for name in sorted({*stated, *found}):
        if name not in found and not (zipped and name.startswith(f"{STAGES}/")):
            yield f"{name} is missing"
        elif name not in stated:
            yield f"{name} was added"
        elif name in found and stated[name] != found[name]:
            yield f"{name} was changed"


def _rules() -> dict[str, str]:
    """Return the version of the checks, and a digest of the code and data that decide."""
    digest = hashlib.sha256()
    for package in ("checking", "checking/engines", "export", "geometry", "kinds", "physics", "formats"):
        for file in sorted(resources.files("anymesh").joinpath(package).iterdir(), key=lambda f: f.name):
            if file.name.endswith((".py", ".json")):
                digest.update(f"{package}/{file.name}\0".encode() + file.read_bytes())
    return {"articulate-anymesh": anymesh.__version__, "sha256": digest.hexdigest()}


def _libraries() -> dict[str, str]:
    versions = {}
    for name in LIBRARIES:
        try:
            versions[name] = version(name)
        except PackageNotFoundError:
            continue
    return versions


def _record(path: Path, report: CheckReport, engines: Sequence[str]) -> dict[str, Any]:
    description = find_description(path)
    values = report.as_json()
    sweeps = values.pop("sweeps")
    text = json.dumps({"findings": values["findings"], "figures": sweeps})
    for place in (str(description.parent.resolve()), str(description.parent)):  # no path of this machine
        text = text.replace(json.dumps(place)[1:-1], ".") if len(place) > 1 else text
    return {
        "certificate": 1,
        "description": description.name,
        "rules": _rules(),
        "libraries": _libraries(),
        "engines": {"asked": [*engines], "ran": [sweep["engine"] for sweep in sweeps]},
        "failures": values["failures"],
        "warnings": values["warnings"],
        **json.loads(text),
        "files": bound_files(description),
    }


def _text(record: Mapping[str, Any]) -> str:
    """Return the text of a record with its own sha256 at the end."""
    content = {key: value for key, value in record.items() if key != "sha256"}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    return json.dumps({**content, "sha256": digest}, indent=1) + "\n"
