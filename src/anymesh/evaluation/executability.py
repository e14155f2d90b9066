"""Executability of found joints in a simulator (MuJoCo), from the exported files."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.score import ObjectScore
from anymesh.export import write_asset
from anymesh.types import Asset, Joint, JointType, Mesh, Segmentation, Source

STEPS = 100  # positions along each range
NAME = "object"


def executability(sample: EvalSample, segmentation: Segmentation, joints: tuple[Joint, ...], score: ObjectScore) -> ObjectScore:
    """Add to the score the faults found when driving every joint through its range.

    The rule (see `success.motion_anymesh`) covers only found joints; missing ones affect other figures. An object that has true
    joints, but no movable found joint, is not executable.
    """
    faults = drive(sample.mesh, segmentation, joints)
    if sample.truth.joints and not _movable(joints):
        faults = ("object: no moving part was found",)
    return replace(score, executable=not faults, faults=faults)


def drive(mesh: Mesh, segmentation: Segmentation, joints: tuple[Joint, ...], steps: int = STEPS) -> tuple[str, ...]:
    """Export the asset, drive every joint through its range in MuJoCo, and return faults as "joint: fault".

    mesh: [m, Z up]. Raise MissingExtraError without MuJoCo.
    """
    if not _movable(joints):
        return ()
    asset = Asset(NAME, Source("", "", np.eye(4), "z"), mesh, segmentation, joints, "")
    with tempfile.TemporaryDirectory() as folder:
        write_asset(asset, Path(folder))
        return tuple(_faults(Path(folder) / f"{NAME}.urdf", steps))


def _faults(urdf: Path, steps: int) -> Iterator[str]:
    try:
        report = sweep_joints(urdf, steps=steps)
    except InputError as error:
        yield f"object: {error}"
        return
    for joint in report.joints:
        yield from (f"{joint.name}: {fault}" for fault in joint.faults)


def _movable(joints: tuple[Joint, ...]) -> bool:
    return any(j.type is not JointType.FIXED for j in joints)
