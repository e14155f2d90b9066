"""Objects of many kinds with known joints, made to vary: aircraft, doors, windows, furniture, household things.

python benchmarks/kinds.py FOLDER [--seed 0] [--count 2] [KIND ...]      writes FOLDER/KIND-NN/KIND-NN.urdf with meshes
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from zlib import crc32

import kinds_aircraft
import kinds_cabinets
import kinds_doors
import kinds_flying
import kinds_furniture
import kinds_things
import kinds_tools
import kinds_windows
import numpy as np
from kinds_model import Model, left_by_an_artist, write_urdf

FAMILIES = {
    kinds_aircraft: "light_aircraft jet glider",
    kinds_flying: "wing_panel moving_fins helicopter",
    kinds_doors: "hinged_door double_door arched_door stable_door patio_door bifold_door garage_door gate cat_flap "
    "revolving_door",
    kinds_windows: "casement awning hopper double_casement hung_window sliding_window shutters roof_window louvres",
    kinds_cabinets: "wardrobe sideboard secretary drawer_unit",
    kinds_furniture: "chest piano office_chair leaf_table bed",
    kinds_things: "washer toilet trash_can laptop mailbox safe",
    kinds_tools: "desk_lamp scissors stapler suitcase tool_box folding_chair",
}
KINDS: dict[str, Callable[[Model], None]] = {
    name: getattr(family, name) for family, names in FAMILIES.items() for name in names.split()
}


def build(kind: str, seed: int, number: int) -> Model:
    """Object `number` of a kind; the same for the same seed."""
    model = Model(np.random.default_rng([seed, crc32(kind.encode()), number]))
    KINDS[kind](model)
    return left_by_an_artist(model)


def write(kind: str, seed: int, number: int, folder: Path) -> Path:
    """Builds one object and writes it; returns its URDF."""
    name = f"{kind}-{number:02d}"
    return write_urdf(build(kind, seed, number), name, folder / name, ("obj", "stl")[number % 2])


def main() -> None:
    parser = argparse.ArgumentParser(description="Objects of many kinds with known joints.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("kinds", nargs="*", help="kinds; all when none is named")
    parser.add_argument("--seed", type=int, default=0, help="of everything that varies")
    parser.add_argument("--count", type=int, default=2, help="objects of each kind")
    options = parser.parse_args()
    if unknown := sorted(set(options.kinds) - set(KINDS)):
        parser.error(f"kinds: found {', '.join(unknown)}; valid are {', '.join(sorted(KINDS))}")
    for kind in options.kinds or KINDS:
        for number in range(options.count):
            print(write(kind, options.seed, number, options.folder))


if __name__ == "__main__":
    main()
