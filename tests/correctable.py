"""Outputs on disk to correct."""

import atexit
import shutil
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from assets import cabinet

from anymesh.export import write_asset
from anymesh.pipeline.results import CompletionResult, JointResult, LoadResult, SegmentationResult
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.stage_files import COMPLETION, JOINTS, MESH, SEGMENTATION
from anymesh.types import Asset


@cache
def _template(finished: bool) -> Path:
    """An output that others are copied from, until the end of the process."""
    folder = Path(mkdtemp(prefix="correctable-"))
    atexit.register(shutil.rmtree, folder, True)
    return _written(folder / "out", cabinet(), finished)


def write_output(target: Path, *, finished: bool = False, asset: Asset | None = None) -> Path:
    """The cabinet, or an asset, as an output folder, with a Stage C that adds nothing when `finished`."""
    if asset is not None:
        return _written(target, asset, finished)
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copytree(_template(finished), target)
    return target


def _written(target: Path, asset: Asset, finished: bool) -> Path:
    source = target.parent / "in" / "mesh.glb"
    source.parent.mkdir(exist_ok=True, parents=True)
    source.write_bytes(b"mesh")
    with RunFolder.create(target, source=source) as run:
        run.save(MESH, "m", LoadResult(asset.mesh, asset.source, ()))
        run.save(SEGMENTATION, "s", SegmentationResult(asset.segmentation, "geometry"))
        run.save(JOINTS, "j", JointResult(asset.joints, "geometry", ("joint hinge: low confidence (0.20), please check",)))
        if finished:
            same = np.arange(len(asset.mesh.faces))
            run.save(COMPLETION, "c", CompletionResult(asset.mesh, asset.segmentation.face_part, same, ("walls",)))
        write_asset(run.asset(), run.folder)
    return target
