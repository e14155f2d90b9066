"""New faces enter no other part, at rest or on its way, and stay inside the object."""

from dataclasses import replace

import numpy as np
import pytest
from assets import joint
from surfaces import SIZE, asset_of, part_triangles, plate, shell

from anymesh.finishing.complete import complete_shapes
from anymesh.finishing.entering import Faces, crossing
from anymesh.geometry.distance_ import distance_to_triangles, winding_number
from anymesh.geometry.kinematics import posed
from anymesh.types import Asset


@pytest.mark.parametrize(
    ("shift", "crosses"), [((0, 0, 0.5), True), ((0, 0, 0.0005), False), ((1, 0, 0.5), False), ((0, 0, 2), False)]
)
def test_faces_that_touch_or_share_an_edge_do_not_cross(shift, crosses):
    flat = np.array([[[0, 0, 0], [1, 0, 0], [0, 1.0, 0]]])
    upright = np.array([[[0.2, 0.2, -1], [0.3, 0.2, -1], [0.2, 0.3, 0.0]]])
    assert crossing(Faces(flat, 1e-3), Faces(upright + shift, 1e-3), np.eye(4)).any() == crosses


def flat(door: str) -> Asset:
    """A case of thin sheet whose open front is shut by sheets: one or two doors in the plane of its rim, or behind it."""
    x, _, z = SIZE
    case = shell((0, 0, 0), SIZE, "-y")
    hinge = joint("right", "revolute", "case", "right", (x, 0, z / 2), (0, 0, 1), (0.0, 1.6))
    if door == "inset":
        right = plate((0.003, 0.001, 0.003), (x - 0.003, 0.001, z - 0.003))
        return asset_of({"case": case, "right": right}, [hinge])
    if door == "one":
        return asset_of({"case": case, "right": plate((0, 0, 0), (x, 0, z))}, [hinge])
    halves = {"right": plate((x / 2, 0, 0), (x, 0, z)), "left": plate((0, 0, 0), (x / 2, 0, z))}
    other = joint("left", "revolute", "case", "left", (0, 0, z / 2), (0, 0, -1), (0.0, 1.6))
    return asset_of({"case": case, **halves}, [hinge, other])


def depth_inside(asset: Asset, a: str, b: str) -> float:
    """How deep corners and middles of one part's faces lie inside another one [m]."""
    points, t = part_triangles(asset, a), part_triangles(asset, b)
    points = np.concatenate([points.reshape(-1, 3), points.mean(1), (points + np.roll(points, 1, axis=1)).reshape(-1, 3) / 2])
    inside = np.abs(winding_number(points, t.reshape(-1, 3), np.arange(3 * len(t)).reshape(-1, 3))) > 0.5
    return float(distance_to_triangles(points[inside], t).max()) if inside.any() else 0.0


@pytest.mark.parametrize("door", ["one", "two", "inset"])
def test_new_faces_enter_no_other_part_at_rest_or_open(door):
    asset = flat(door)
    found = complete_shapes(asset)
    assert all(any("back" in note or "skin" in note for note in found.notes[p.name]) for p in asset.segmentation.parts)
    for amount in (0.0, 0.1, 0.5, 1.6):
        opened = replace(found.asset, mesh=posed(found.asset, {j.name: amount for j in asset.joints}))
        for j in asset.joints:
            assert depth_inside(opened, j.child, "case") < 5e-4
            assert depth_inside(opened, "case", j.child) < 5e-4
    points = found.asset.mesh.vertices
    assert (points > asset.mesh.bounds[0] - 1e-9).all()
    assert (points < asset.mesh.bounds[1] + 1e-9).all()


def test_a_skin_stays_inside_where_the_sheet_is_folded():
    """The rim of a case has a lip that turns back, 2 mm from its wall; a skin of a full wall would come out there."""
    lip = 0.002
    rim = shell((0, 0, 0), SIZE, "-y")
    front = [plate((0, 0, 0), (lip, 0, SIZE[2])), shell((lip, 0, 0), (lip, 0.03, SIZE[2]), "-y")[[0, 1]][:, ::-1]]
    asset = asset_of({"case": np.concatenate([rim, *front])})
    found = complete_shapes(asset)
    assert found.notes["case"]
    points = found.asset.mesh.vertices
    assert (points > asset.mesh.bounds[0] - 1e-9).all()
    assert (points < asset.mesh.bounds[1] + 1e-9).all()
