"""What was there keeps its look; what is new looks like the visible surface of its part that is nearest."""

from dataclasses import replace

import numpy as np
import pytest
from assets import CABINET, CUBE_FACES, box, cabinet, mesh_of, source
from finished import grown, quad, with_wall

from anymesh.finishing.bake import png
from anymesh.finishing.protocol import Finished
from anymesh.finishing.texture import Carried, Retexturer, paint_new
from anymesh.rendering.render import face_colors
from anymesh.types import Asset, Material, Mesh, Part, Segmentation, Texture

NEW = slice(-2, None)


def painted(finished: Finished) -> Mesh:
    return Carried().retexture(finished).asset.mesh


def test_what_was_there_is_carried_byte_for_byte() -> None:
    before = cabinet().mesh
    after = painted(with_wall())
    count = len(before.faces)
    for name in ("vertices", "faces", "face_material", "corner_uv", "corner_color"):
        kept = getattr(after, name)[: len(before.vertices) if name == "vertices" else count]
        np.testing.assert_array_equal(kept, getattr(before, name))
    assert after.materials == before.materials, "no texture is lost or written anew"
    assert len(face_colors(after)) == count + 2


def test_a_new_wall_looks_like_its_own_part_though_another_is_nearer() -> None:
    found = painted(with_wall())
    assert (found.face_material[NEW] == 0).all(), "the base's wood, not the door's paint"
    wood = face_colors(cabinet().mesh)[0]
    np.testing.assert_array_equal(face_colors(found)[NEW], [wood, wood])


def test_colours_of_the_corners_are_taken_where_there_is_no_material() -> None:
    colors = np.zeros((24, 3, 4), np.uint8)
    colors[:12] = (200, 40, 40, 255)
    colors[12:] = (40, 40, 200, 255)
    mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), box((3, 0, 0), (4, 1, 1))], corner_color=colors)
    asset = Asset("a", source(), mesh, Segmentation(np.zeros_like(number), (Part("p", "p"),)), (), "geometry")
    found = painted(grown(asset, quad((2.8, 0, 0), (2.8, 1, 0), (2.8, 1, 1), (2.8, 0, 1)), 0))
    assert (found.corner_color[NEW] == (40, 40, 200, 255)).all()


def test_a_patch_is_of_one_look_and_a_spot_near_it_is_not_spread() -> None:
    """A plate with a small red spot on it: the wall behind it is the plate's white, all over."""
    plate, spot = box((0, 0, 0), (1, 1, 0.1)), box((0.45, 0.45, 0.05), (0.55, 0.55, 0.09))
    colors = np.full((24, 3, 4), 255, np.uint8)
    colors[12:] = (255, 0, 0, 255)
    mesh, number = mesh_of([plate, (spot[0] - [0, 0, 0.06], spot[1])], corner_color=colors)
    asset = Asset("a", source(), mesh, Segmentation(np.zeros_like(number), (Part("p", "p"),)), (), "geometry")
    found = painted(grown(asset, quad((0.4, 0.4, -0.1), (0.6, 0.4, -0.1), (0.6, 0.9, -0.1), (0.4, 0.9, -0.1)), 0))
    assert (found.corner_color[NEW] == 255).all()


def test_an_unseen_surface_is_no_model() -> None:
    """A red block closed up in a white box: a wall that is nearer to the block is white all the same."""
    colors = np.full((24, 3, 4), 255, np.uint8)
    colors[12:] = (255, 0, 0, 255)
    mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1)), box((0.4, 0.4, 0.4), (0.6, 0.6, 0.6))], corner_color=colors)
    asset = Asset("a", source(), mesh, Segmentation(np.zeros_like(number), (Part("p", "p"),)), (), "geometry")
    found = painted(grown(asset, quad((0.4, 0.35, 0.4), (0.6, 0.35, 0.4), (0.6, 0.35, 0.6), (0.4, 0.35, 0.6)), 0))
    assert (found.corner_color[NEW] == 255).all()


def test_a_face_on_the_old_surface_goes_on_with_its_texture() -> None:
    """A quarter of the door's front, made anew: its corners have the texture coordinates that were there."""
    door = CABINET["door"][0][0]
    low, high = door.min(0), door.max(0)
    mid = (low + high) / 2
    new = quad((low[0], low[1], low[2]), (mid[0], low[1], low[2]), (mid[0], low[1], mid[2]), (low[0], low[1], mid[2]))
    asset = cabinet()
    found = painted(grown(asset, new, 1))
    uv, at = found.corner_uv[NEW].reshape(-1, 2), new.reshape(-1, 3)
    front = np.flatnonzero((asset.segmentation.face_part == 1) & (asset.mesh.face_normals[:, 1] < -0.9))
    corners, known = asset.mesh.triangles[front].reshape(-1, 3), asset.mesh.corner_uv[front].reshape(-1, 2)
    design = np.c_[corners[:, [0, 2]], np.ones(len(corners))]
    expected = np.c_[at[:, [0, 2]], np.ones(6)] @ np.linalg.lstsq(design, known, rcond=None)[0]
    np.testing.assert_allclose(uv, expected, atol=1e-5)
    assert (found.face_material[NEW] == 1).all()


def test_a_part_that_is_all_new_looks_like_its_neighbour() -> None:
    asset = cabinet()
    finished = grown(asset, quad((0, 0, 2), (1, 0, 2), (1, 1, 2), (0, 1, 2)), 1)
    source_face = np.where(asset.segmentation.face_part == 1, -1, np.arange(len(asset.mesh.faces)))
    mesh, _ = paint_new(finished.asset.mesh, finished.asset.segmentation.face_part, np.r_[source_face, -1, -1] < 0)
    assert (mesh.face_material[NEW] == 0).all()


def test_nothing_new_changes_nothing() -> None:
    asset = cabinet()
    found = Carried().retexture(Finished(asset, np.arange(len(asset.mesh.faces))))
    assert found.asset is asset
    assert found.notes == ()


def test_a_note_says_what_was_painted() -> None:
    assert Carried().retexture(with_wall()).notes == (
        "2 new faces in 1 patches look like the nearest visible surface of their part",
    )
    assert isinstance(Carried(), Retexturer)


@pytest.mark.parametrize("size", [3.0, 1e-3])
def test_the_look_does_not_depend_on_size_or_place(size: float) -> None:
    T = np.diag([size, size, size, 1.0])
    T[:3, 3] = (5, -3, 1)
    finished = with_wall()
    moved = replace(finished, asset=replace(finished.asset, mesh=finished.asset.mesh.transformed(T)))
    np.testing.assert_array_equal(face_colors(painted(moved)), face_colors(painted(finished)))


def test_a_texture_that_cannot_be_spread_gives_its_middle_colour() -> None:
    """A wall that is dark on six tenths, grey on one and white on three: what is behind it is dark, not the grey mean."""
    stripes = np.array([[0, 0, 255, 0, 0, 255, 120, 0, 0, 255]], np.uint8)[..., None].repeat(3, 2)
    material = Material("stripes", (1.0, 1.0, 1.0, 1.0), textures={"base_color": Texture(png(stripes), "image/png")})
    uv = box((0, 0, 0), (1, 1, 1))[0][CUBE_FACES][..., [0, 2]].astype(np.float32)
    mesh, number = mesh_of([box((0, 0, 0), (1, 1, 1))], np.zeros(12, int), materials=(material,), corner_uv=uv)
    asset = Asset("a", source(), mesh, Segmentation(np.zeros_like(number), (Part("p", "p"),)), (), "geometry")
    found = painted(grown(asset, quad((0.1, 0.05, 0.1), (0.9, 0.05, 0.1), (0.9, 0.05, 0.9), (0.1, 0.05, 0.9)), 0))
    np.testing.assert_array_equal(face_colors(found)[NEW], [[0, 0, 0]] * 2)
