"""The direction that points up in a mesh: stated by a user, or inferred from how the object can stand."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float

from anymesh.errors import OptionError
from anymesh.loading.stander import FLAT_COSINE, Stander
from anymesh.loading.up_features import up_candidates, up_features
from anymesh.scoring.classifier import Classifier
from anymesh.types import Mesh

AXIS = re.compile(r"(?P<sign>[+-]?)(?P<axis>[xyz])")
AUTO, INFER = "auto", "infer"
VALID_UP = "valid are auto, infer, x, y, z, -x, -y, -z, or a direction such as 0,0.7,0.7"
USUAL_SHARE, AXIS_SHARE, TILTED_SHARE = 0.9, 0.09, 0.01  # files in which the format's usual axis, another one or none is up

DIGITS = 9  # of an inferred direction, so that it does not depend on the processor
AXES = "xyz"
TO_Z = {  # rotations: rows are the asset's axes in file coordinates
    "x": np.array([[0.0, 1, 0], [0, 0, 1], [1, 0, 0]]),
    "y": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "z": np.eye(3),
    "-x": np.array([[0.0, 1, 0], [0, 0, -1], [-1, 0, 0]]),
    "-y": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "-z": np.array([[1.0, 0, 0], [0, -1, 0], [0, 0, -1]]),
}


@dataclass(frozen=True, eq=False)
class Up:
    """direction: (3,) unit, in file coordinates; name: such as -y, or three numbers; probability: None unless inferred."""

    direction: Float[np.ndarray, " 3"]
    name: str
    probability: float | None = None

    @property
    def to_z(self) -> Float[np.ndarray, "3 3"]:
        """Return the rotation to the asset's axes: that of the nearest axis, then the smallest one that makes it vertical."""
        k = int(np.abs(self.direction).argmax())
        base = TO_Z[AXES[k] if self.direction[k] > 0 else f"-{AXES[k]}"]
        x, y, z = base @ self.direction
        if x == y == 0:
            return base
        K = np.array([[0.0, 0, -x], [0, 0, -y], [x, y, 0]])  # of the cross product with the axis of the smallest rotation
        return (np.eye(3) + K + K @ K / (1 + z)) @ base


def read_up(text: str) -> Up | None:
    """Read a stated direction; None for auto and infer. Raise OptionError for any other text."""
    if text in (AUTO, INFER):
        return None
    if axis := AXIS.fullmatch(text):
        return up_of((-1.0 if axis["sign"] == "-" else 1.0) * np.eye(3)[AXES.index(axis["axis"])])
    try:
        direction = np.array([float(number) for number in text.split(",")])
    except ValueError:
        direction = np.zeros(0)
    length = float(np.linalg.norm(direction))
    if len(direction) != 3 or not np.isfinite(length) or length < 1e-9:
        raise OptionError(f"--up: found {text!r}; {VALID_UP}")
    return up_of(direction / length)


def up_of(direction: Float[np.ndarray, " 3"], probability: float | None = None) -> Up:
    """Return a unit direction with its name."""
    k = int(np.abs(direction).argmax())
    sign = float(np.sign(direction[k]))
    if np.array_equal(direction, sign * np.eye(3)[k]):
        return Up(direction, AXES[k] if sign > 0 else f"-{AXES[k]}", probability)
    return Up(direction, ",".join(f"{x + 0.0:.4g}" for x in direction), probability)


@cache
def up_classifier() -> Classifier:
    """Read the classifier (`training/train_up.py`)."""
    return Classifier.read("anymesh.loading", "up_classifier.npz")


def infer_up(mesh: Mesh, usual: str | None) -> Up:
    """Infer what points up from how the object can stand; the usual axis if the mesh is flat.

    usual: the axis that points up in most files of the format, or None if no axis is likelier than any other direction.
    """
    shape = Stander.of(mesh)
    if shape is None:
        return up_of(np.eye(3)[AXES.index(usual or "z")])
    candidates = up_candidates(shape)
    classifier = up_classifier()
    scores = classifier.score(classifier.table(up_features(shape, candidates)))
    if usual is not None:
        scores = scores + _log_prior(candidates, usual)
    best = int(np.argmax(scores))
    likely = np.exp(scores - scores[best])
    near = candidates @ candidates[best] > FLAT_COSINE
    direction = np.round(candidates[best], DIGITS)
    return up_of(direction / np.linalg.norm(direction), float(likely[near].sum() / likely.sum()))


def _log_prior(candidates: Float[np.ndarray, "k 3"], usual: str) -> Float[np.ndarray, " k"]:
    """Return the logarithm of the share of files in which each candidate points up."""
    is_axis = (np.abs(candidates) == 1).any(1)
    is_usual = candidates[:, AXES.index(usual)] == 1
    share = np.where(is_axis, AXIS_SHARE / 5, TILTED_SHARE / max(int((~is_axis).sum()), 1))
    return np.log(np.where(is_usual, USUAL_SHARE, share))
