"""A fused surface whose every crease is rounded, as a scan's or a generated mesh's: the parts still come out."""

from dataclasses import replace
from pathlib import Path

import igl
import numpy as np
import pytest
import trimesh

from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.score import same_motion, score
from anymesh.loading import load_mesh
from anymesh.pipeline.solving import solve

EXAMPLES = Path(__file__).parents[1] / "examples"


def softened(truth: GroundTruth, path: Path) -> GroundTruth:
    """Refined to edges of 1.2 % of the diagonal and smoothed ten times without shrinking (Taubin)."""
    mesh = load_mesh(truth.mesh).mesh
    welded = trimesh.Trimesh(mesh.vertices, mesh.faces, merge_tex=True, merge_norm=True)
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(welded.vertices, welded.faces, 0.012 * mesh.diagonal))
    fine.merge_vertices()
    nearest = igl.point_mesh_squared_distance(fine.triangles_center, mesh.vertices, mesh.faces.astype(np.int64))[1]
    trimesh.smoothing.filter_taubin(fine, iterations=10)
    fine.export(path)
    return replace(truth, mesh=path, labels=truth.labels[nearest])


@pytest.mark.slow
def test_a_cabinet_without_a_sharp_edge(tmp_path: Path) -> None:
    truth = softened(next(t for t in example_truths(EXAMPLES) if t.name == "cabinet_fused"), tmp_path / "soft.glb")
    sample = prepared(truth)
    result = score(sample, *solve(sample.mesh))
    assert result.f1 >= 0.9
    for joint in result.joints:
        assert joint.iou >= 0.8
        assert joint.type_found is not None
        assert same_motion(joint.type_true, joint.type_found)
        assert joint.opens_right
