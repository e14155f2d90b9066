"""The candidate motions of the parts of objects with known joints, with their features, kept in a folder: one file per object.

python -m training.motion_rows FOLDER SPEC ... [--change fused] [--most N] [--workers 2]

SPEC: a data set as for `anymesh eval`, with @NAME to name the source otherwise. Names are removed; the true parts are given.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.articulation.estimate import PartMotions, part_motions
from anymesh.articulation.motion_features import motion_features
from anymesh.articulation.part_contexts import in_a_row, same_size
from anymesh.articulation.rank_motions import same_joints
from anymesh.evaluation.ground_truth import EvalSample, TrueJoint
from anymesh.evaluation.score import angle_error, distance_at, opening_side, opens_both_ways
from anymesh.geometry.surface import ObjectShape
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Motion
from training.collect_rows import collect_all, kind_of

ANGLE, FAR = 5.0, 0.08  # [deg], and half the object's diagonal is 1: a motion that is further off is wrong
ALL = 10**6  # motions of a part that are swept
NEAR_ANGLE, NEAR = 2.0, 0.03  # of the right ones, those this near count most


@dataclass(frozen=True, eq=False)
class MotionRows:
    """The candidate motions of one part: two for each motion, one to each side.

    features: (n, k) with `names`; axes: (n, 3) in the asset frame; right: (n,) how right a motion is, 0 for wrong; opens_right:
    (n,) whether it opens to the true side, 1, 0, or -1 where there is none; same: (n, n) motions that are one joint to a user;
    free: (n,) not blocked; twins: parts that are copies of it in a row.
    """

    source: str
    kind: str
    name: str
    form: str
    part: str
    number: int
    twins: tuple[int, ...]
    names: tuple[str, ...]
    features: Float32[np.ndarray, "n k"]
    axes: Float[np.ndarray, "n 3"]
    right: Float[np.ndarray, " n"]
    opens_right: Int[np.ndarray, " n"]
    same: Bool[np.ndarray, "n n"]
    free: Bool[np.ndarray, " n"]

    def of_motions(self, chosen: Int[np.ndarray, " m"]) -> MotionRows:
        """Return the rows of some motions, each to both sides."""
        k = (2 * chosen[:, None] + np.arange(2)).reshape(-1)
        return replace(
            self, features=self.features[k], axes=self.axes[k], right=self.right[k], opens_right=self.opens_right[k],
            same=self.same[np.ix_(k, k)], free=self.free[k],
        )  # fmt: skip


def rows_of(sample: EvalSample, source: str, form: str = "") -> list[MotionRows]:
    """Propose, sweep and measure the motions of all parts with a known joint."""
    truth = sample.truth
    whole = object_shape(sample.mesh, labels=sample.labels)
    joints = {j.child: sample.joint(j) for j in truth.joints if j.type is not JointType.FIXED}
    found: list[MotionRows] = []
    every = list(part_motions(whole, sample.segmentation(), most_swept=ALL))
    copies = _copies(whole, sample, every)
    for i, _, context, offered in every:
        name = truth.parts[i].name
        if name not in joints:
            continue
        rows = motion_features(context, offered.candidates)
        joint, center = joints[name], sample.mesh.triangles[sample.labels == i].reshape(-1, 3).mean(0)
        motions = [c.motion for c in offered.candidates]
        names = tuple(rows[0])
        found.append(MotionRows(
            source, kind_of(truth.name, truth.category), truth.name, form, name, i,
            copies[i], names,
            np.array([[row[n] for n in names] for row in rows], np.float32),
            np.array([m.axis for m in motions]),
            np.array([how_right(joint, m, center, sample.unit) for m in motions]),
            np.array([opens_right(joint, c.motion.axis * c.opening_sign) for c in offered.candidates]),
            np.array([same_joints(offered.part, offered.candidates, k) for k in range(len(motions))]),
            np.array([c.is_free for c in offered.candidates]),
        ))  # fmt: skip
    return found


def _copies(whole: ObjectShape, sample: EvalSample, every: Sequence[PartMotions]) -> dict[int, tuple[int, ...]]:
    """Return the parts that stage B compares each part with: of the same size and parent, in a row with it."""
    label = sample.labels[whole.source]
    shapes = [whole.of(np.flatnonzero(label == i)) for i in range(len(sample.truth.parts))]
    parent = {i: over for i, over, _, _ in every}
    context = {i: a for i, _, a, _ in every}
    groups = same_size(shapes, [-1, *(parent[i] for i in sorted(parent))])
    return {i: tuple(j for j in group if j != i and in_a_row(context[i], context[j])) for group in groups for i in group}


def how_right(true: TrueJoint, motion: Motion, center: np.ndarray, unit: float) -> float:
    """Return 0 for a wrong motion, else how near it is to the true one, up to 1."""
    slides = true.type is JointType.PRISMATIC
    if slides != (motion.kind is JointType.PRISMATIC):
        return 0.0
    angle = angle_error(motion.axis, true.axis)
    off = 0.0 if slides else distance_at(center, motion.origin, motion.axis, true.origin, true.axis) / unit
    if angle > ANGLE or off > FAR:
        return 0.0
    return float(np.exp(-((off / NEAR) ** 2 + (angle / NEAR_ANGLE) ** 2) / 2)) + 1e-3


def opens_right(true: TrueJoint, axis: np.ndarray) -> int:
    """Return 1 if an axis opens to the true side, 0 if not, -1 where there is no such side."""
    if not true.range_known or opens_both_ways(true.limits):
        return -1
    return int(opening_side(true.limits) * float(axis @ true.axis) > 0)


def save(path: Path, parts: Sequence[MotionRows]) -> None:
    """Write an .npz file."""
    records: list[dict[str, Any]] = []
    arrays: dict[str, np.ndarray] = {}
    for k, rows in enumerate(parts):
        fields = vars(rows)
        arrays |= {f"{key}.{k}": value for key, value in fields.items() if isinstance(value, np.ndarray)}
        records.append({key: value for key, value in fields.items() if not isinstance(value, np.ndarray)})
    np.savez_compressed(path, told=np.frombuffer(json.dumps(records).encode(), np.uint8), **arrays)


def read_rows(folder: Path) -> list[MotionRows]:
    """Read all parts of all objects of a folder, in the order of their file names."""
    found = []
    for path in sorted(folder.glob("*.npz")):
        with np.load(path) as file:
            for k, record in enumerate(json.loads(bytes(file["told"]).decode())):
                arrays = {key: file[f"{key}.{k}"] for key in ("features", "axes", "right", "opens_right", "same", "free")}
                record = {key: tuple(value) if isinstance(value, list) else value for key, value in record.items()}
                found.append(MotionRows(**record, **arrays))
    return found


def write_rows(path: Path, sample: EvalSample, source: str, form: str) -> None:
    """Write the rows of one object."""
    save(path, rows_of(sample, source, form))


def main(argv: Sequence[str] | None = None) -> None:
    collect_all("Candidate motions of parts, with their features.", write_rows, argv)


if __name__ == "__main__":
    main()
