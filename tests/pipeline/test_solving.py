"""Test the answered size: it sets the scale of files without a unit, and gives a warning if it contradicts a unit."""

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.solving import Solver
from anymesh.types.motion import Recognition

MESH, _ = mesh_of([box((0, 0, 0), (1, 1, 0.5))])


class Sees:
    """Answers that the object is a box of some length."""

    name, exchanges, warnings = "sees", (), ()

    def __init__(self, size: float) -> None:
        self.size = size

    def ask(self, question):
        return Recognition("box", self.size, ())


def test_only_where_pictures_are_answered_seams_closed_in_places_divide_the_surface() -> None:
    assert Solver(MESH, answerer_factory=lambda _: Sees(1.0)).geometry.config.patches.seams
    assert not Solver(MESH).geometry.config.patches.seams


@pytest.mark.parametrize(
    ("size", "metric", "scale", "doubted"),
    [
        (1.2, False, 1.0, False), (3.0, False, 3.0, False), (20.0, False, 20.0, True),
        (1.2, True, 1.0, False), (2.0, True, 1.0, False), (3.0, True, 1.0, True), (0.1, True, 1.0, True),
    ],
)  # fmt: skip
def test_an_answered_size_sets_the_scale_unless_the_file_has_a_unit(
    size: float, metric: bool, scale: float, doubted: bool
) -> None:
    found = Solver(MESH, answerer_factory=lambda _: Sees(size)).recognize(sized=True, metric=metric)
    assert found.scale == pytest.approx(scale)
    assert bool(found.warnings) is doubted
    if doubted:
        assert "give --scale" in found.warnings[0]
        assert ("unit was kept" in found.warnings[0]) is metric
    assert Solver(MESH, answerer_factory=lambda _: Sees(size)).recognize(metric=metric).scale == 1.0  # the user gave the scale


def test_files_say_whether_they_have_a_unit(tmp_path) -> None:
    import trimesh

    shape = trimesh.creation.box((0.4, 0.3, 0.2))
    for name, metric in (("a.glb", True), ("a.obj", False), ("a.stl", False)):
        shape.export(tmp_path / name)
        loaded = load_mesh(tmp_path / name)
        assert place_mesh(loaded).metric is metric
        assert place_mesh(loaded, scale="0.5").metric is False
    shape.apply_scale(1e5)
    shape.export(tmp_path / "b.glb")
    placed = place_mesh(load_mesh(tmp_path / "b.glb"))
    assert not placed.metric  # its unit was implausible
    assert np.linalg.norm(placed.mesh.extents) == pytest.approx(1.0)
