"""`anymesh scan`: recording -> validated frames -> fused surface -> one clean object -> GLB in metres."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

import numpy as np

from anymesh.applications.scan.agreement import agreement, check_convention, check_depth_unit, glimpse, without_drifted
from anymesh.applications.scan.cleaning import Hole, Surface, close_small, cut_floor, drop_bits
from anymesh.applications.scan.coloring import vertex_colors
from anymesh.applications.scan.config import Options, ScanConfig
from anymesh.applications.scan.decimate_ import decimate
from anymesh.applications.scan.frames import Frames, cropped
from anymesh.applications.scan.fusion import Field, fuse, place_blocks
from anymesh.applications.scan.output import ScanReport, check_output, write_scan
from anymesh.applications.scan.reading import FEWEST, read_frames
from anymesh.applications.scan.scene import Scene, find_scene
from anymesh.applications.scan.smoothing import smooth
from anymesh.applications.scan.surface_ import extract
from anymesh.errors import InputError
from anymesh.runtime import Progress, silent

FINE = 400  # voxels along the object's diagonal, unless limited by `PIXELS`
PIXELS = 0.75  # [px] smallest voxel, projected on the object
TRUNCATION = 4.0  # [voxels] smallest truncation
NOISES = 3.0  # [standard deviations of depth] smallest truncation
SEEN = 0.3  # lowest weight of a voxel that counts; a frontal view from the usual distance has weight 1
MOVED = 2.0  # [voxels] largest displacement of a vertex by smoothing


@dataclass(frozen=True)
class Cleaned:
    """Results of cleaning: dropped components, closed small holes, larger holes; area of the surface [m2]."""

    bits: int
    closed: int
    holes: tuple[Hole, ...]
    area: float


def scan(
    recording: str | Path, out: str | Path, *, force: bool = False, progress: Progress = silent, **options: Unpack[Options]
) -> ScanReport:
    """Fuse posed pictures with depth to a coloured surface mesh in metres and write it to the file `out` (.glb).

    recording: a folder with frames.json, transforms.json (nerfstudio), keyframes/ (Polycam), sparse/ (COLMAP) or metadata and
    rgbd/ (Record3D), or an .r3d file; options: see `ScanConfig`. Raise InputError (wrong files, intrinsics, poses or depth),
    OptionError, OutputError, or MissingExtraError (pictures without depth, or a compressed recording).
    """
    out, config = Path(out), ScanConfig(**options)
    check_output(out, force)
    frames = read_frames(Path(recording), depth_scale=config.depth_scale, scale=config.scale)
    if not frames.has_depth:
        from anymesh.applications.scan.splatting_ import with_depth

        frames = with_depth(frames, seed=config.seed, progress=progress)
    given = [frame.name for frame in frames.frames]
    frames, scene, usual, disagreement = checked(frames, config, progress)
    field = fused(frames, scene, usual, config, progress)
    vertices, faces = extract(field, SEEN)
    surface, cleaned = _cleaned(Surface(vertices, faces), field.grid.voxel, scene, config, progress)
    colors = vertex_colors(surface.vertices, surface.faces, frames, scene.T_scan_world, progress)
    kept = {frame.name for frame in frames.frames}
    low, high = surface.vertices.min(0), surface.vertices.max(0)
    x, y, z = (high - low).tolist()
    report = ScanReport(
        mesh=out.name,
        layout=frames.layout,
        frames=len(frames),
        dropped=tuple(name for name in given if name not in kept),
        warnings=frames.warnings,
        method="TSDF fusion",
        voxel=field.grid.voxel,
        truncation=field.truncation,
        pixel=scene.pixel,
        noise=scene.noise,
        disagreement=disagreement,
        floor="kept" if config.keep_floor else "removed" if scene.has_floor else "not found",
        T_scan_world=tuple(tuple(float(v) for v in row) for row in scene.T_scan_world),
        extents=(x, y, z),
        faces=len(surface.faces),
        fused_faces=len(faces),
        bits_removed=cleaned.bits,
        closed_holes=cleaned.closed,
        holes=cleaned.holes,
        open_share=sum(h.area for h in cleaned.holes if not h.closed) / cleaned.area,
    )
    write_scan(out, surface.vertices, surface.faces, colors, report)
    return report


def checked(frames: Frames, config: ScanConfig, progress: Progress) -> tuple[Frames, Scene, float, float]:
    """Return the consistent frames, the scene, the usual depth [m] and the frames' median disagreement (share of depth)."""
    glimpses = []
    for number, frame in enumerate(frames.frames):
        progress("check", frame.name, number, len(frames))
        glimpses.append(glimpse(frame, config.depth_max, config.seed))
    check_depth_unit(glimpses)
    frame_agreement = agreement(glimpses, config.seed)
    check_convention(glimpses, frame_agreement)
    frames, kept = without_drifted(frames, frame_agreement)
    if len(frames) < FEWEST:
        raise InputError(
            f"{len(frames)} frames agree about a surface; {FEWEST} or more are needed. {'; '.join(frames.warnings)}"
        )
    glimpses = [glimpses[k] for k in kept]
    scene = find_scene(frames, glimpses, crop=config.crop, floor=not config.keep_floor, seed=config.seed)
    if config.crop is not None:
        low, high = np.array(config.crop[:3]), np.array(config.crop[3:])
        frames = frames.of([cropped(frame, low, high) for frame in frames.frames])
    if not scene.has_floor and not config.keep_floor:
        frames = frames.of(list(frames.frames), "no floor or table was found: nothing was cut off, and up is a guess")
    usual = float(np.median([np.median(g.points[:, 2]) for g in glimpses if len(g.points)]))
    return frames, scene, usual, frame_agreement.usual


def fused(frames: Frames, scene: Scene, usual: float, config: ScanConfig, progress: Progress) -> Field:
    """Compute the distance field of the region; the default voxel depends on the object's diagonal and the pixel size."""
    voxel = config.voxel or max(scene.diagonal / FINE, PIXELS * scene.pixel)
    truncation = max(TRUNCATION * voxel, NOISES * scene.noise)
    bounds = np.stack([scene.low, scene.high])
    grid = place_blocks(frames, scene.T_scan_world, bounds, voxel, truncation, config.depth_max, progress)
    return fuse(frames, scene.T_scan_world, grid, truncation, usual, config.depth_max, progress)


def _cleaned(surface: Surface, voxel: float, scene: Scene, config: ScanConfig, progress: Progress) -> tuple[Surface, Cleaned]:
    """Return one object, smoothed and simplified, and the results of cleaning for the report."""
    progress("clean", f"{len(surface.faces)} faces", 0, 3)
    if scene.has_floor:
        surface = cut_floor(surface, voxel)
    if len(surface.faces) == 0:
        raise InputError("nothing is left above the floor; --keep-floor keeps it")
    surface, bits = drop_bits(surface)
    surface, holes, closed = close_small(surface, voxel)
    progress("smooth", f"{len(surface.faces)} faces", 1, 3)
    surface = Surface(smooth(surface.vertices, surface.faces, MOVED * voxel), surface.faces)
    cleaned = Cleaned(bits, closed, holes, float(surface.areas.sum()))
    progress("simplify", f"to {config.faces} faces", 2, 3)
    return decimate(surface, config.faces), cleaned
