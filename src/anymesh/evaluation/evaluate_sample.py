"""Evaluation of one object: preparation by protocol, solution, scores and pictures."""

from __future__ import annotations

import logging
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

import numpy as np
from PIL import Image

from anymesh.checking.engines.mujoco_ import sweep_joints
from anymesh.errors import InputError, ModelError
from anymesh.evaluation.changes import UpSource, changed, placed_by
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.drawing import draw_joint
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, prepared
from anymesh.evaluation.record import Record, badness
from anymesh.evaluation.score import JointScore, ObjectScore, failed, score
from anymesh.evaluation.single_view import observation
from anymesh.export import write_asset
from anymesh.names import legal_name
from anymesh.types import Asset, Joint, JointType, Mesh, Segmentation, Source
from anymesh.types.questions import VisualAnswerer

log = logging.getLogger("anymesh")
PICTURES = "pictures"  # folder in the report's folder
MAX_PICTURES = 3  # of joints with errors, per object
OFF_ANGLE = 5.0  # [deg] angle error above which a joint is drawn
OFF_LINE = 0.05  # the same for the distance of the axis at the part; the diagonal is 2
STEPS = 100  # positions along each range at which a joint is driven
NAME = "object"  # of the files that are driven
# finds the parts of a placed mesh (unless given) and its joints; answerer_factory: as a keyword, None for geometry
EvalSolver = Callable[..., tuple[Segmentation, tuple[Joint, ...]]]
# returns the answerer factory of a sample, None for geometry
SampleAnswerer = Callable[[EvalSample], Callable[[VisualAnswerer], VisualAnswerer] | None]


class EvalProtocol(StrEnum):
    """What is given to the solver, and what is scored."""

    PARTS = "parts"  # the true parts are given; joints are scored (the paper's tables 1, 4 and 5)
    VIEWS = "views"  # the true parts, as visible in one view (table 3)
    END_TO_END = "end-to-end"  # only the mesh without names
    EXECUTABILITY = "executability"  # only the mesh without names, and every joint is driven in MuJoCo


@dataclass(frozen=True)
class EvalConfig:
    """Settings of an evaluation. views: per object, for the views protocol; up: what points up in the changed meshes."""

    protocol: EvalProtocol = EvalProtocol.PARTS
    changes: tuple[str, ...] = ("none",)
    views: int = 1
    seed: int = 0
    up: UpSource = UpSource.MESH


def evaluate_sample(
    config: EvalConfig, dataset: Dataset, name: str, folder: Path, solver: EvalSolver, answerer_for: SampleAnswerer
) -> list[Record]:
    """Return a record for each change or view; draw joints with errors to `folder`.

    Failures become records with an error, except ModelError (no answer available, or budget exceeded), which is raised.
    """
    with tempfile.TemporaryDirectory() as work:
        try:
            truth = dataset.truth(name, Path(work))
        except InputError as error:
            return [Record(ObjectScore(name, (), 0, 0, 0), error=str(error))]
        if config.protocol is EvalProtocol.VIEWS and not truth.joints:
            return []  # no picture shows a moving part
        return [_record(config, truth, variant, folder, solver, answerer_for) for variant in _variants(config)]


def _variants(config: EvalConfig) -> list[tuple[str, int]]:
    """Return the change and the number of the view (0: none) of each record."""
    views = range(1, config.views + 1) if config.protocol is EvalProtocol.VIEWS else (0,)
    return [(change, view) for change in config.changes for view in views]


def _record(
    config: EvalConfig,
    truth: GroundTruth,
    variant: tuple[str, int],
    folder: Path,
    solver: EvalSolver,
    answerer_for: SampleAnswerer,
) -> Record:
    change, view = variant
    label = f"{change}, view {view}" if view else change
    begin = time.perf_counter()
    try:
        sample = placed_by(config.up, changed(change, prepared(truth), config.seed))
        if view:
            sample = observation(sample, view - 1, config.seed)
        given = config.protocol in (EvalProtocol.PARTS, EvalProtocol.VIEWS)
        begin = time.perf_counter()
        segmentation, joints = solver(
            sample.mesh, sample.segmentation() if given else None, answerer_factory=answerer_for(sample)
        )
        seconds = time.perf_counter() - begin
        object_score = score(sample, segmentation, joints)
        if config.protocol is EvalProtocol.EXECUTABILITY:
            object_score = executability(sample, segmentation, joints, object_score)
    except ModelError:
        raise
    except Exception as error:  # any failure is limited to this object
        log.exception("%s (%s) failed", truth.name, label)
        message = f"{type(error).__name__}: {error}"
        return Record(failed(truth), truth.category, label, time.perf_counter() - begin, error=message)
    drawn = tuple(_pictures(sample, segmentation, joints, object_score, folder, label))
    return Record(object_score, truth.category, label, seconds, pictures=drawn)


def _pictures(
    sample: EvalSample,
    segmentation: Segmentation,
    joints: tuple[Joint, ...],
    object_score: ObjectScore,
    folder: Path,
    label: str,
) -> Iterator[tuple[str, str]]:
    """Draw the joints with errors, the worst first; yield each part with the picture's path relative to `folder`."""
    by_child = {j.child: j for j in joints}
    off = sorted((j for j in object_score.joints if is_off(j)), key=badness, reverse=True)
    for number, joint in enumerate(off[:MAX_PICTURES], start=1):
        true = next(j for j in sample.truth.joints if j.child == joint.part)
        path = Path(PICTURES) / f"{legal_name(sample.truth.name)}-{legal_name(label)}-{number}.png"
        (folder / PICTURES).mkdir(parents=True, exist_ok=True)
        drawn = draw_joint(sample, segmentation, sample.joint(true), by_child.get(joint.found), joint)
        Image.fromarray(drawn).save(folder / path)
        yield joint.part, path.as_posix()


def is_off(j: JointScore) -> bool:
    """Return whether the errors of a joint are large enough to draw it."""
    far = (j.angle or 0.0) > OFF_ANGLE or (j.at_part or 0.0) > OFF_LINE
    return not j.type_right or far or j.opens_right is False or j.parent_right is False


def executability(sample: EvalSample, segmentation: Segmentation, joints: tuple[Joint, ...], score: ObjectScore) -> ObjectScore:
    """Add to the score the faults found when driving every joint through its range.

    As in MotionAnymesh (arXiv 2603.12936), every joint is driven through its full range in a simulator in 100 steps, and must
    neither penetrate, nor detach, nor freeze; the authors' simulator and tolerances are not published. This covers only found
    joints; missing ones affect other figures. An object that has true joints, but no movable found joint, is not executable.
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
