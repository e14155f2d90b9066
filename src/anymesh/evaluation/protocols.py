"""Evaluation of an object: end to end from its mesh, or with its parts given (the paper's tables)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, runtime_checkable

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth
from anymesh.evaluation.oracle import oracle
from anymesh.evaluation.score import ObjectScore, score
from anymesh.loading import load_mesh, place_mesh
from anymesh.prompted.questions.asking import VisualAnswerer
from anymesh.types import Joint, Mesh, Segmentation

Change = Callable[[EvalSample], EvalSample]  # rotates, adds noise, fuses, and so on


@runtime_checkable
class EvalSolver(Protocol):
    """Protocol of a solver: finds the parts (unless given) and joints of a placed mesh; answerer_factory: None for geometry."""

    def __call__(
        self,
        mesh: Mesh,
        given: Segmentation | None,
        *,
        answerer_factory: Callable[[VisualAnswerer], VisualAnswerer] | None = None,
    ) -> tuple[Segmentation, tuple[Joint, ...]]: ...


def evaluate(
    truth: GroundTruth,
    solver: EvalSolver,
    *,
    given: bool = False,
    change: Change | None = None,
    reference: Callable[[VisualAnswerer], VisualAnswerer] | None = None,
) -> ObjectScore:
    """Load, place and change the mesh, solve it for parts (unless given) and joints, and score the result.

    reference: wraps the oracle, which then answers (see `oracle.Noisy`); None for geometry.
    """
    sample = prepared(truth, change)
    answerer_factory = None if reference is None else (lambda _: reference(oracle(sample)))
    segmentation, joints = solver(sample.mesh, sample.segmentation() if given else None, answerer_factory=answerer_factory)
    return score(sample, segmentation, joints)


def prepared(truth: GroundTruth, change: Change | None = None) -> EvalSample:
    """Load the truth's mesh, place it, and apply a change."""
    placed = place_mesh(load_mesh(truth.mesh))
    sample = EvalSample(truth, placed.mesh, truth.labels, placed.T_asset_source)
    return change(sample) if change else sample
