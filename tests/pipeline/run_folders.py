"""Output folders with the results of given assets."""

from pathlib import Path

import pytest
from assets import cabinet

from anymesh.export import write_asset
from anymesh.pipeline.results import JointResult, LoadResult, SegmentationResult
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.stage_files import JOINTS, MESH, SEGMENTATION


def results(asset):
    placed = LoadResult(asset.mesh, asset.source, ("scaled",))
    return placed, SegmentationResult(asset.segmentation, "geometry"), JointResult(asset.joints, "geometry", ("unsure",))


def write_all(target: Path, source: Path, asset=None, *, force=False, export=True) -> None:
    placed, segmented, jointed = results(asset or cabinet())
    with RunFolder.create(target, source=source, force=force) as run:
        run.save(MESH, "m", placed)
        run.save(SEGMENTATION, "s", segmented)
        run.save(JOINTS, "j", jointed)
        run.add_time("joints", 0.5)
        if export:
            write_asset(run.asset(), run.folder)


@pytest.fixture
def source(tmp_path):
    (tmp_path / "in").mkdir()
    path = tmp_path / "in" / "mesh.glb"
    path.write_bytes(b"mesh")
    return path


def files(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
