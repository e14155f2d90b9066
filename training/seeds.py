"""How much of a result is chance: the same objects with several seeds, which choose the points that are sampled on surfaces.

python -m training.seeds SPEC [--every 16] [--seeds 3] [--workers 2]

SPEC: a data set as for `anymesh eval`. Names are removed; the true parts are given. Prints the share of parts of which a value
differs between seeds, and the share of joints that are right with each seed.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context

import numpy as np
from jaxtyping import Float

from anymesh.articulation.candidate_motions import Candidate, PartFacts
from anymesh.articulation.estimate import part_motions
from anymesh.articulation.rank_motions import rank_motions, same_joints
from anymesh.config import SAME_AXIS_COSINE
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType
from training.collect_rows import open_object
from training.motion_rows import how_right, opens_right

MOVED = 0.15  # of half the size of the part's face: a handle that is further off has moved


@dataclass(frozen=True, eq=False)
class Seen:
    """What is read off a part with one seed. right: whether motion and side are."""

    handle: tuple[float, float] | None
    opening: Float[np.ndarray, " 3"]
    outline: Float[np.ndarray, " 3"]
    chosen: Candidate
    part: PartFacts
    right: bool


def seen_with(spec: str, seeds: Sequence[int], name: str) -> list[list[Seen]]:
    """Return what is read off each part with a known joint, once for each seed."""
    sample = open_object(spec, name, "")
    given, truth = sample.segmentation(), sample.truth
    joints = {j.child: sample.joint(j) for j in truth.joints if j.type is not JointType.FIXED}
    found: dict[str, list[Seen]] = {}
    for seed in seeds:
        whole = object_shape(sample.mesh, seed, sample.labels)
        for i, _, context, motions in part_motions(whole, given):
            part = truth.parts[i].name
            if part not in joints:
                continue
            best = motions.candidates[rank_motions(motions).ranking[0]]
            center = sample.mesh.triangles[sample.labels == i].reshape(-1, 3).mean(0)
            right = how_right(joints[part], best.motion, center, sample.unit) > 0
            right &= opens_right(joints[part], best.motion.axis * best.opening_sign) != 0
            handle = context.handle and context.handle.across
            found.setdefault(part, []).append(
                Seen(handle, context.opening_direction, context.outline.axis, best, motions.part, right)
            )
    return list(found.values())


def same_handle(a: Seen, b: Seen) -> bool:
    """Whether both have none, or one in the same place."""
    if a.handle is None or b.handle is None:
        return a.handle is b.handle
    return max(abs(x - y) for x, y in zip(a.handle, b.handle, strict=True)) < MOVED


def same_motion(a: Seen, b: Seen) -> bool:
    """Whether a user could not distinguish the chosen motions."""
    return bool(same_joints(a.part, [a.chosen, b.chosen], 0)[1])


def changed(parts: Sequence[Sequence[Seen]]) -> dict[str, float]:
    """Return the share of parts of which each value differs between any two seeds."""
    rules = {
        "handle": same_handle,
        "opening direction": lambda a, b: bool(a.opening @ b.opening > SAME_AXIS_COSINE),
        "axis of the outline": lambda a, b: bool(abs(a.outline @ b.outline) > SAME_AXIS_COSINE),
        "chosen motion": same_motion,
    }
    return {
        name: float(np.mean([not all(same(seen[0], other) for other in seen[1:]) for seen in parts]))
        for name, same in rules.items()
    }


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("spec", metavar="SPEC")
    parser.add_argument("--every", type=int, default=16, help="take every so many objects of the set")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args(argv)
    names = sorted(open_dataset(options.spec).objects())[:: options.every]
    with ProcessPoolExecutor(options.workers, mp_context=get_context("spawn")) as pool:
        parts = [seen for some in pool.map(partial(seen_with, options.spec, range(options.seeds)), names) for seen in some]
    print(f"{len(parts)} joints of {len(names)} objects; right with each seed:", end=" ")
    print(", ".join(f"{np.mean([seen[k].right for seen in parts]):.3f}" for k in range(options.seeds)))
    for name, share in changed(parts).items():
        print(f"{name} differs for {share:.3f}")


if __name__ == "__main__":
    main()
