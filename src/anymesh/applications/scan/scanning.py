"""`anymesh scan`: recording -> validated frames -> fused surface -> one clean object -> GLB in metres."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, TypedDict, Unpack

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.applications.scan.agreement import agreement, check_convention, check_depth_unit, glimpse, without_drifted
from anymesh.applications.scan.cleaning_ import Hole, Surface, close_small, cut_floor, decimate, drop_bits, smooth
from anymesh.applications.scan.frames import Frames, cropped
from anymesh.applications.scan.fusion_ import Field, extract, fuse, place_blocks, vertex_colors
from anymesh.applications.scan.reading import FEWEST, read_frames
from anymesh.applications.scan.scene import Scene, find_scene
from anymesh.errors import InputError, OptionError, OutputError
from anymesh.export.glb import INDICES, VERTICES, GlbBuffer
from anymesh.runtime import Progress, silent
from anymesh.types.mesh import to_linear

TO_GLTF = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # z up to y up
FINEST = 0.0002  # [m] smallest voxel; finer than any depth camera resolves
FINE = 400  # voxels along the object's diagonal, unless limited by `PIXELS`
PIXELS = 0.75  # [px] smallest voxel, projected on the object
TRUNCATION = 4.0  # [voxels] smallest truncation
NOISES = 3.0  # [standard deviations of depth] smallest truncation
SEEN = 0.3  # lowest weight of a voxel that counts; a frontal view from the usual distance has weight 1
MOVED = 2.0  # [voxels] largest displacement of a vertex by smoothing


@dataclass(frozen=True)
class ScanReport:
    """Inputs and results of a scan; lengths in metres.

    T_scan_world: rows of the transform from the recording's world to the scan's frame (z up, floor at 0; the GLB has y up, as
    its format requires); disagreement: median over frames, share of the depth; holes: large ones, closed if flat, the largest
    first; open_share: area of the open ones over the surface's; closed_holes: number of small ones, all closed.
    """

    mesh: str
    layout: str
    frames: int
    dropped: tuple[str, ...]
    warnings: tuple[str, ...]
    method: str
    voxel: float
    truncation: float
    pixel: float
    noise: float
    disagreement: float
    floor: str
    T_scan_world: tuple[tuple[float, ...], ...]
    extents: tuple[float, float, float]
    faces: int
    fused_faces: int
    bits_removed: int
    closed_holes: int
    holes: tuple[Hole, ...]
    open_share: float


def report_path(out: Path) -> Path:
    """Return the path of a scan's report, beside its mesh."""
    return out.with_name(f"{out.stem}.scan.json")


def check_output(out: Path, force: bool) -> None:
    """Raise OutputError unless the files may be written."""
    if out.suffix.lower() != ".glb":
        raise OutputError(f"{out}: a scan is written as .glb, found {out.suffix or 'no suffix'!r}")
    if out.is_dir():
        raise OutputError(f"{out} is a folder; the name of a .glb file is expected")
    there = [p for p in (out, report_path(out)) if p.exists()]
    if there and not force:
        raise OutputError(f"{there[0]} exists; --force replaces it")


def write_scan(
    out: Path, vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], colors: UInt8[np.ndarray, "V 3"],
    report: ScanReport,
) -> None:  # fmt: skip
    """Write the GLB and its report. Raise OutputError if the folder cannot be written; then nothing is changed."""
    parts = {report_path(out): json.dumps(asdict(report), indent=1).encode(), out: glb_bytes(vertices, faces, colors)}
    temporary = {path: path.with_name(f".{path.name}.partial") for path in parts}
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        for path, data in parts.items():
            temporary[path].write_bytes(data)
        for path in parts:
            temporary[path].replace(path)
    except OSError as error:
        raise OutputError(f"{out} cannot be written: {error.strerror or error}") from None
    finally:
        for path in temporary.values():
            path.unlink(missing_ok=True)


def glb_bytes(vertices: np.ndarray, faces: np.ndarray, colors: np.ndarray) -> bytes:
    """Return a GLB of one mesh, y up, with linear 16-bit vertex colours."""
    buffer = GlbBuffer()
    color = np.c_[np.rint(to_linear(colors / 255) * 65535), np.full(len(colors), 65535)].astype(np.uint16)
    attributes = {
        "POSITION": buffer.accessor((vertices @ TO_GLTF.T).astype(np.float32), target=VERTICES, bounds=True),
        "COLOR_0": buffer.accessor(color, target=VERTICES, normalized=True),
    }
    indices = buffer.accessor(faces.reshape(-1).astype(np.uint32), target=INDICES)
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "articulate-anymesh scan"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "scan", "mesh": 0}],
        "meshes": [{"name": "scan", "primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
        "materials": [{"name": "scanned", "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.9}}],
    }
    return buffer.encode(document)


class Options(TypedDict, total=False):
    """Options of `scan`; see `ScanConfig`."""

    voxel: float | None
    scale: float | None
    depth_scale: float | None
    depth_max: float
    crop: tuple[float, ...] | None
    keep_floor: bool
    faces: int
    seed: int


@dataclass(frozen=True)
class ScanConfig:
    """Options of a scan.

    voxel: [m], None for automatic; scale: metres per unit of the poses; depth_scale: metres per unit of the depth maps (both
    None: as defined by the layout); depth_max: [m], larger depth is ignored; crop: x0, y0, z0, x1, y1, z1 [m] in the world of
    the recording; keep_floor: do not detect and cut off the floor; faces: approximate number of faces after simplification;
    seed: of the floor detection. Raise OptionError for a value that is not valid.
    """

    voxel: float | None = None
    scale: float | None = None
    depth_scale: float | None = None
    depth_max: float = 5.0
    crop: tuple[float, ...] | None = None
    keep_floor: bool = False
    faces: int = 100_000
    seed: int = 0

    def __post_init__(self) -> None:
        for name, value in (("voxel", self.voxel), ("scale", self.scale), ("depth-scale", self.depth_scale)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise OptionError(f"--{name}: found {value}; valid are numbers above 0")
        if self.voxel is not None and self.voxel < FINEST:
            raise OptionError(f"--voxel: found {self.voxel} m; valid are {FINEST} m and more")
        if not self.depth_max > 0:
            raise OptionError(f"--depth-max: found {self.depth_max}; valid are metres above 0")
        if self.faces < 1000:
            raise OptionError(f"--faces: found {self.faces}; valid are 1000 and more")
        if self.seed < 0:
            raise OptionError(f"--seed: found {self.seed}; valid are integers from 0 up")
        if self.crop is not None and len(self.crop) != 6:
            raise OptionError(f"--crop: found {len(self.crop)} numbers; valid are six: x0,y0,z0,x1,y1,z1 [m]")


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
