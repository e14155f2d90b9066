"""Learned scores of candidates: boosted trees on named features, and networks that see all candidates of an object together."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.scoring.boosted_trees import BoostedTrees
from anymesh.scoring.set_network import SetNetwork, turned

REASONS = 3  # number of features named in a reason
MIN_CONFIDENCE, MAX_CONFIDENCE = 0.05, 0.99  # range of confidences
MISSING = -9.0  # value of a feature that does not apply to a candidate
TREES, NETWORK = "trees", "network"  # how the names of arrays in a file begin; networks are numbered from 0


@dataclass(frozen=True, eq=False)
class Classifier:
    """Classifier of candidates.

    trees: score each candidate by itself; networks: score all candidates of an object together, none for a classifier of
    trees alone; names: features in the order of columns; manifest: training data, settings, and the calibration of confidences,
    which is fitted to kinds left out of training.
    """

    trees: BoostedTrees
    networks: tuple[SetNetwork, ...]
    names: tuple[str, ...]
    manifest: dict[str, Any]

    @classmethod
    def read(cls, package: str, file: str) -> Classifier:
        """Read an .npz file of a package."""
        with (files(package) / file).open("rb") as opened:
            arrays = dict(np.load(opened))
        manifest = json.loads(bytes(arrays["manifest"]).decode())
        count = sum(name.startswith(NETWORK) and name.endswith(".knots") for name in arrays)
        networks = tuple(SetNetwork.from_arrays(f"{NETWORK}{k}", arrays) for k in range(count))
        return cls(BoostedTrees.from_arrays(TREES, arrays), networks, tuple(manifest["features"]), manifest)

    def table(self, features: Sequence[Mapping[str, float]]) -> Float[np.ndarray, "n k"]:
        """Return the features of all candidates in the order of columns."""
        return np.array([[row[name] for name in self.names] for row in features]).reshape(-1, len(self.names))

    def score(self, own: Float[np.ndarray, "n k"]) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate by itself."""
        return self.trees.score(own)

    def score_together(
        self, own: Float[np.ndarray, "n k"], place: Float[np.ndarray, "n 12"], relations: Float[np.ndarray, "n n r"]
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate among all of its object, by the networks, the mean over four quarter turns.

        place: as from `PartContext.place`; relations: features of each pair.
        """
        ways = [turned(place, quarters) for quarters in range(4)]
        return np.mean([network.score(own, way, relations) for network in self.networks for way in ways], axis=0)

    def probability(self, log_odds: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Return the probability that each candidate with these log-odds is right."""
        calibration = self.manifest["confidence"]
        return 1 / (1 + np.exp(-calibration["slope"] * log_odds - calibration["offset"]))

    def confidence(self, log_odds: float) -> float:
        """Return the probability that a choice with these log-odds is right, within the range of confidences."""
        return float(np.clip(self.probability(np.array([log_odds]))[0], MIN_CONFIDENCE, MAX_CONFIDENCE))

    def reasons(self, own: Float[np.ndarray, "n k"]) -> list[str]:
        """Return the names of the features that raised each score by the trees the most."""
        return [self._reason(row, g) for row, g in zip(own, self.trees.contributions(own), strict=True)]

    def _reason(self, row: Float[np.ndarray, " k"], gain: Float[np.ndarray, " k"]) -> str:
        best = [int(k) for k in np.argsort(-gain, kind="stable") if gain[k] > 0 and row[k] != MISSING][:REASONS]
        return ", ".join(f"{self.names[k]} {row[k] + 0.0:.2g}" for k in best) or "no feature of its own"
