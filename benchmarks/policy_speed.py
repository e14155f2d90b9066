"""Steps per second of processor time of the environments, one process: python -m benchmarks.policy_speed [--steps 2000]

The objects are the example meshes laptop and bucket with their true joints; actions are random.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

from anymesh.applications.policy.env_ import make_env
from anymesh.errors import AnymeshError
from benchmarks.plan_objects import true_object
from benchmarks.policy import exact_asset

CASES = [
    (thing, task, robot, observation)
    for thing, task in (("laptop", "open"), ("bucket", "lift"))
    for robot, observation in (
        ("gripper", "state"),
        ("gripper", "box"),
        ("gripper", "points"),
        ("shadow", "points"),
        ("ur5e", "state"),
    )
]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=2000)
    options = parser.parse_args()
    print("| object, task | robot | observation | steps per second |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as work:
        for thing, task, robot, observation in CASES:
            asset = exact_asset(true_object(thing, Path(work)), Path(work) / f"{thing}_true")
            try:
                env = make_env(asset, task, robot=robot, observation=observation)
            except AnymeshError as error:
                print(f"| {thing}, {task} | {robot} | {observation} | - ({error}) |")
                continue
            env.action_space.seed(0)
            env.reset(seed=0)
            begin = time.process_time()
            for _ in range(options.steps):
                _, _, done, truncated, _ = env.step(env.action_space.sample())
                if done or truncated:
                    env.reset()
            print(
                f"| {thing}, {task} | {robot} | {observation} | {options.steps / (time.process_time() - begin):.0f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
