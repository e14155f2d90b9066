"""The object's own materials on the page, and the ground with its shadow."""

from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet

from anymesh.viewer.looks import SIDE, Shadow, ground_lines, has_looks, round_length

MESH = cabinet().mesh


def test_materials_are_shown_where_they_tell_more_than_one_colour():
    assert has_looks(MESH)
    assert not has_looks(replace(MESH, materials=(), face_material=np.full(len(MESH.faces), -1), corner_color=None))
    white = np.full((len(MESH.faces), 3, 4), 255, np.uint8)
    plain = replace(MESH, materials=(), face_material=np.full(len(MESH.faces), -1), corner_color=white)
    assert not has_looks(plain)
    white[0, 0, 0] = 0
    assert has_looks(plain)


def test_a_shadow_lies_below_the_object_and_follows_its_parts():
    shadow = Shadow(MESH, cabinet().segmentation.face_part)
    rest = shadow.picture({})[..., 3]
    low, high = (MESH.bounds[:, :2] - shadow.center[:2]) / shadow.side + 0.5
    below = rest[int(SIDE * low[1]) : int(SIDE * high[1]), int(SIDE * low[0]) : int(SIDE * high[0])]
    assert below.mean() > 40
    assert rest[:3].max() < 10
    away = np.eye(4)
    away[1, 3] = -0.3 * MESH.diagonal  # the drawer, towards -y, which is up in the picture
    moved = shadow.picture({2: away})[..., 3].astype(int) - rest
    rows = np.argwhere(moved > 15)[:, 0]
    assert len(rows) > 50
    assert rows.mean() < SIDE / 2


@pytest.mark.parametrize(("length", "near"), [(0.011, 0.01), (0.24, 0.2), (0.4, 0.5), (8.0, 10.0), (1500.0, 2000.0)])
def test_lines_of_the_ground_are_a_round_length_apart_and_fade_out(length, near):
    assert round_length(length) == pytest.approx(near)
    lines, fade = ground_lines(8 * length)
    assert fade.max() > 0.9
    assert (fade[np.linalg.norm(lines, axis=2) > 1.6 * 8 * length] == 0).all()
