"""Settings of training, by size."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class TrainingSettings:
    """Settings of PPO and of the environments.

    dexart_poses: draw poses from DexArt's ranges instead of the default ones; envs: in parallel; processes: run each in its
    own; rollout: steps of each between updates; batch, epochs: of an update; hidden: widths of the layers; log_std: of actions
    at the start; saved: steps between checkpoints.
    """

    robot: str = "gripper"
    observation: str = "box"
    dexart_poses: bool = True
    envs: int = 16
    processes: bool = False
    rollout: int = 128
    batch: int = 256
    epochs: int = 6
    learning_rate: float = 5e-4
    discount: float = 0.97
    gae: float = 0.95
    hidden: tuple[int, ...] = (64, 64)
    log_std: float = -0.5
    device: str = "cpu"
    threads: int = 1
    saved: int = 50_000


SETTINGS = {
    "cpu": TrainingSettings(),
    "gpu": TrainingSettings(
        robot="shadow", observation="points", envs=64, processes=True, rollout=64, batch=1024, epochs=8, learning_rate=3e-4,
        discount=0.99, hidden=(256, 256), log_std=-1.0, device="auto", threads=4, saved=500_000,
    ),
    "smoke": TrainingSettings(envs=2, rollout=32, batch=32, epochs=2, saved=64),
}  # fmt: skip
