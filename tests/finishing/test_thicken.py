"""Parts as they are sent to a model that fails on thin ones: thick enough, and unmoved where they are seen."""

import numpy as np
import pytest
from assets import box

from anymesh.finishing.holopart import Thickened, thicken
from anymesh.geometry.topology import components


def triangles(piece) -> np.ndarray:
    return piece[0][piece[1]]


def volume(found: Thickened) -> float:
    t = found.mesh.triangles
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def front(piece) -> np.ndarray:
    t = triangles(piece)
    return t[(t[:, :, 1] == piece[0][:, 1].min()).all(1)]


def test_a_sheet_gets_a_back_behind_it_and_is_closed() -> None:
    sheet = front(box((0, 0, 0), (0.5, 0.3, 1)))
    found = thicken(sheet, 0.04)
    assert not found.closed
    assert found.added == pytest.approx(0.04, rel=0.03)
    parts = components(found.mesh.vertices, found.mesh.faces)
    assert (parts.solid & parts.agree).all()
    assert volume(found) == pytest.approx(0.5 * 1 * found.added)
    assert found.mesh.vertices[:, 1].min() == 0, "what is seen of it stays where it is"
    np.testing.assert_allclose(np.sort(found.mesh.triangles[:2].reshape(-1, 3), 0), np.sort(sheet.reshape(-1, 3), 0))


def test_a_sheet_with_a_hole_gets_walls_in_it() -> None:
    x, z = np.meshgrid(np.arange(5.0), np.arange(5.0))
    points = np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], 1)
    cells = [(i, j) for i in range(4) for j in range(4) if (i, j) != (1, 2)]
    quads = np.array([(5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5) for i, j in cells])
    found = thicken(points[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])], 0.05)
    parts = components(found.mesh.vertices, found.mesh.faces)
    assert (parts.solid & parts.agree).all()
    assert volume(found) == pytest.approx(15 * found.added)


def test_a_thin_solid_is_stretched_about_its_middle() -> None:
    found = thicken(triangles(box((0, 0.10, 0), (0.5, 0.11, 1))), 0.04)
    assert found.closed
    y = found.mesh.vertices[:, 1]
    assert (y.min() + y.max()) / 2 == pytest.approx(0.105, abs=1e-3)
    assert np.ptp(y) == pytest.approx(0.04, rel=0.05)
    assert np.ptp(found.mesh.vertices[:, [0, 2]], axis=0) == pytest.approx([0.5, 1.0], rel=1e-3)


def test_what_is_thick_enough_is_left() -> None:
    for piece in (box((0, 0, 0), (0.5, 0.3, 1)), box((0, 0, 0), (0.05, 0.3, 1))):
        found = thicken(triangles(piece), 0.04)
        assert found.added == 0
        assert volume(found) == pytest.approx(float(np.prod(np.ptp(piece[0], axis=0))))


def test_a_handle_does_not_make_a_door_thick() -> None:
    sheet = front(box((0, 0, 0), (0.5, 0.3, 1)))
    handle = triangles(box((0.4, -0.06, 0.5), (0.42, -0.04, 0.54)))
    assert thicken(np.concatenate([sheet, handle]), 0.04).added > 0.03
