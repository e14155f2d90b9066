"""Measure objects of data sets in processes, one file per object: shared by `part_rows.py` and `motion_rows.py`."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Protocol

import numpy as np

from anymesh.evaluation.changes import changed, moved
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import EvalSample, prepared
from anymesh.geometry.boxes import straightening

WriteRows = Callable[[Path, EvalSample, str, str], None]  # file, object, source, form


class Rows(Protocol):
    """Rows of an object. source: its data set; form: change of its mesh, "" for none."""

    @property
    def source(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def form(self) -> str: ...


def called(rows: Rows) -> str:
    """Return the source and the form of an object, as in tables."""
    return f"{rows.source}, {rows.form}" if rows.form else rows.source


def kind_of(name: str, category: str) -> str:
    """The kind of an object: its category where the set states it, else its name up to the first dash."""
    return category if category != "object" else name.split("-")[0]


def nameless(sample: EvalSample) -> EvalSample:
    """Return the object without names of nodes and materials."""
    mesh = sample.mesh
    nodes = tuple(replace(n, name=f"node{k}") for k, n in enumerate(mesh.nodes))
    materials = tuple(replace(m, name=f"material{k}") for k, m in enumerate(mesh.materials))
    return replace(sample, mesh=replace(mesh, nodes=nodes, materials=materials))


def open_object(spec: str, name: str, form: str) -> EvalSample:
    """Return an object of a data set, nameless, in the given form and turned straight, with its true parts and joints."""
    with tempfile.TemporaryDirectory() as folder:
        sample = nameless(prepared(open_dataset(spec).truth(name, Path(folder))))
    sample = changed(form, sample) if form else sample
    return moved(sample, straightening(sample.mesh.face_normals, sample.mesh.face_areas))


def collect(write: WriteRows, spec: str, source: str, name: str, form: str, folder: Path) -> str:
    """Write the rows of one object; return a line about it, an empty one if the file exists."""
    path = folder / f"{source}{'+' + form if form else ''}--{name}.npz"
    if path.exists():
        return ""
    write(path, open_object(spec, name, form), source, form)
    return f"{source} {name} {form}"


def collect_all(description: str, write: WriteRows, argv: Sequence[str] | None) -> None:
    """Run a script that measures all objects of some data sets; print the error of an object that fails and go on."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("folder", type=Path)
    parser.add_argument("specs", nargs="+", metavar="SPEC")
    parser.add_argument("--change", default="", help="as for anymesh eval --changes")
    parser.add_argument("--most", type=int, default=10**6, help="objects of each set, evenly spread over it")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args(argv)
    options.folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(options.workers, get_context("spawn")) as workers:
        jobs = []
        for argument in options.specs:
            spec, _, source = argument.partition("@")
            names = list(open_dataset(spec).objects())
            if len(names) > options.most:
                names = [names[k] for k in np.linspace(0, len(names) - 1, options.most).astype(int)]
            source = source or spec.split(":")[0]
            jobs += [workers.submit(collect, write, spec, source, n, options.change, options.folder) for n in names]
        for job in jobs:
            try:
                if line := job.result():
                    print(line, flush=True)
            except Exception as error:
                print(f"{type(error).__name__}: {error}", flush=True)
