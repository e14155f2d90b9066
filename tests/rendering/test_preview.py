"""The picture of a result."""

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of, slanted, source
from PIL import Image

from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering import preview
from anymesh.rendering.marks import AXIS_COLOR, axis_shapes
from anymesh.types import Asset, Part, Segmentation

SIZE = 150


@pytest.fixture(autouse=True)
def _small(monkeypatch):
    monkeypatch.setattr(preview, "SIZE", SIZE)


def panels(asset):
    picture = preview.render_preview(asset).astype(int)
    return [picture[:SIZE, k * SIZE : (k + 1) * SIZE] for k in range(3)]


def axis_pixels(panel) -> np.ndarray:
    return np.argwhere(np.abs(panel - AXIS_COLOR).sum(-1) < 6)[:, ::-1]


def only(*moving):
    """The cabinet with its other joints fixed."""
    joints = cabinet().joints
    fixed = [joint(j.name, "fixed", j.parent, j.child, j.origin, j.axis, None) for j in joints]
    return cabinet(joints=tuple(j if j.name in moving else f for j, f in zip(joints, fixed, strict=True)))


def test_the_picture_is_a_png_of_three_panels_and_a_legend(tmp_path):
    for asset, rows in ((cabinet(), 1), (slanted(), 2)):
        preview.write_preview(asset, tmp_path / "preview.png")
        with Image.open(tmp_path / "preview.png") as picture:
            assert picture.format == "PNG"
            assert picture.size == (3 * SIZE, SIZE + 20 + 30 * rows)
            legend = np.asarray(picture)[SIZE:]
        assert (legend == 255).all(-1).mean() < 0.99


def test_joints_are_drawn_on_the_parts_and_only_those_that_move():
    looks, rest, opened = panels(cabinet())
    assert len(axis_pixels(looks)) == 0
    assert min(len(axis_pixels(rest)), len(axis_pixels(opened))) > 60
    fixed = panels(only())
    assert sum(len(axis_pixels(p)) for p in fixed) == 0
    np.testing.assert_array_equal(fixed[1], fixed[2])
    assert (rest != opened).any(-1).mean() > 0.05


@pytest.mark.parametrize("name", ["hinge", "slide"])
def test_an_axis_is_drawn_where_it_is(name):
    asset = only(name)
    j = next(j for j in asset.joints if j.name == name)
    opened = posed(asset, {name: preview.shown_position(j)})
    camera = preview.best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])
    part = asset.segmentation.faces([p.name for p in asset.segmentation.parts].index(j.child))
    through = j.origin if name == "hinge" else asset.mesh.triangles[part].mean((0, 1))
    (start, end), _ = camera.project(np.stack([through, through + 0.3 * j.axis]))
    along = (end - start) / np.linalg.norm(end - start)
    offset = axis_pixels(panels(asset)[1]) + 0.5 - start
    assert len(offset) > 20
    assert (np.abs(offset @ [-along[1], along[0]]) < 0.06 * SIZE).all()
    assert np.ptp(offset @ along) > 0.1 * SIZE


def test_an_axis_rides_on_its_parent():
    for moving, same in ((("slide", "hinge"), True), (("slide", "turn"), False)):
        _, rest, opened = panels(only(*moving))
        assert np.array_equal(axis_pixels(rest), axis_pixels(opened)) == same


def test_parts_have_colours_of_their_own():
    asset = slanted()
    colors = preview.part_colors(asset)
    per_part = [np.unique(colors[asset.segmentation.faces(k)], axis=0) for k in range(5)]
    assert all(len(c) == 1 for c in per_part)
    assert len(np.unique(np.concatenate(per_part), axis=0)) == 5
    np.testing.assert_array_equal(per_part[0][0], preview.BASE)


def test_the_opened_pose_lies_within_the_limits_on_the_wider_side():
    for j in (*cabinet().joints, *slanted().joints):
        at = preview.shown_position(j)
        low, high = j.limits or (-np.pi, np.pi)
        assert low <= at <= high
        assert (at == 0) == (j.type == "fixed")
        assert at * (high + low) >= 0


@pytest.mark.parametrize("azimuth", [0.0, 0.6, 2.5, -1.9])
def test_the_camera_sees_the_whole_box_and_azimuth_0_looks_along_y(azimuth):
    low, high = np.array([1.0, 2, 3]), np.array([1.5, 5, 4])
    camera = preview.orbit_camera(np.stack([low, high]), azimuth, 0.4, 100)
    pixel, depth = camera.project(box(low, high)[0])
    assert (depth > 0).all()
    assert pixel.min() >= 0
    assert pixel.max() <= 100
    assert np.ptp(pixel, axis=0).max() > 50
    forward = camera.T_world_camera[:3, 2]
    np.testing.assert_allclose(np.arctan2(-forward[0], forward[1]), azimuth, atol=1e-9)
    assert forward[2] == pytest.approx(-np.sin(0.4))


def test_the_view_is_from_the_side_of_the_moving_part():
    for y in (-0.1, 1.0):
        mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0.3, y, 0.3), (0.7, y + 0.1, 0.7))])
        slide = joint("s", "prismatic", "a", "b", (0.5, y, 0.5), (0, 1 if y > 0 else -1, 0), (0.0, 0.2))
        asset = Asset("a", source(), mesh, Segmentation(number, (Part("a", "base"), Part("b", "button"))), (slide,), "test")
        opened = posed(asset, {"s": 0.2})
        scenes = [RayScene(m.vertices, m.faces) for m in (mesh, opened)]
        camera = preview.best_camera(asset, opened, scenes)
        assert (camera.T_world_camera[1, 3] - 0.5) * y > 0


def test_a_joint_is_told_in_its_units():
    hinge, slide, turn = cabinet().joints
    assert preview.describe(hinge, 1.0) == "door: revolute 0..109 deg, confidence 0.90"
    assert preview.extent(slide) == "0.0..30.0 cm"
    assert preview.extent(turn) == "endless"
    assert preview.extent(slanted().joints[3]) == ""


def test_legend_colours_are_those_of_the_parts():
    asset = cabinet()
    turned = cabinet(joints=asset.joints[::-1])
    first = {j.child: preview.PALETTE[k] for k, j in enumerate(asset.joints)}
    picture = preview.render_preview(turned)
    for k, j in enumerate(turned.joints):
        x = 20 + k * (picture.shape[1] // 3)
        np.testing.assert_array_equal(picture[SIZE + 20, x + 8], first[j.child])


def test_everything_that_moves_lies_in_the_window():
    """The door of the cabinet opens beyond the box at rest; no panel cuts it off."""
    opened = panels(cabinet())[2]
    border = np.concatenate([opened[0], opened[-1], opened[:, 0], opened[:, -1]])
    assert np.ptp(border, axis=1).max() == 0, "only the grey ground"


def keyboard(front: float | None = None):
    """Return a cabinet side with a door, sixteen small buttons, a large slider, a knob on its back, and the pieces of each."""
    keys = [
        box((0.1 + 0.05 * i, -0.01, 0.5 + 0.05 * k), (0.12 + 0.05 * i, 0, 0.52 + 0.05 * k)) for i in range(4) for k in range(4)
    ]
    others = [
        box((0.5, -0.02, 0.1), (0.95, 0, 0.9)),
        box((0.1, -0.02, 0.1), (0.4, 0, 0.4)),
        box((0.5, 1, 0.5), (0.52, 1.02, 0.52)),
    ]
    mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), *keys, *others])
    names = ["base", *(f"part_{k}" for k in range(1, 20))]
    outwards = [(0, 1 if k == 19 else -1, 0) for k in range(1, 20)]
    joints = tuple(
        joint(f"j{k}", "prismatic", "base", names[k], mesh.triangles[number == k].mean((0, 1)), y, (0.0, 0.01))
        for k, y in enumerate(outwards, 1)
    )
    parts = tuple(Part(name, "part") for name in names)
    return Asset("panel", source(), mesh, Segmentation(number, parts), joints, "test", front=front)


def test_nineteen_parts_have_colours_of_their_own_and_small_ones_close_ups(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(preview, "SIZE", 400)
    asset = keyboard()
    table = np.unique(preview.part_colors(asset), axis=0).astype(int)
    assert len(table) == 20
    gaps = np.abs(table[:, None] - table).sum(-1) + 999 * np.eye(20, dtype=int)
    assert gaps.min() > 40
    found = []
    insets = preview._insets
    monkeypatch.setattr(preview, "_insets", lambda *given: found.append(insets(*given)) or found[-1])
    picture = preview.render_preview(asset)
    ((row,), alone) = found[0]
    assert alone == {*range(1, 17), 19}  # the last one is at the back
    assert row.shape == (picture.shape[1] // preview.MAX_INSETS, picture.shape[1], 3)
    preview.render_preview(cabinet())
    assert found[1] == ([], set())


def test_arrows_of_small_parts_are_small() -> None:
    asset = keyboard()
    lengths = [float(np.linalg.norm(np.diff(s.arrow, axis=0))) for s in axis_shapes(asset, {})]
    assert max(lengths[:16]) < 0.5 * lengths[16]
    near = [float(np.linalg.norm(np.diff(s.arrow, axis=0))) for s in axis_shapes(asset, {}, 0.0)]
    assert near[0] == pytest.approx(1.3 * 0.06 * 10 * 0.03)  # of a key of 2 x 2 x 1 cm


@pytest.mark.parametrize("front", [None, 0.0, 90.0, 180.0])
def test_the_answered_front_is_shown_whatever_moves_elsewhere(front: float | None) -> None:
    asset = keyboard(front)
    camera = preview.opened_view(asset)[1]
    sight = camera.T_world_camera[:2, 2]
    toward = np.deg2rad(front or 0.0)
    assert sight @ [-np.sin(toward), np.cos(toward)] > 0.3
