"""Objects of many kinds with known joints: furniture, doors, appliances, vehicles, machines, tools, robots.

python -m training.kinds FOLDER [--seed 0] [--count 2] [--test | --reserved] [KIND ...]
writes FOLDER/KIND-NN/KIND-NN.urdf with meshes; the kinds are listed in kinds.toml
"""

from __future__ import annotations

import argparse
from pathlib import Path

from training.kinds.registry import ALL, KINDS, RESERVED, TEST, write


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m training.kinds", description="Objects of many kinds with known joints.")
    parser.add_argument("folder", type=Path, help="where they go")
    parser.add_argument("kinds", nargs="*", help="kinds; those for training when none is named")
    parser.add_argument("--seed", type=int, default=0, help="of everything that varies")
    parser.add_argument("--count", type=int, default=2, help="objects of each kind")
    parser.add_argument("--test", action="store_true", help="the kinds that are measured after each training")
    parser.add_argument("--reserved", action="store_true", help="the reserved kinds, which nothing is trained or tuned on")
    options = parser.parse_intermixed_args()
    if unknown := sorted(set(options.kinds) - set(ALL)):
        parser.error(f"kinds: found {', '.join(unknown)}; valid are {', '.join(sorted(ALL))}")
    chosen = RESERVED if options.reserved else TEST if options.test else KINDS
    for kind in options.kinds or chosen:
        for number in range(options.count):
            print(write(kind, options.seed, number, options.folder))


if __name__ == "__main__":
    main()
