"""Things added to a sample keep its own surface and truth, move with what carries them, and look as they should."""

from pathlib import Path

import numpy as np
import pytest

from anymesh.evaluation.changes import changed
from anymesh.evaluation.details import (
    COUNTS,
    FLOOR_DEPTH,
    FLOOR_SIDES,
    GAPS,
    LOOSE_COUNTS,
    LOOSE_HEIGHTS,
    LOOSE_SIDES,
    SIDES,
    UNEVEN,
)
from anymesh.evaluation.ground_truth import EvalSample, example_truths, prepared
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.topology import components
from anymesh.types import Mesh


@pytest.fixture(scope="module")
def sample() -> EvalSample:
    truths = {t.name: t for t in example_truths(Path(__file__).parents[2] / "examples")}
    return prepared(truths["bookcase"])


def things(new: EvalSample, old: EvalSample) -> list[np.ndarray]:
    """Return the numbers of the faces of each thing that was added."""
    count = len(old.mesh.faces)
    label = components(new.mesh.vertices, new.mesh.faces[count:]).label
    return [count + np.flatnonzero(label == k) for k in range(label.max() + 1)]


@pytest.mark.parametrize("name", ["detailed", "furnished", "floored"])
def test_the_object_itself_and_its_truth_are_kept(name: str, sample: EvalSample) -> None:
    new = changed(name, sample)
    count = len(sample.mesh.faces)
    assert new.truth is sample.truth
    assert (new.mesh.triangles[:count] == sample.mesh.triangles).all()
    assert (new.labels[:count] == sample.labels).all()
    assert new.mesh.vertices.tolist() == changed(name, sample).mesh.vertices.tolist()
    for faces in things(new, sample):
        assert len(set(new.labels[faces])) == 1
        assert components(new.mesh.vertices, new.mesh.faces[faces]).solid.all()


def _distance(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    return distance_to_mesh(points, mesh.vertices, mesh.faces)[0]


def test_details_are_small_and_lie_on_their_link(sample: EvalSample) -> None:
    new, mesh = changed("detailed", sample), sample.mesh
    found = things(new, sample)
    assert COUNTS[0] <= len(found) <= COUNTS[1]
    for faces in found:
        corners = new.mesh.triangles[faces].reshape(-1, 3)
        assert np.linalg.norm(np.ptp(corners, axis=0)) < 2 * SIDES[1] * mesh.diagonal
        link = mesh.subset(sample.labels == new.labels[faces[0]])
        assert _distance(link, corners).min() <= 1.01 * GAPS[1] * mesh.diagonal


def test_loose_things_stand_on_their_link_and_cross_nothing(sample: EvalSample) -> None:
    new, mesh = changed("furnished", sample), sample.mesh
    scene, found = RayScene(mesh.vertices, mesh.faces), things(new, sample)
    assert 1 <= len(found) <= LOOSE_COUNTS[1]
    for faces in found:
        corners = np.unique(new.mesh.triangles[faces].reshape(-1, 3), axis=0)
        height = (corners - corners.min(0)) @ sample.up
        assert LOOSE_HEIGHTS[0] <= height.max() / mesh.diagonal <= LOOSE_HEIGHTS[1]
        assert np.ptp(corners[:, :2], axis=0).max() <= LOOSE_SIDES[1] * mesh.diagonal
        foot = corners[height < 0.5 * height.max()]
        assert _distance(mesh, foot).max() <= UNEVEN * height.max()
        link = mesh.subset(sample.labels == new.labels[faces[0]])
        assert _distance(link, foot.mean(0)[None]).max() <= UNEVEN * height.max()
        middle, top = corners.mean(0), corners[height > 0.5 * height.max()]
        assert (scene.first_hit(np.tile(middle, (len(top), 1)), 0.95 * (top - middle), 1.0).face < 0).all()


def test_the_floor_is_a_slab_under_the_root(sample: EvalSample) -> None:
    new, mesh = changed("floored", sample), sample.mesh
    (slab,) = things(new, sample)
    assert set(new.labels[slab]) == {0}
    low, high = new.mesh.triangles[slab].min((0, 1)), new.mesh.triangles[slab].max((0, 1))
    assert high[2] == pytest.approx(mesh.vertices[:, 2].min())
    assert (high - low)[2] == pytest.approx(FLOOR_DEPTH * mesh.diagonal)
    assert ((FLOOR_SIDES[0] * mesh.diagonal <= (high - low)[:2]) & ((high - low)[:2] <= FLOOR_SIDES[1] * mesh.diagonal)).all()
    assert (low[:2] < mesh.vertices.min(0)[:2]).all()
    assert (high[:2] > mesh.vertices.max(0)[:2]).all()
