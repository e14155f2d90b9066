"""Objects of many kinds with known joints, made to vary: furniture, doors, appliances, vehicles, machines, tools, robots.

python benchmarks/kinds.py FOLDER [--seed 0] [--count 2] [--test | --untrained | --reserved] [KIND ...]
writes FOLDER/KIND-NN/KIND-NN.urdf with meshes; the kinds are listed in kinds.toml
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from zlib import crc32

import numpy as np
from kinds_model import Model, left_by_an_artist, write_urdf

Kinds = dict[str, Callable[[Model], None]]


def _named(section: str) -> Kinds:
    """Return the functions that build the kinds of a section of kinds.toml, from the module kinds_FAMILY of each family."""
    families = tomllib.loads((Path(__file__).parent / "kinds.toml").read_text(encoding="utf-8"))[section]
    return {
        name: getattr(import_module(f"kinds_{family}"), name) for family, names in families.items() for name in names.split()
    }


KINDS, TEST, UNTRAINED, RESERVED = map(_named, ("train", "test", "untrained", "reserved"))
ALL = KINDS | TEST | UNTRAINED | RESERVED


def build(kind: str, seed: int, number: int) -> Model:
    """Object `number` of a kind; the same for the same seed."""
    model = Model(np.random.default_rng([seed, crc32(kind.encode()), number]))
    ALL[kind](model)
    return left_by_an_artist(model)


def write(kind: str, seed: int, number: int, folder: Path) -> Path:
    """Builds one object and writes it; returns its URDF."""
    name = f"{kind}-{number:02d}"
    return write_urdf(build(kind, seed, number), name, folder / name, ("obj", "stl")[number % 2])


def main() -> None:
    parser = argparse.ArgumentParser(description="Objects of many kinds with known joints.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("kinds", nargs="*", help="kinds; those for training when none is named")
    parser.add_argument("--seed", type=int, default=0, help="of everything that varies")
    parser.add_argument("--count", type=int, default=2, help="objects of each kind")
    parser.add_argument("--test", action="store_true", help="the kinds that are measured after each training")
    parser.add_argument("--untrained", action="store_true", help="the kinds that were written after the shipped classifiers")
    parser.add_argument("--reserved", action="store_true", help="the reserved kinds, which nothing is trained or tuned on")
    options = parser.parse_intermixed_args()
    if unknown := sorted(set(options.kinds) - set(ALL)):
        parser.error(f"kinds: found {', '.join(unknown)}; valid are {', '.join(sorted(ALL))}")
    chosen = RESERVED if options.reserved else UNTRAINED if options.untrained else TEST if options.test else KINDS
    for kind in options.kinds or chosen:
        for number in range(options.count):
            print(write(kind, options.seed, number, options.folder))


if __name__ == "__main__":
    main()
