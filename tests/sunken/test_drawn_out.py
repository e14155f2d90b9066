"""Test what is drawn out of the bodies that it is sunk into, and which open components others close."""

from __future__ import annotations

import numpy as np
import pytest
from assets import box, mesh_of
from geometry.rigid import shape_of
from sunk import chest, cylinder

from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.topology import triangle_set_of
from anymesh.sunken.drawing import CLEARANCE_RATIO, drawn_out, sealed, set_on

CASE = triangle_set_of((lambda v, f: v[f])(*box((0, 0, 0), (1, 0.5, 1))))


def slab(sunk: float) -> np.ndarray:
    v, f = box((0.1, -0.02, 0.1), (0.9, sunk, 0.9))
    return v[f]


def test_a_sunk_slab_is_set_on_the_body_a_hair_before_it() -> None:
    moved = set_on(slab(0.05), CASE, 1.5, 0.003)
    assert moved is not None
    assert moved[..., 1].max() == pytest.approx(-0.003, abs=1e-6)
    assert moved[..., 1].min() == pytest.approx(-0.02, abs=1e-6)
    assert np.ptp(moved[..., 0]) == pytest.approx(0.8 - 0.006, abs=1e-6)


@pytest.mark.parametrize("sunk", [0.0, 0.001, 0.3], ids=["set on", "touching", "a modelled box"])
def test_what_touches_or_is_as_deep_as_a_box_stays(sunk: float) -> None:
    assert set_on(slab(sunk), CASE, 1.5, 0.003) is None


def test_what_is_sunk_from_above_stays() -> None:
    v, f = box((0.1, 0.1, 0.9), (0.9, 0.4, 1.1))
    assert set_on(v[f], CASE, 1.5, 0.003) is None


def test_what_enters_on_two_sides_stays() -> None:
    v, f = box((-0.1, -0.1, 0.4), (0.2, 0.2, 0.6))
    assert set_on(v[f], CASE, 1.5, 0.003) is None


def test_a_knob_on_a_drawn_front_touches_it() -> None:
    mesh, truth = chest(grid=(1, 1)).mesh()
    shape = drawn_out(mesh_surface(mesh))
    assert shape is not None
    front = shape.triangles[truth.face_part == 1]
    corners = front.reshape(-1, 3)[:, 1]
    assert corners.max() == pytest.approx(-CLEARANCE_RATIO * mesh.diagonal, abs=1e-6)
    assert (np.abs(front[12:, :, 1] + 0.02) < 1e-6).any()  # the knob ends on the face of the drawer
    assert np.array_equal(mesh.vertices, chest(grid=(1, 1)).mesh()[0].vertices)


@pytest.mark.parametrize("bare", [False, True])
def test_what_the_surface_of_others_closes_is_solid(bare: bool) -> None:
    mesh, _ = chest((0.9, 0.45, 0.5), (2, 2), extra="legs, top").mesh(bare=bare)
    surface = mesh_surface(mesh)
    assert surface.shape.solid.all() == (not bare)
    assert sealed(surface).shape.solid.all()


def test_an_open_box_is_no_solid() -> None:
    v, f = box((0, 0, 0), (1, 1, 1))
    lid = box((0, 0, 1.3), (1, 1, 1.4))
    mesh, _ = mesh_of([(v, f[np.delete(np.arange(12), [10, 11])]), lid])
    assert sealed(mesh_surface(mesh)).shape.solid.sum() == 12


def test_a_sheet_on_a_body_is_no_solid() -> None:
    v, f = box((0.1, -0.001, 0.1), (0.9, 0.4, 0.9))
    mesh, _ = mesh_of([box((0, 0, 0), (1, 0.5, 1)), (v, f[4:6])])
    assert sealed(mesh_surface(mesh)).shape.solid.sum() == 12


def test_a_round_knob_keeps_its_outline() -> None:
    v, f = cylinder(0.03, (-0.03, 0.02), 0.5, 0.5)
    moved = set_on(v[f], CASE, 1.5, 0.0)
    assert moved is not None
    assert np.linalg.norm(moved[..., [0, 2]] - 0.5, axis=2).max() == pytest.approx(0.03, abs=1e-6)
    assert shape_of((v, f)).bounds[1, 1] == pytest.approx(0.02)
