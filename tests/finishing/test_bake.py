"""Baking keeps the look: pictures before and after differ by what a texel's size explains, and by nothing else."""

import io
from dataclasses import replace

import numpy as np
import pytest
from assets import CABINET, CUBE_FACES, box, cabinet, checker, mesh_of, source
from finished import grown, quad, with_wall
from PIL import Image

from anymesh.errors import OptionError
from anymesh.finishing.bake import Baked, bake, lay_out, png, sampler
from anymesh.finishing.protocol import Finished
from anymesh.finishing.texture import Carried, Retexturer, paint_new
from anymesh.rendering.render import face_colors, render
from anymesh.types import Asset, Material, Mesh, Part, Segmentation, Texture
from anymesh.types.camera import Camera
from anymesh.types.mesh import CLAMP

EYES = ((-1.5, -1.5, 1.2), (1.6, -1.2, 0.3), (0.3, 1.8, 1.5))


def difference(a: Mesh, b: Mesh) -> float:
    """Mean absolute difference of pictures [0..255], where the object is."""
    middle = a.bounds.mean(0)
    found = []
    for eye in EYES:
        camera = Camera.looking_at(middle + np.array(eye), middle, 1.0, 160, 160)
        before, after = render(a, camera), render(b, camera)
        seen = before.face >= 0
        assert (before.face == after.face).all()
        found.append(np.abs(before.color.astype(float) - after.color)[seen].mean())
    return float(np.mean(found))


def picture(mesh: Mesh, slot: str = "base_color") -> np.ndarray:
    with Image.open(io.BytesIO(mesh.materials[0].textures[slot].data)) as image:
        return np.asarray(image)


def test_pictures_stay_and_get_nearer_with_the_size() -> None:
    mesh = cabinet().mesh
    off = [difference(mesh, bake(mesh, size=size)[0]) for size in (64, 256, 512)]
    assert off[0] > off[1] > off[2]
    assert off[2] < 2.0, "the checkers' edges, of 255"
    plain = replace(mesh, materials=tuple(replace(m, textures={}) for m in mesh.materials))
    assert difference(plain, bake(plain, size=128)[0]) < 0.6, "where no texture has edges, rounding alone"


def test_one_material_one_layout_and_the_same_shape() -> None:
    mesh = cabinet().mesh
    baked, notes = bake(mesh, size=256)
    assert [m.name for m in baked.materials] == ["atlas"]
    assert (baked.face_material == 0).all()
    assert baked.corner_color is None
    assert baked.corner_uv is not None
    assert baked.corner_uv.min() > 0
    assert baked.corner_uv.max() < 1
    np.testing.assert_array_equal(baked.vertices, mesh.vertices)
    np.testing.assert_array_equal(baked.faces, mesh.faces)
    assert "256 x 256 px: 60 charts" in notes[0]
    assert bake(mesh, size=256)[0].materials == baked.materials, "the same bytes each time"


def test_charts_lie_apart_by_twice_the_padding() -> None:
    mesh = cabinet().mesh
    layout = lay_out(mesh, 256, 3)
    low, high = np.floor(layout.corners.min(1)), np.ceil(layout.corners.max(1))
    assert low.min() >= 3
    assert high.max() <= 253
    for k in range(0, len(low), 2):  # the two triangles of a side are one chart
        others = np.flatnonzero(np.arange(len(low)) // 2 != k // 2)
        a, b = low[k : k + 2].min(0), high[k : k + 2].max(0)
        apart = np.maximum(low[others] - b, a - high[others]).max(1)
        assert (apart >= 2 * 3 - 1).all(), k


def test_nothing_bleeds_over_a_border() -> None:
    """A red wall beside a green one: a renderer that blends neighbouring texels finds no green on the red."""
    mesh, _ = mesh_of(
        [box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1))],
        np.repeat([0, 1], 12),
        materials=(Material("red", (1.0, 0.0, 0.0, 1.0)), Material("green", (0.0, 1.0, 0.0, 1.0))),
    )
    baked, _ = bake(mesh, size=64)
    pixels = picture(baked).astype(float)
    uv = baked.corner_uv[:12].reshape(-1, 2)
    x, y = uv[:, 0] * 64 - 0.5, (1 - uv[:, 1]) * 64 - 0.5
    for dx in (0, 1):
        for dy in (0, 1):
            around = pixels[np.floor(y).astype(int) + dy, np.floor(x).astype(int) + dx]
            np.testing.assert_array_equal(around, np.tile([255.0, 0, 0], (36, 1)))


def test_surfaces_over_each_other_do_not_share_texels() -> None:
    """A strip that winds up like a spiral stair: all of it faces up, and it lies over itself."""
    angle = np.linspace(0, 4 * np.pi, 49)
    inner = np.stack([np.cos(angle), np.sin(angle), angle / 10], 1)
    vertices = np.concatenate([inner, inner * [2, 2, 1]])
    k = np.arange(48)
    faces = np.concatenate([np.stack([k, k + 49, k + 50], 1), np.stack([k, k + 50, k + 1], 1)])
    colors = np.repeat(np.where(faces.min(1) % 49 < 24, 0, 255)[:, None, None], 3, 1) * np.array([1, 1, 1, 0]) + [0, 0, 0, 255]
    mesh, _ = mesh_of([(vertices, faces)], corner_color=colors.astype(np.uint8))
    baked, _ = bake(mesh, size=256)
    np.testing.assert_array_equal(face_colors(baked), face_colors(mesh))


def test_faces_smaller_than_a_texel_keep_their_colour() -> None:
    rng = np.random.default_rng(0)
    pieces = [box((0, 0, 0), (1, 1, 1))] + [box((2 + k / 9, 0, 0), (2.001 + k / 9, 0.001, 0.001)) for k in range(9)]
    colors = np.repeat(rng.integers(0, 256, (10, 1, 4)), 12, axis=0) * np.ones((1, 3, 1))
    mesh, _ = mesh_of(pieces, corner_color=colors.astype(np.uint8))
    baked, _ = bake(mesh, size=128)
    assert np.abs(face_colors(baked).astype(int) - face_colors(mesh)).max() <= 1


def test_metal_roughness_and_light_are_baked_where_they_differ() -> None:
    mesh = cabinet().mesh
    lit = replace(mesh, materials=(replace(mesh.materials[0], emissive=(1.0, 0.0, 0.0)), *mesh.materials[1:]))
    baked, _ = bake(lit, size=128)
    read = sampler(baked)
    at = read(np.arange(len(mesh.faces)), np.full((len(mesh.faces), 3), 1 / 3)).astype(float)
    assert read.slots == ("base_color", "metallic_roughness", "emissive")
    base, steel = mesh.face_material == 0, mesh.face_material == 2
    np.testing.assert_allclose(at[base, 3:5] / 255, np.tile([0.6, 0.0], (base.sum(), 1)), atol=0.01)
    np.testing.assert_allclose(at[steel, 3:5] / 255, np.tile([0.2, 1.0], (steel.sum(), 1)), atol=0.01)
    np.testing.assert_allclose(at[base, 5:], np.tile([255.0, 0, 0], (base.sum(), 1)), atol=1)
    np.testing.assert_allclose(at[steel, 5:], 0, atol=1)
    alike = replace(mesh, materials=tuple(Material(str(k)) for k in range(3)))
    assert set(bake(alike, size=64)[0].materials[0].textures) == {"base_color"}


def test_a_picture_is_baked_by_its_own_coordinates_and_clamped() -> None:
    rows = np.zeros((4, 4, 3), np.uint8)
    rows[:, 2:] = (0, 255, 255)
    rough = Texture(png(rows), "image/png", wrap=(CLAMP, CLAMP), uv_set=1)
    material = Material(metallic=1.0, roughness=1.0, textures={"metallic_roughness": rough})
    right = np.full((12, 3, 2), 3, np.float32)  # beyond the right edge, which is rough metal
    mesh = replace(cabinet().mesh.subset(np.arange(12)), materials=(material,), face_material=np.zeros(12, int))
    for uv, value in ((right, 255), (-right, 0)):
        baked, _ = bake(replace(mesh, corner_more_uv=uv), size=64)
        assert baked.corner_more_uv is None
        assert set(picture(baked, "metallic_roughness")[..., 1:].ravel().tolist()) == {value}


def test_what_is_seen_through_stays_so() -> None:
    clear = Material("glass", (1.0, 1.0, 1.0, 0.25), alpha_mode="BLEND")
    mesh, _ = mesh_of(
        [box((0, 0, 0), (1, 1, 1)), box((2, 0, 0), (3, 1, 1))], np.repeat([0, 1], 12), materials=(Material("wood"), clear)
    )
    baked, _ = bake(mesh, size=64)
    assert [m.alpha_mode for m in baked.materials] == ["OPAQUE", "BLEND"]
    np.testing.assert_array_equal(baked.face_material, np.repeat([0, 1], 12))
    assert set(np.unique(picture(baked)[..., 3])) == {64, 255}


def test_maps_that_cannot_be_baked_are_named() -> None:
    material = Material(
        "m", textures={"normal": Texture(checker(), "image/png"), "base_color": Texture(checker(), "image/png")}
    )
    mesh, _ = mesh_of(
        [box((0, 0, 0), (1, 1, 1))], np.zeros(12, int), materials=(material,), corner_uv=np.zeros((12, 3, 2), np.float32)
    )
    assert bake(mesh, size=64)[1][1] == "not baked: normal maps"


def test_a_flat_face_and_a_face_without_area_have_a_place() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 2, 2.0]])
    mesh, _ = mesh_of([(vertices, np.array([[0, 1, 2], [3, 3, 3]]))])
    baked, _ = bake(mesh, size=32)
    assert np.isfinite(baked.corner_uv).all()


@pytest.mark.parametrize(("size", "padding"), [(8, 2), (20000, 2), (64, 0), (64, 17)])
def test_sizes_that_are_not_valid_are_told(size: int, padding: int) -> None:
    with pytest.raises(OptionError, match=f"16 to 16384 px .* found {size} px and a padding of {padding} px"):
        bake(cabinet().mesh, size=size, padding=padding)


def test_an_atlas_that_is_too_small_is_told() -> None:
    with pytest.raises(OptionError, match="an atlas of 32 px has no room for 60 charts"):
        bake(cabinet().mesh, size=32)


def test_a_finished_asset_is_baked() -> None:
    asset = cabinet()
    painted = Baked(size=64, padding=1).retexture(Finished(asset, np.arange(len(asset.mesh.faces))))
    assert painted.asset.joints == asset.joints
    assert len(painted.asset.mesh.materials) == 1


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
