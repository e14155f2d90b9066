"""Training by PPO of Stable-Baselines3, and evaluation of policies."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.policy.env_ import ArticulatedEnv, make_env
from anymesh.applications.policy.tasks import DEXART, PolicyTask, Randomization
from anymesh.errors import MissingExtraError, OptionError, OutputError, pip_install
from anymesh.runtime import write_whole

MODEL, CHECKPOINT, CURVE, CONFIG = "policy.zip", "checkpoint.zip", "curve.jsonl", "training.json"
Progress = Callable[[str, str, int, int], None]


@dataclass(frozen=True)
class Episode:
    """Outcome of an evaluated episode. number: of the episode on its asset; progress: at its end; rise: [m]."""

    asset: str
    number: int
    success: bool
    progress: float
    rise: float
    steps: int


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


def load_sb3() -> Any:
    """Import Stable-Baselines3. Raise MissingExtraError without it."""
    try:
        import stable_baselines3  # ty: ignore[import-not-found]
    except ImportError:
        raise MissingExtraError(
            f"stable-baselines3 is not installed; {pip_install('policy')} brings it "
            "(install a CPU build of torch first where there is no GPU)"
        ) from None
    return stable_baselines3


def train(
    assets: Sequence[Path],
    task: str,
    out: Path,
    *,
    steps: int,
    seed: int = 0,
    start: Path | None = None,
    settings: TrainingSettings = TrainingSettings(),
    progress: Progress = lambda *_: None,
) -> Path:
    """Train a policy on assets and return its file; resume from the last checkpoint in `out`, or return a finished policy.

    start: a policy whose training is continued. Raise OutputError if `out` holds a training with other settings.
    """
    if steps < 1:
        raise OptionError(f"--steps must be 1 or more, found {steps}")
    config = {"assets": [str(p) for p in assets], "task": task, "steps": steps, "seed": seed, "start": str(start or "")}
    _check_config(out, json.loads(json.dumps(config | asdict(settings))))
    if (out / MODEL).is_file():
        return out / MODEL
    sb3 = load_sb3()
    import torch  # ty: ignore[import-not-found]

    torch.set_num_threads(settings.threads)
    envs = _vector(assets, task, settings)
    try:
        model, done = _model(sb3, envs, out, start, seed, settings)
        callback = _recorder(sb3, out, done, steps, settings.saved, progress)
        model.learn(steps - done, callback=callback, reset_num_timesteps=True)
        _save(model, out / MODEL)
    finally:
        envs.close()
    (out / CHECKPOINT).unlink(missing_ok=True)
    return out / MODEL


def _check_config(out: Path, config: dict[str, Any]) -> None:
    path = out / CONFIG
    if path.is_file():
        if json.loads(path.read_text(encoding="utf-8")) != config:
            raise OutputError(f"{out} holds a training with other settings; remove it or choose another folder")
        return
    out.mkdir(parents=True, exist_ok=True)
    write_whole(path, json.dumps(config, indent=1).encode())


def _maker(assets: Sequence[Path], task: str, settings: TrainingSettings) -> Callable[[], ArticulatedEnv]:
    poses = DEXART[PolicyTask(task)] if settings.dexart_poses else Randomization()
    paths = [str(p) for p in assets]
    return partial(make_env, paths, task, robot=settings.robot, observation=settings.observation, randomization=poses)


def _vector(assets: Sequence[Path], task: str, settings: TrainingSettings) -> Any:
    from stable_baselines3.common.vec_env import DummyVecEnv, SubprocVecEnv, VecMonitor  # ty: ignore[import-not-found]

    make = _maker(assets, task, settings)
    kind = SubprocVecEnv if settings.processes else DummyVecEnv
    return VecMonitor(kind([make] * settings.envs), info_keywords=("success", "progress", "rise"))


def _model(sb3: Any, envs: Any, out: Path, start: Path | None, seed: int, settings: TrainingSettings) -> tuple[Any, int]:
    """Return the model, new or loaded, and the steps that it was trained in this folder."""
    checkpoint = out / CHECKPOINT
    if checkpoint.is_file():
        done = json.loads((out / "checkpoint.json").read_text(encoding="utf-8"))["steps"]
        model = sb3.PPO.load(checkpoint, env=envs, device=settings.device)
        model.set_random_seed(seed + done)
        return model, done
    (out / CURVE).unlink(missing_ok=True)
    if start is not None:
        model = sb3.PPO.load(start, env=envs, device=settings.device)
        model.set_random_seed(seed)
        return model, 0
    policy: dict[str, Any] = {"net_arch": list(settings.hidden), "log_std_init": settings.log_std}
    if settings.observation == "points":
        from anymesh.applications.policy.pointnet_ import PointCloudExtractor

        policy["features_extractor_class"] = PointCloudExtractor
    model = sb3.PPO(
        "MultiInputPolicy" if settings.observation == "points" else "MlpPolicy", envs, n_steps=settings.rollout,
        batch_size=settings.batch, n_epochs=settings.epochs, learning_rate=settings.learning_rate, gamma=settings.discount,
        gae_lambda=settings.gae, policy_kwargs=policy, seed=seed, device=settings.device,
    )  # fmt: skip
    return model, 0


def _recorder(sb3: Any, out: Path, before: int, steps: int, every: int, progress: Progress) -> Any:
    """Return a callback that appends to the learning curve after each rollout, and saves checkpoints."""
    from stable_baselines3.common.callbacks import BaseCallback  # ty: ignore[import-not-found]

    class Recorder(BaseCallback):
        saved = before

        def _on_step(self) -> bool:
            return True

        def _on_rollout_end(self) -> None:
            done, episodes = before + self.num_timesteps, self.model.ep_info_buffer or ()
            row = {"steps": done, **{k: float(np.mean([e[k] for e in episodes])) for k in ("success", "r", "l") if episodes}}
            with (out / CURVE).open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
            progress("train", f"{out.name}: success {row.get('success', 0.0):.2f}", min(done, steps), steps)
            if done - self.saved >= every and done < steps:
                _save(self.model, out / CHECKPOINT)
                write_whole(out / "checkpoint.json", json.dumps({"steps": done}).encode())
                self.saved = done

    return Recorder()


def _save(model: Any, path: Path) -> None:
    part = path.with_name(f".{path.name}.part.zip")
    model.save(part)
    part.replace(path)


def read_curve(out: Path) -> list[dict[str, float]]:
    """Return the learning curve of a training: steps, mean success, reward r and length l of the last 100 episodes."""
    path = out / CURVE
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    rows = {
        row["steps"]: {k: float(v) for k, v in row.items()} for row in map(json.loads, lines) if "success" in row
    }  # a resumed run repeats some
    return [rows[k] for k in sorted(rows)]


def evaluate_policy(
    policy: Path, assets: Sequence[Path], task: str, *, episodes: int, seed: int = 0,
    settings: TrainingSettings = TrainingSettings(),
) -> list[Episode]:  # fmt: skip
    """Run a policy without exploration `episodes` times on each asset, in poses and physics drawn from the seed.

    Episode k on asset i starts alike for every policy, so that policies can be compared in pairs.
    """
    import torch  # ty: ignore[import-not-found]

    torch.set_num_threads(settings.threads)
    model = load_sb3().PPO.load(policy, device=settings.device)
    make = _maker(assets, task, settings)
    envs = [make() for _ in range(min(settings.envs, len(assets) * episodes))]
    jobs = [(asset, number) for asset in range(len(assets)) for number in range(episodes)][::-1]
    return _run_all(model, envs, jobs, seed)


def _run_all(model: Any, envs: list[ArticulatedEnv], jobs: list[tuple[int, int]], seed: int) -> list[Episode]:
    """Run all jobs, several environments side by side so that the network is asked for all of them at once."""
    running: dict[int, tuple[int, int]] = {}
    seen: dict[int, Any] = {}
    episodes: list[Episode] = []

    def begin(slot: int) -> None:
        running.pop(slot, None)
        seen.pop(slot, None)
        if jobs:
            asset, number = running[slot] = jobs.pop()
            seen[slot] = envs[slot].reset(seed=seed + 100_003 * asset + number, options={"asset": asset})[0]

    for slot in range(len(envs)):
        begin(slot)
    while running:
        slots = sorted(running)
        actions, _ = model.predict(_stacked([seen[s] for s in slots]), deterministic=True)
        for slot, action in zip(slots, actions, strict=True):
            seen[slot], _, done, truncated, info = envs[slot].step(action)
            if done or truncated:
                steps, number = envs[slot].simulation.step, running[slot][1]
                episodes.append(Episode(info["asset"], number, info["success"], info["progress"], info["rise"], steps))
                begin(slot)
    return sorted(episodes, key=lambda e: (e.asset, e.number))


def _stacked(observations: list[Any]) -> Any:
    if isinstance(observations[0], dict):
        return {key: np.stack([o[key] for o in observations]) for key in observations[0]}
    return np.stack(observations)
