"""Command line of `anymesh scan`: fusion of posed pictures with depth into a mesh."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from anymesh.cli.options import Force, Json, Quiet, Seed
from anymesh.cli.output import Shown, plain

if TYPE_CHECKING:
    from anymesh.applications.scan import ScanReport

Recording = Annotated[
    Path,
    typer.Argument(
        metavar="INPUT",
        help="Folder with frames.json, transforms.json (nerfstudio), keyframes/ (Polycam), sparse/ (COLMAP) or "
        "rgbd/ (Record3D), or an .r3d file.",
    ),
]
File = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help="The .glb file; FILE's name.scan.json is written beside.")
]
Voxel = Annotated[float | None, typer.Option(metavar="METRES", help="Size of a voxel; default: 1/400 of the object.")]
Scale = Annotated[float | None, typer.Option(metavar="FACTOR", help="Metres per unit of the poses; required for COLMAP.")]
DepthScale = Annotated[float | None, typer.Option("--depth-scale", metavar="FACTOR", help="Metres per unit of the depth maps.")]
DepthMax = Annotated[float, typer.Option("--depth-max", metavar="METRES", help="Depth beyond it is ignored.")]
Crop = Annotated[str, typer.Option(metavar="X0,Y0,Z0,X1,Y1,Z1", help="Region of the recording's world that is used [m].")]
KeepFloor = Annotated[bool, typer.Option("--keep-floor", help="Keep everything: search for no floor or table.")]
Faces = Annotated[int, typer.Option(help="Approximate number of faces after simplification.")]


def scan(
    recording: Recording,
    out: File,
    voxel: Voxel = None,
    scale: Scale = None,
    depth_scale: DepthScale = None,
    depth_max: DepthMax = 5.0,
    crop: Crop = "",
    keep_floor: KeepFloor = False,
    faces: Faces = 100_000,
    seed: Seed = 0,
    force: Force = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Fuses posed pictures with depth in INPUT to a mesh in metres that `anymesh articulate` takes: one object, no floor."""
    from anymesh.applications.scan import scan as run

    with Shown(quiet or json_) as progress:
        report = run(
            recording, out, voxel=voxel, scale=scale, depth_scale=depth_scale, depth_max=depth_max, crop=_box(crop),
            keep_floor=keep_floor, faces=faces, seed=seed, force=force, progress=progress,
        )  # fmt: skip
    if json_:
        typer.echo(json.dumps(asdict(report) | {"out": str(out)}, indent=2))
    elif not quiet:
        typer.echo("\n".join(plain(line) for line in _lines(report, out)))


def _box(crop: str) -> tuple[float, ...] | None:
    from anymesh.errors import OptionError

    try:
        return tuple(float(v) for v in crop.split(",")) if crop else None
    except ValueError:
        raise OptionError(f"--crop: found {crop!r}; valid are six numbers x0,y0,z0,x1,y1,z1 [m]") from None


def _lines(report: ScanReport, out: Path) -> list[str]:
    x, y, z = report.extents
    used = f"{report.frames} frames ({report.layout}), {len(report.dropped)} left out"
    agree = f"; they differ by {report.disagreement:.2%} of the depth"
    size = f"{x:.3f} x {y:.3f} x {z:.3f} m, {report.faces} faces, voxels of {1000 * report.voxel:.2f} mm; floor {report.floor}"
    left = sum(not h.closed for h in report.holes)
    holes = f"{left} holes are open ({report.open_share:.1%} of the surface); {report.closed_holes} small ones were closed"
    largest = [
        f"  hole of {1e4 * h.area:.0f} cm2 at {', '.join(f'{v:.2f}' for v in h.middle)} m{', closed' if h.closed else ''}"
        for h in report.holes[:3]
    ]
    return [*(f"warning: {w}" for w in report.warnings), used + agree, size, holes, *largest, f"wrote {out}"]
