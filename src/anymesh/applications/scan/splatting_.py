"""Depth for pictures without depth, by 2D Gaussian splatting (Huang et al. 2024, the paper's choice) with gsplat, on CUDA.

Written against gsplat 1.5 and not run on a GPU yet. Gaussians are fitted to the pictures; their median depth is rendered for
every frame and fused like a sensor's, as the method's authors extract their meshes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame
from anymesh.errors import MissingExtraError
from anymesh.progress import Progress

GAUSSIANS = 50_000  # initial number; the strategy splits and prunes them
STEPS = 10_000
SIDE = 800  # [px] largest side of the pictures used for fitting
RATES = {"means": 1.6e-4, "scales": 5e-3, "quats": 1e-3, "opacities": 5e-2, "colors": 2.5e-3}  # means: over the scene's size
NORMAL_FROM, NORMAL_WEIGHT = 3000, 0.05  # first step and weight of the normal consistency loss (the authors' values)
SOLID = 0.5  # opacity from which a pixel has depth


@dataclass(frozen=True, eq=False)
class _Libraries:
    torch: Any
    rasterize: Any
    strategy: Any


def with_depth(frames: Frames, *, seed: int, progress: Progress) -> Frames:
    """Return the frames with rendered depth. Raise MissingExtraError without torch, gsplat or a CUDA device."""
    lib = _libraries()
    torch = lib.torch
    torch.manual_seed(seed)
    center, size = gaze(frames)
    views = [_view(torch, frame) for frame in frames.frames]
    params = _start(torch, center, size)
    rates = {k: rate * size if k == "means" else rate for k, rate in RATES.items()}
    optimizers = {k: torch.optim.Adam([{"params": params[k], "lr": rate, "name": k}], eps=1e-15) for k, rate in rates.items()}
    strategy = lib.strategy(verbose=False, key_for_gradient="gradient_2dgs")
    strategy.check_sanity(params, optimizers)
    state = strategy.initialize_state(scene_scale=size)
    order = np.random.default_rng(seed)
    for step in range(STEPS):
        if step % 100 == 0:
            progress("splat", f"{len(params['means'])} Gaussians", step, STEPS)
        view = views[int(order.integers(len(views)))]
        color, _, normal, from_depth, _, _, info = _drawn(lib, params, view)
        strategy.step_pre_backward(params, optimizers, state, step, info)
        loss = (color[0, ..., :3] - view.picture).abs().mean()
        if step >= NORMAL_FROM:
            loss = loss + NORMAL_WEIGHT * (1 - (normal * from_depth).sum(-1)).mean()
        loss.backward()
        for optimizer in optimizers.values():
            optimizer.step()
            optimizer.zero_grad(set_to_none=True)
        strategy.step_post_backward(params, optimizers, state, step, info, packed=False)
    with torch.no_grad():
        frames_with_depth = [_deep(lib, params, frame, view) for frame, view in zip(frames.frames, views, strict=True)]
    warning = "depth comes from 2D Gaussian splatting of the pictures, not from a sensor"
    return replace(frames, frames=tuple(frames_with_depth), has_depth=True, warnings=(*frames.warnings, warning))


def gaze(frames: Frames) -> tuple[Float[np.ndarray, " 3"], float]:
    """Return the point closest to all optical axes (least squares), and the cameras' median distance to it [m]."""
    A, b = np.zeros((3, 3)), np.zeros(3)
    eyes = np.stack([f.T_world_camera[:3, 3] for f in frames.frames])
    for frame, eye in zip(frames.frames, eyes, strict=True):
        z = frame.T_world_camera[:3, 2]
        across = np.eye(3) - np.outer(z, z)
        A, b = A + across, b + across @ eye
    center = np.linalg.lstsq(A, b, rcond=1e-6)[0]
    return center, float(np.median(np.linalg.norm(eyes - center, axis=1)))


def _libraries() -> _Libraries:
    wanted = (
        "these pictures have no depth; 2D Gaussian splatting makes it, with pip install 'articulate-anymesh[scan-gpu]' and CUDA"
    )
    try:
        import torch  # ty: ignore[import-not-found]
        from gsplat import DefaultStrategy, rasterization_2dgs  # ty: ignore[import-not-found]
    except ImportError as error:
        raise MissingExtraError(f"{wanted}; {error.name or error} is missing. Recordings with depth need neither") from None
    if not torch.cuda.is_available():
        raise MissingExtraError(f"{wanted}; found no CUDA device. Recordings with depth need none")
    return _Libraries(torch, rasterization_2dgs, DefaultStrategy)


@dataclass(frozen=True, eq=False)
class _Target:
    """Picture (H, W, 3) in 0..1 on the device, with its camera."""

    picture: Any
    T_camera_world: Any
    K: Any
    camera: Pinhole


def _view(torch: Any, frame: RgbdFrame) -> _Target:
    color = frame.observe().color
    step = max(1, -(-max(color.shape[:2]) // SIDE))
    small = np.ascontiguousarray(color[step // 2 :: step, step // 2 :: step])
    full = frame.camera.resized(color.shape[1], color.shape[0])
    c = Pinhole(full.fx / step, full.fy / step, full.cx / step, full.cy / step, small.shape[1], small.shape[0])
    K = torch.tensor([[c.fx, 0, c.cx], [0, c.fy, c.cy], [0, 0, 1]], dtype=torch.float32, device="cuda")
    T = torch.tensor(np.linalg.inv(frame.T_world_camera), dtype=torch.float32, device="cuda")
    return _Target(torch.from_numpy(small).cuda().float() / 255, T, K, c)


def _start(torch: Any, center: np.ndarray, size: float) -> Any:
    """Return small grey Gaussians, spread evenly in a box around the point that the cameras look at."""
    spread = (torch.rand(GAUSSIANS, 3) * 2 - 1) * 0.6 * size + torch.tensor(center, dtype=torch.float32)
    values = {
        "means": spread,
        "scales": torch.full((GAUSSIANS, 3), float(np.log(size / GAUSSIANS ** (1 / 3)))),
        "quats": torch.randn(GAUSSIANS, 4),
        "opacities": torch.full((GAUSSIANS,), float(np.log(0.1 / 0.9))),
        "colors": torch.zeros(GAUSSIANS, 3),
    }
    return torch.nn.ParameterDict({k: torch.nn.Parameter(v.cuda()) for k, v in values.items()})


def _drawn(lib: _Libraries, params: Any, view: _Target) -> Any:
    return lib.rasterize(
        params["means"],
        params["quats"],
        params["scales"].exp(),
        params["opacities"].sigmoid(),
        params["colors"].sigmoid(),
        view.T_camera_world[None],
        view.K[None],
        view.camera.width,
        view.camera.height,
        render_mode="RGB+ED",
        depth_mode="median",
    )


def _deep(lib: _Libraries, params: Any, frame: RgbdFrame, view: _Target) -> RgbdFrame:
    _, alpha, _, _, _, median, _ = _drawn(lib, params, view)
    depth = lib.torch.where(alpha > SOLID, median, 0)[0, ..., 0].float().cpu().numpy()
    depth = np.where(np.isfinite(depth) & (depth > 0), depth, 0).astype(np.float32)
    return replace(frame, read=lambda: Observation(frame.read().color, depth))
