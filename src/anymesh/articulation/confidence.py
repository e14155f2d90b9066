"""Confidence of a joint from answers: how well the answers agree with each other and with the geometry.

The weights are fitted by `benchmarks/confidence.py`, where the ground truth answers with deliberate errors, from none to all.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

LOWEST, HIGHEST = 0.01, 0.999
WEIGHTS = {
    "constant": -2.1,
    "kind": 0.5,  # the motion fits the answered kind of joint
    "moves": 0.05,  # the motion turns or slides as recognized
    "moves against": -0.65,
    "answered": 0.65,  # the motion is, or looks like, the previously answered line or direction
    "likely": 4.5,  # its share among the motions by geometry alone
    "doubted": 0.0,  # it was chosen against earlier answers, and asked twice
    "later": 0.0,  # it was chosen in the second picture
    "none": -6.0,  # no motion was recognized; lower than the fitted value, so that warnings name such joints
    "only": -1.4,  # there was no other motion
    "blocked": -1.2,  # the sweep found it blocked
    "others": 1.3,  # share of the answers about the other parts that agree
}


@dataclass(frozen=True)
class Agreement:
    """Evidence for and against the joint of one part, each 0..1, by the keys of WEIGHTS except "others"."""

    features: Mapping[str, float]

    @property
    def own(self) -> float:
        """Return the share of the part's own answers that agree, 0..1."""
        agreements = [self.features.get("kind", 0.0), self.features.get("answered", 0.0), 1 - self.features.get("none", 0.0)]
        return float(np.mean(agreements))


def confidences(agreements: Mapping[int, Agreement]) -> dict[int, float]:
    """Return the confidence in the joint of each part (0..1), by part number."""
    confidence = {}
    for number, agreement in agreements.items():
        others = [a.own for n, a in agreements.items() if n != number] or [agreement.own]
        features = {"constant": 1.0, **agreement.features, "others": float(np.mean(others))}
        value = sum(WEIGHTS[name] * feature for name, feature in features.items())
        confidence[number] = float(np.clip(1 / (1 + np.exp(-value)), LOWEST, HIGHEST))
    return confidence
