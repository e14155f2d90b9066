"""Consistency of frames: distance between the depth of one frame and that of others that see the same place."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Float32

from anymesh.applications.scan.frames import FLIPPED, Frames, Pinhole, RgbdFrame
from anymesh.errors import InputError
from anymesh.names import listed
from anymesh.types import Brief

POINTS = 1500  # points per frame that are projected into other frames
SAMPLED = 24  # other frames that each frame is compared with
SIDE = 160  # [px] longer side of the reduced depth maps
IGNORED = 0.95  # largest share of the depth that may lie beyond the limit
MIN_OVERLAP_SHARE = 0.1  # share of a frame's points that must fall on depth of another for the two to overlap
OFF = 0.03  # share of the depth; frames that disagree by more are inconsistent
BETTER = 0.4  # another pose convention is reported if it leaves less than this share of the disagreement
DRIFTED = 4.0  # times the usual disagreement; frames above it are dropped
DRIFTED_LEAST = 0.006  # share of the depth; minimum disagreement of a dropped frame
DEPTHS = (0.03, 30.0)  # [m] valid range of the median depth of a recording
CONVENTIONS = {
    "camera axes are those of OpenGL (y up, z back) where OpenCV's were declared, or vice versa": lambda T: T @ FLIPPED,
    "poses are world-to-camera where camera-to-world was expected": np.linalg.inv,
    "poses are world-to-camera, and with the other camera axes (OpenGL or OpenCV) than declared": lambda T: (
        np.linalg.inv(T) @ FLIPPED
    ),
}


@dataclass(frozen=True, eq=False)
class Glimpse(Brief):
    """Frame with a reduced depth map. points: (n, 3) in the camera's frame [m]; camera: of the depth map."""

    name: str
    T: Float[np.ndarray, "4 4"]
    camera: Pinhole
    depth: Float32[np.ndarray, "h w"]
    points: Float[np.ndarray, "n 3"]
    focal: float  # of the depth map at its original size [px]


@dataclass(frozen=True)
class FrameAgreement(Brief):
    """Disagreement of frames. of: (n,) median per frame against those that overlap it, share of the depth, nan if none does."""

    of: Float[np.ndarray, " n"]

    @property
    def usual(self) -> float:
        """Median over frames; nan if no frames overlap."""
        known = self.of[np.isfinite(self.of)]
        return float(np.median(known)) if len(known) else np.nan


def glimpse(frame: RgbdFrame, depth_max: float = np.inf, seed: int = 0) -> Glimpse:
    """Reduce a frame's depth map and sample its points up to `depth_max` [m]. Raise InputError if sizes do not fit."""
    depth = frame.observe().depth
    if (depth > depth_max).mean() < IGNORED * (depth > 0).mean():  # else `check_depth_unit` reports a wrong unit
        depth = np.where(depth <= depth_max, depth, np.float32(0))
    step = max(1, round(max(depth.shape) / SIDE))
    coarse = np.ascontiguousarray(depth[step // 2 :: step, step // 2 :: step])
    full = frame.depth_camera(depth)
    rows, columns = np.nonzero(depth)
    some = np.random.default_rng([seed, depth.size]).permutation(len(rows))[:POINTS]
    z = depth[rows[some], columns[some]].astype(np.float64)
    x, y = (columns[some] + 0.5 - full.cx) / full.fx, (rows[some] + 0.5 - full.cy) / full.fy
    camera = Pinhole(full.fx / step, full.fy / step, full.cx / step, full.cy / step, coarse.shape[1], coarse.shape[0])
    return Glimpse(frame.name, frame.T_world_camera, camera, coarse, np.stack([x * z, y * z, z], 1), full.fx)


def check_depth_unit(glimpses: list[Glimpse]) -> None:
    """Raise InputError if the median depth is outside `DEPTHS`."""
    depths = [float(np.median(g.points[:, 2])) for g in glimpses if len(g.points)]
    if not depths:
        raise InputError("no frame has any depth; all maps are empty, or masks and confidence leave nothing")
    usual = float(np.median(depths))
    if not DEPTHS[0] <= usual <= DEPTHS[1]:
        way = "millimetres read as metres" if usual > DEPTHS[1] else "metres read as millimetres"
        factor = 0.001 if usual > DEPTHS[1] else 1000
        raise InputError(
            f"the median depth is {usual:.4g} m; valid is {DEPTHS[0]} to {DEPTHS[1]} m. It looks like {way}: "
            f"tell --depth-scale (metres per unit), {factor:g} times what was used"
        )


def agreement(glimpses: list[Glimpse], seed: int = 0) -> FrameAgreement:
    """Compute the distance of each frame's points from the surfaces measured by others, ignoring possibly occluded points."""
    count = len(glimpses)
    disagreements = np.full(count, np.nan)
    rng = np.random.default_rng(seed)
    for i, g in enumerate(glimpses):
        others = rng.permutation([j for j in range(count) if j != i])[:SAMPLED]
        values = [v for j in others if np.isfinite(v := _disagreement(g, glimpses[j]))]
        if values:
            disagreements[i] = np.median(values)
    return FrameAgreement(disagreements)


def _disagreement(a: Glimpse, b: Glimpse) -> float:
    """Return the median disagreement of points of `a` on or in front of the depth of `b`; nan if there are too few.

    A point in front of a measured surface contradicts it. A point behind it may be occluded and is ignored.
    """
    p = (a.points @ a.T[:3, :3].T + a.T[:3, 3] - b.T[:3, 3]) @ b.T[:3, :3]
    column, row = b.camera.pixels(p)
    inside = column >= 0
    known = b.depth[row[inside], column[inside]]
    there = known > 0
    gap = (known[there] - p[inside, 2][there]) / known[there]
    front = gap[gap > -OFF]
    return float(np.median(np.abs(front))) if len(front) >= max(MIN_OVERLAP_SHARE * len(a.points), 20) else np.nan


def check_convention(glimpses: list[Glimpse], frame_agreement: FrameAgreement) -> None:
    """Raise InputError if frames contradict each other, naming the pose convention that would make them agree, if any."""
    usual = frame_agreement.usual
    if usual <= OFF:
        return
    tried = {why: agreement([replace(g, T=turn(g.T)) for g in glimpses]).usual for why, turn in CONVENTIONS.items()}
    known = {why: value for why, value in tried.items() if np.isfinite(value)}
    best = min(known, key=lambda why: known[why], default=None)
    if np.isnan(usual):
        hint = f"; {best}: with this reading they overlap" if best and known[best] < OFF else ""
        raise InputError(f"no two frames see the same place: poses are wrong, or each shows a different side{hint}")
    fault = f"frames contradict each other: the same place differs by {usual:.1%} of the depth between them (valid: {OFF:.0%})"
    if best and known[best] < BETTER * usual:
        raise InputError(f"{fault}. Probably {best}: with this reading it differs by {known[best]:.1%}")
    raise InputError(
        f"{fault}. No other convention of poses explains it: poses, intrinsics or the scale of depth (--depth-scale) are wrong"
    )


def without_drifted(frames: Frames, agreement: FrameAgreement) -> tuple[Frames, list[int]]:
    """Return the frames that agree with most others, with a warning about the dropped ones, and the indices of those kept."""
    limit = max(DRIFTED * agreement.usual, DRIFTED_LEAST)
    bad = [k for k in range(len(frames)) if not agreement.of[k] <= limit]
    if not bad:
        return frames, list(range(len(frames)))
    kept = [k for k in range(len(frames)) if k not in set(bad)]
    lone = [frames.frames[k].name for k in bad if np.isnan(agreement.of[k])]
    off = [f"{frames.frames[k].name} ({agreement.of[k]:.1%})" for k in bad if np.isfinite(agreement.of[k])]
    warnings = []
    if off:
        warnings.append(
            f"{len(off)} of {len(frames)} frames disagree with the others about the surface and are left out: {listed(off, 6)}"
        )
    if lone:
        warnings.append(f"{len(lone)} of {len(frames)} frames see nothing that others see and are left out: {listed(lone, 6)}")
    return frames.of([frames.frames[k] for k in kept], *warnings), kept
