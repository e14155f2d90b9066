"""Feature extractor for point clouds: a PointNet as in DexArt, beside the robot's state."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import torch  # ty: ignore[import-not-found]
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor  # ty: ignore[import-not-found]
from torch import nn  # ty: ignore[import-not-found]

WIDTHS = (64, 128, 256)  # of the layers applied to each point


class PointCloudExtractor(BaseFeaturesExtractor):
    """Apply a perceptron to each point, take the maximum over points, and append the robot's state."""

    def __init__(self, observation_space: Any) -> None:
        robot = int(observation_space["robot"].shape[0])
        super().__init__(observation_space, WIDTHS[-1] + robot)
        widths = (int(observation_space["points"].shape[1]), *WIDTHS)
        layers = [m for a, b in pairwise(widths) for m in (nn.Linear(a, b), nn.ReLU())]
        self.points = nn.Sequential(*layers[:-1])

    def forward(self, observations: dict[str, torch.Tensor]) -> torch.Tensor:
        """Return features (batch, 256 + robot)."""
        return torch.cat([self.points(observations["points"]).amax(1), observations["robot"]], 1)
