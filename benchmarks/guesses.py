"""Does the visual method end with a result, whatever is answered? Valid answers drawn at random, over data sets.

python -m benchmarks.guesses                                          the examples
python -m benchmarks.guesses sweethome3d metaworld urdf:FOLDER --seeds 3 --pictures
"""

from __future__ import annotations

import argparse
import tempfile
import time
import traceback
from pathlib import Path

from anymesh.config import Config, GroundingConfig, ViewsConfig
from anymesh.errors import InputError
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.guessing import Guesser
from anymesh.evaluation.protocols import prepared
from anymesh.pipeline.solving import solve

QUICK = Config(views=ViewsConfig(size=320), grounding=GroundingConfig(points=60_000))


def main() -> None:
    parser = argparse.ArgumentParser(description="Random valid answers to every question, over data sets: no crash.")
    parser.add_argument("sets", nargs="*", default=["examples"], help="as for `anymesh eval`")
    parser.add_argument("--seeds", type=int, default=1, help="runs of each object")
    parser.add_argument("--pictures", action="store_true", help="draw the pictures too, as for a model")
    parser.add_argument("--most", type=int, help="objects of each set, evenly spread")
    options = parser.parse_args()
    crashes = done = 0
    for spec in options.sets:
        dataset = open_dataset(spec)
        names = list(dataset.objects())
        for name in names[:: max(1, len(names) // options.most) if options.most else 1]:
            try:
                with tempfile.TemporaryDirectory() as folder:
                    sample = prepared(dataset.truth(name, Path(folder)))
            except InputError as error:
                print(f"{name}: {error}", flush=True)
                continue
            for seed in range(options.seeds):
                begin, done = time.perf_counter(), done + 1
                try:
                    guesser = Guesser(seed, pictured=options.pictures)
                    segmentation, joints = solve(sample.mesh, config=QUICK, answerer_factory=lambda _, who=guesser: who)
                    outcome = f"{len(segmentation.parts) - 1} parts, {len(joints)} joints"
                except Exception:
                    crashes += 1
                    outcome = traceback.format_exc()
                print(f"{dataset.name} {name}, seed {seed}: {outcome} ({time.perf_counter() - begin:.0f} s)", flush=True)
    print(f"{crashes} crashes in {done} runs")
    raise SystemExit(crashes > 0)


if __name__ == "__main__":
    main()
