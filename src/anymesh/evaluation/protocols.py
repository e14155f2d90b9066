"""How an object is put to the test: end to end from its mesh, or with its parts given (the paper's tables)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from anymesh.evaluation.score import ObjectScore, score
from anymesh.evaluation.truth import Truth
from anymesh.loading import load_mesh, place_mesh
from anymesh.types import Joint, Mesh, Segmentation

Solver = Callable[[Mesh, Segmentation | None], tuple[Segmentation, tuple[Joint, ...]]]  # the parts are given, or None
Change = Callable[[Mesh], tuple[Mesh, np.ndarray]]  # a changed mesh, and the (4, 4) transform that takes the truth there


def evaluate(truth: Truth, solver: Solver, *, given: bool = False, change: Change | None = None) -> ObjectScore:
    """Loads and places the mesh, changes it, lets the solver find its parts (unless given) and joints, and scores them."""
    placed = place_mesh(load_mesh(truth.mesh))
    mesh, T = change(placed.mesh) if change else (placed.mesh, np.eye(4))
    segmentation, joints = solver(mesh, truth.segmentation() if given else None)
    return score(truth, mesh, T @ placed.T_asset_source, segmentation, joints)
