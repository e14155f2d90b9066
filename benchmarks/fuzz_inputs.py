"""The cases of a run: generated scenes, fixtures, mesh files in folders, objects of data sets."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.evaluation.datasets.named import open_dataset
from anymesh.loading.files import FORMATS
from benchmarks.fuzz_scenes import FIXTURES

Case = dict[str, Any]
GIVEN = ("nodes", "labels")
CHECKED, TWICE = 4, 10  # one case in as many is held against the output contract, and run twice


def _cases(name: str, number: int, ways: Sequence[str], **source: object) -> Iterator[Case]:
    for way in ways:
        yield {
            "key": f"{name} {way}",
            "parts": way,
            "check": number % CHECKED == 0,
            "twice": number % TWICE == 1,
            **source,
        }


def scene_cases(first: int, count: int) -> Iterator[Case]:
    """Each scene with its parts found, and given as nodes or as face labels by turns; every fixture with nodes given, too."""
    for name in FIXTURES if count and first == 0 else ():
        yield from _cases(f"fixture: {name}", 2, ("auto", "nodes"), scene=name)
    for seed in range(first, first + count):
        yield from _cases(f"scene {seed:05d}", seed, ("auto", GIVEN[seed % 2]), scene=seed)


def mesh_cases(place: Path, work: Path, most: int | None) -> Iterator[Case]:
    """Every mesh file of a folder or archive; at most `most`, spread from the smallest to the largest."""
    folder = _unpacked(place, work) if place.is_file() else place
    found = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix.lower() in FORMATS)
    for number, path in enumerate(_spread(found, most)):
        name = f"{place.stem}/{path.relative_to(folder)}"
        yield from _cases(name, number, ("auto", "nodes") if number % 3 == 0 else ("auto",), mesh=str(path))


def _unpacked(archive: Path, work: Path) -> Path:
    folder = work / "unpacked" / archive.stem
    if not folder.is_dir():
        with zipfile.ZipFile(archive) as packed:
            packed.extractall(folder)
    return folder


def _spread(paths: list[Path], most: int | None) -> list[Path]:
    if most is None or len(paths) <= most:
        return paths
    order = sorted(paths, key=lambda p: (p.stat().st_size, p))
    return [order[k] for k in np.linspace(0, len(order) - 1, most).round().astype(int)]


def set_cases(spec: str, work: Path) -> Iterator[Case]:
    """Every object of a data set as `anymesh eval` names it, its parts found and given."""
    source = open_dataset(spec)
    for number, name in enumerate(source.objects()):
        folder = work / "sets" / source.name / name
        folder.mkdir(parents=True, exist_ok=True)
        labels = folder / "labels.npy"
        truth = source.truth(name, folder)
        np.save(labels, truth.labels)
        for way in ("auto", str(labels)):
            parts = "auto" if way == "auto" else "given"
            yield from (
                {**c, "key": f"{source.name}: {name} {parts}"} for c in _cases("", number, (way,), mesh=str(truth.mesh))
            )
