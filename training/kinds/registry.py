"""All kinds by name, and how one object of a kind is built and written."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from zlib import crc32

import numpy as np

from training.kinds.model import Model, left_by_an_artist, write_urdf

Kinds = dict[str, Callable[[Model], None]]


SECTIONS = tomllib.loads((Path(__file__).parent / "kinds.toml").read_text(encoding="utf-8"))


def subject_of(kind: str) -> str:
    """Return the subject of a kind, the folder of its module."""
    of = {k: subject for section in SECTIONS.values() for subject, families in section.items()
          for names in families.values() for k in names.split()}  # fmt: skip
    return of[kind]


def _named(section: str) -> Kinds:
    """Return the functions that build the kinds of a section of kinds.toml, from the module SUBJECT/FAMILY of each family."""
    subjects = SECTIONS[section]
    return {
        name: getattr(import_module(f"training.kinds.{subject}.{family}"), name)
        for subject, families in subjects.items()
        for family, names in families.items()
        for name in names.split()
    }


KINDS, TEST, RESERVED = map(_named, ("train", "test", "reserved"))
ALL = KINDS | TEST | RESERVED


def build(kind: str, seed: int, number: int) -> Model:
    """Object `number` of a kind; the same for the same seed."""
    model = Model(np.random.default_rng([seed, crc32(kind.encode()), number]))
    ALL[kind](model)
    return left_by_an_artist(model)


def write(kind: str, seed: int, number: int, folder: Path) -> Path:
    """Build one object and write it; return its URDF."""
    name = f"{kind}-{number:02d}"
    return write_urdf(build(kind, seed, number), name, folder / name, ("obj", "stl")[number % 2])
