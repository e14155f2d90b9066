"""Depth for pictures without depth, by 2D Gaussian splatting (Huang et al. 2024, the paper's choice) with gsplat, on CUDA.

Gaussians are fitted to the pictures; their median depth is rendered for every frame and fused like a sensor's, as the method's
authors extract their meshes. docs/scan.md tells how accurate this is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.scan.frames import Frames, Observation, Pinhole, RgbdFrame
from anymesh.errors import MissingExtraError, pip_install
from anymesh.runtime import Progress

SIDE = 800  # [px] largest side of the pictures used for fitting
STEPS = 6000
# Initial Gaussians: in a ball around the point that the cameras look at, and some in a shell up to far walls. Radii over the
# scene's size, which is the distance of the cameras from that point.
GAUSSIANS, IN_SHELL, BALL, SHELL = 100_000, 0.4, 0.8, 10.0
NEAR_PLANE = 0.2  # over the scene's size: a camera does not draw what is nearer
RATES = {"means": 1.6e-4, "scales": 5e-3, "quats": 1e-3, "opacities": 5e-2, "colors": 2.5e-3}  # means: over the scene's size
DECAY = 0.01  # of the rate of the means, from the first step to the last
SPLIT_UNTIL, LOWERED_EVERY, NORMALS_FROM = 0.5, 0.25, 0.3  # shares of the steps
LEAST_OPACITY = 0.05  # Gaussians below it are removed (the authors' value)
LARGEST_GAUSSIAN = 1.0  # Gaussian, over the scene's size
# Weights of the losses: structural similarity and consistency of normals (the authors' values), and distortion of depth.
SIMILARITY, NORMALS, DISTORTION = 0.2, 0.05, 0.1
WINDOW = 7  # [px] side of the squares whose structure is compared
SOLID_OPACITY = 0.5  # opacity from which a pixel has depth


@dataclass(frozen=True, eq=False)
class _Libraries:
    torch: Any
    rasterize: Any
    strategy: Any
    lower_opacities: Any


@dataclass(frozen=True, eq=False)
class _Target:
    """Picture (H, W, 3) in 0..1 on the device, with its camera."""

    picture: Any
    T_camera_world: Any
    K: Any
    camera: Pinhole


@dataclass(frozen=True, eq=False)
class _Drawing:
    """What gsplat draws for one camera, (1, H, W, ...) each: colour with expected depth, opacity, normals of the Gaussians and
    of the median depth, distortion, median depth; and what its strategy needs."""

    color: Any
    opacity: Any
    normal: Any
    normal_of_depth: Any
    distortion: Any
    depth: Any
    info: Any


def with_depth(frames: Frames, *, seed: int, progress: Progress) -> Frames:
    """Return the frames with rendered depth. Raise MissingExtraError without torch, gsplat or a CUDA device."""
    lib = _libraries()
    lib.torch.manual_seed(seed)
    center, size = gaze(frames)
    views = [_view(lib.torch, frame) for frame in frames.frames]
    params = _start(lib.torch, center, size)
    _fit(lib, params, views, size, seed, progress)
    with lib.torch.no_grad():
        deep = tuple(
            _deep(lib, params, frame, view, NEAR_PLANE * size) for frame, view in zip(frames.frames, views, strict=True)
        )
    warning = "depth comes from 2D Gaussian splatting of the pictures, not from a sensor"
    return replace(frames, frames=deep, has_depth=True, warnings=(*frames.warnings, warning))


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
    wanted = f"these pictures have no depth; 2D Gaussian splatting makes it, with {pip_install('scan-gpu')} and CUDA"
    try:
        import torch  # ty: ignore[import-not-found]
        from gsplat import DefaultStrategy, rasterization_2dgs  # ty: ignore[import-not-found]
        from gsplat.strategy.ops import reset_opa  # ty: ignore[import-not-found]
    except ImportError as error:
        raise MissingExtraError(f"{wanted}; {error.name or error} is missing. Recordings with depth need neither") from None
    if not torch.cuda.is_available():
        raise MissingExtraError(f"{wanted}; found no CUDA device. Recordings with depth need none")
    return _Libraries(torch, rasterization_2dgs, DefaultStrategy, reset_opa)


def _view(torch: Any, frame: RgbdFrame) -> _Target:
    color = frame.observe().color
    step = max(1, -(-max(color.shape[:2]) // SIDE))
    small = color[step // 2 :: step, step // 2 :: step].copy()
    full = frame.camera.resized(color.shape[1], color.shape[0])
    c = Pinhole(full.fx / step, full.fy / step, full.cx / step, full.cy / step, small.shape[1], small.shape[0])
    K = torch.tensor([[c.fx, 0, c.cx], [0, c.fy, c.cy], [0, 0, 1]], dtype=torch.float32).cuda()
    T = torch.tensor(np.linalg.inv(frame.T_world_camera), dtype=torch.float32).cuda()
    return _Target(torch.from_numpy(small).cuda().float() / 255, T, K, c)


def _start(torch: Any, center: Float[np.ndarray, " 3"], size: float) -> Any:
    """Return grey Gaussians in a ball, whose spacing is their size, and in a shell around it, where they are ever sparser."""
    outer = round(IN_SHELL * GAUSSIANS)
    inner = GAUSSIANS - outer
    radius = torch.cat([BALL * torch.rand(inner) ** (1 / 3), BALL * (SHELL / BALL) ** torch.rand(outer)]) * size
    direction = torch.nn.functional.normalize(torch.randn(GAUSSIANS, 3), dim=1)
    spacing = radius.clamp(min=BALL * size) * (4 / inner) ** (1 / 3)
    values = {
        "means": torch.tensor(center, dtype=torch.float32) + radius[:, None] * direction,
        "scales": spacing.log()[:, None].repeat(1, 3),
        "quats": torch.randn(GAUSSIANS, 4),
        "opacities": torch.full((GAUSSIANS,), float(np.log(0.1 / 0.9))),
        "colors": torch.zeros(GAUSSIANS, 3),
    }
    return torch.nn.ParameterDict({k: torch.nn.Parameter(v.cuda()) for k, v in values.items()})


def _fit(lib: _Libraries, params: Any, views: list[_Target], size: float, seed: int, progress: Progress) -> None:
    """Fit the Gaussians to the pictures, one picture a step.

    The background has another colour in each step. Otherwise Gaussians that are nearly transparent explain each picture by a
    film close to its camera, and no surface has the right depth.
    """
    torch = lib.torch
    rates = RATES | {"means": RATES["means"] * size}
    optimizers = {k: torch.optim.Adam([{"params": params[k], "lr": rate, "name": k}], eps=1e-15) for k, rate in rates.items()}
    decay = torch.optim.lr_scheduler.ExponentialLR(optimizers["means"], DECAY ** (1 / STEPS))
    lowered = round(LOWERED_EVERY * STEPS)
    strategy = lib.strategy(
        prune_opa=LEAST_OPACITY,
        prune_scale3d=LARGEST_GAUSSIAN,
        refine_stop_iter=round(SPLIT_UNTIL * STEPS),
        reset_every=lowered,
        key_for_gradient="gradient_2dgs",
    )
    strategy.check_sanity(params, optimizers)
    state, order = strategy.initialize_state(scene_scale=size), np.random.default_rng(seed)
    for step in range(STEPS):
        if step % 100 == 0:
            progress("splat", f"{len(params['means'])} Gaussians", step, STEPS)
        view = views[int(order.integers(len(views)))]
        drawing = _draw(lib, params, view, NEAR_PLANE * size, torch.rand(1, 3).cuda())
        strategy.step_pre_backward(params, optimizers, state, step, drawing.info)
        _loss(torch, drawing, view, size, smooth=step >= NORMALS_FROM * STEPS).backward()
        for optimizer in optimizers.values():
            optimizer.step()
            optimizer.zero_grad(set_to_none=True)
        decay.step()
        strategy.step_post_backward(params, optimizers, state, step, drawing.info, packed=False)
        if 0 < step < SPLIT_UNTIL * STEPS and step % lowered == 0:  # the strategy of gsplat 1.5.3 never does it
            lib.lower_opacities(params, optimizers, state, value=2 * LEAST_OPACITY)


def _loss(torch: Any, drawing: _Drawing, view: _Target, size: float, *, smooth: bool) -> Any:
    """Return the loss of one picture. smooth: whether surfaces should be smooth and thin."""
    drawn = drawing.color[0, ..., :3]
    similar = _similarity(torch, drawn, view.picture)
    loss = (1 - SIMILARITY) * (drawn - view.picture).abs().mean() + SIMILARITY * (1 - similar) / 2
    if smooth:
        loss = loss + NORMALS * (1 - (drawing.normal * drawing.normal_of_depth).sum(-1)).mean()
        loss = loss + DISTORTION / size * drawing.distortion.mean()
    return loss


def _similarity(torch: Any, a: Any, b: Any) -> Any:
    """Return the mean structural similarity of two pictures (H, W, 3) in 0..1 (Wang et al. 2004), over squares."""

    def mean(x: Any) -> Any:
        return torch.nn.functional.avg_pool2d(x.permute(2, 0, 1)[None], WINDOW, 1)

    mean_a, mean_b = mean(a), mean(b)
    spread = mean(a * a) - mean_a**2 + mean(b * b) - mean_b**2
    both = mean(a * b) - mean_a * mean_b
    light, contrast = 0.01**2, 0.03**2  # the authors' constants, which keep the quotients finite
    quotient = (2 * mean_a * mean_b + light) / (mean_a**2 + mean_b**2 + light) * (2 * both + contrast) / (spread + contrast)
    return quotient.mean()


def _draw(lib: _Libraries, params: Any, view: _Target, near: float, background: Any = None) -> _Drawing:
    """Draw the Gaussians for a camera. near: [m] nothing nearer is drawn; background: (1, 3) colour, None for black."""
    return _Drawing(
        *lib.rasterize(
            params["means"],
            params["quats"],
            params["scales"].exp(),
            params["opacities"].sigmoid(),
            params["colors"].sigmoid()[None],  # of each camera
            view.T_camera_world[None],
            view.K[None],
            view.camera.width,
            view.camera.height,
            near_plane=near,
            backgrounds=background,
            render_mode="RGB+ED",
            depth_mode="median",
            distloss=True,
        )
    )


def _deep(lib: _Libraries, params: Any, frame: RgbdFrame, view: _Target, near: float) -> RgbdFrame:
    drawing = _draw(lib, params, view, near)
    depth = lib.torch.where(drawing.opacity > SOLID_OPACITY, drawing.depth, 0)[0, ..., 0].float().cpu().numpy()
    depth = np.where(np.isfinite(depth) & (depth > 0), depth, 0).astype(np.float32)
    return replace(frame, read=lambda: Observation(frame.read().color, depth))
