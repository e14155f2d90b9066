"""Placement of a changed mesh: as it is, with its true up direction given, or with the inferred one."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from anymesh.evaluation.changes import moved
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.loading.upright import infer_up, up_of


class UpSource(StrEnum):
    """Where the up direction of a mesh comes from."""

    MESH = "mesh"  # its z axis, which a change such as `spun` makes wrong
    GIVEN = "given"  # the true direction, as a user may give it by --up
    INFER = "infer"  # inferred from the shape alone, without a usual axis


def placed_by(source: UpSource, sample: EvalSample) -> EvalSample:
    """Rotate the sample so that the direction of this source points along z."""
    if source is UpSource.MESH:
        return sample
    up = up_of(sample.up) if source is UpSource.GIVEN else infer_up(sample.mesh, None)
    T = np.eye(4)
    T[:3, :3] = up.to_z
    return moved(sample, T)
