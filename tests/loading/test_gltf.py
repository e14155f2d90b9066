"""Test glTF: unchanged materials and pictures, and every way to store triangles."""

import io

import numpy as np
import pytest
from assets import checker
from hypothesis import given
from hypothesis import strategies as st
from mesh_files import (
    FACES,
    LOW,
    POINTS,
    UV,
    Gltf,
    plain_gltf,
    put,
)
from PIL import Image

from anymesh.formats.polygons_ import fans, recut
from anymesh.loading import load_mesh


def test_gltf_node_of_two_materials_is_one_node(tmp_path) -> None:
    g = Gltf()
    dark = {"name": "dark", "pbrMetallicRoughness": {"baseColorFactor": [0.002, 0.5, 0.25, 0.5]}, "alphaMode": "BLEND"}
    g.doc["materials"] = [dark, {"name": "plain", "doubleSided": True, "emissiveFactor": [0, 1, 0]}]
    halves = ({**g.solid(FACES[:6]), "material": 0}, {**g.solid(FACES[6:]), "material": 1})
    g.node(mesh=g.mesh(*halves))
    mesh = load_mesh(put(tmp_path, "two.glb", g.glb())).mesh
    assert len(mesh.nodes) == 1
    assert mesh.face_material.tolist() == [0] * 6 + [1] * 6
    first, second = mesh.materials
    assert first.base_color == pytest.approx((0.002, 0.5, 0.25, 0.5))  # already linear
    assert (first.alpha_mode, first.metallic, second.metallic, second.roughness) == ("BLEND", 1, 1, 1)
    assert second.double_sided
    assert second.emissive == (0, 1, 0)


@pytest.mark.parametrize("inside", [True, False])
def test_gltf_picture_keeps_its_bytes_and_coordinates(tmp_path, inside) -> None:
    g = Gltf()
    uv = g.array(UV * 65535, "H", normalized=True)
    jpeg = io.BytesIO()
    Image.open(io.BytesIO(checker())).save(jpeg, "JPEG")
    (tmp_path / "my picture.png").write_bytes(checker())
    first = {"bufferView": g.view(checker()), "mimeType": "image/png"} if inside else {"uri": "my%20picture.png"}
    g.doc["images"] = [first, {"bufferView": g.view(jpeg.getvalue()), "mimeType": "image/jpeg"}]
    g.doc["textures"] = [{"source": 0}, {"source": 1}]
    base = {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}, "metallicFactor": 0.5}
    g.doc["materials"] = [{"pbrMetallicRoughness": base, "normalTexture": {"index": 1}}]
    g.node(mesh=g.mesh({**g.solid(TEXCOORD_0=uv), "material": 0}))
    path = put(tmp_path, "x.glb" if inside else "x.gltf", g.glb() if inside else g.gltf("x.bin"))
    (tmp_path / "x.bin").write_bytes(g.bin)
    loaded = load_mesh(path)
    (material,) = loaded.mesh.materials
    assert material.textures["base_color"].data == checker()
    assert material.textures["normal"].data == material.textures["metallic_roughness"].data == jpeg.getvalue()
    assert material.textures["normal"].mime == "image/jpeg"
    assert material.metallic == 0.5
    np.testing.assert_allclose(loaded.mesh.corner_uv, np.c_[UV[:, 0], 1 - UV[:, 1]][FACES], atol=1e-4)
    assert loaded.warnings == ()


@pytest.mark.parametrize(("mode", "index"), [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])])
def test_gltf_strips_and_fans_are_triangles(tmp_path, mode, index) -> None:
    g = Gltf()
    corners = g.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    g.node(mesh=g.mesh({"attributes": {"POSITION": corners}, "indices": g.array(index, "B"), "mode": mode}))
    mesh = load_mesh(put(tmp_path, "strip.glb", g.glb())).mesh
    np.testing.assert_allclose(mesh.face_normals, [[0, 0, 1], [0, 0, 1]])
    assert mesh.face_areas.sum() == pytest.approx(1)


def test_gltf_interleaved_and_sparse_positions(tmp_path) -> None:
    g = plain_gltf()
    packed = np.c_[POINTS - LOW, np.full((8, 2), 7)].astype("<f4").tobytes()
    where, what = g.view(np.arange(8, dtype="<u2").tobytes()), g.view(POINTS.astype("<f4").tobytes())
    sparse = {"count": 8, "indices": {"bufferView": where, "componentType": 5123}, "values": {"bufferView": what}}
    g.doc["accessors"][0] |= {"bufferView": g.view(packed, byteStride=20), "sparse": sparse}
    np.testing.assert_allclose(load_mesh(put(tmp_path, "sparse.glb", g.glb())).mesh.triangles, POINTS[FACES])
    del g.doc["accessors"][0]["sparse"]
    np.testing.assert_allclose(load_mesh(put(tmp_path, "strided.glb", g.glb())).mesh.triangles, (POINTS - LOW)[FACES])


def test_a_primitive_without_triangles_is_left_out_with_a_warning(tmp_path) -> None:
    g = Gltf()
    g.node(mesh=g.mesh(g.solid(FACES)))
    g.node(mesh=g.mesh({**g.solid(FACES[:0]), "mode": 4}))
    loaded = load_mesh(put(tmp_path, "some.glb", g.glb()))
    assert len(loaded.mesh.faces) == len(FACES)
    assert any("without triangles" in w for w in loaded.warnings)


def test_a_node_that_flattens_its_mesh(tmp_path) -> None:
    g = Gltf()
    g.node(mesh=g.mesh(g.solid(NORMAL=g.array(POINTS - 0.1))), scale=[1, 0, 1])
    mesh = load_mesh(put(tmp_path, "flat.glb", g.glb())).mesh
    assert mesh.extents[1] == 0
    assert mesh.corner_normal is not None
    assert np.abs(mesh.corner_normal[..., [0, 2]]).max() == 0


FRAME = np.array([(0, 0), (1, 0), (1, 0.2), (0.2, 0.2), (0.2, 1.8), (1, 1.8), (1, 2), (0, 2)], float)  # a C
# a square with a square hole, connected by a cut from corner to corner
KEYHOLE = np.array([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)], float)


def cut(*outlines: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return corners, triangles and their polygons, of flat outlines (n, 2) or (n, 3)."""
    points = np.concatenate([np.pad(o, ((0, 0), (0, 3 - o.shape[1]))) for o in outlines])
    counts = np.array([len(o) for o in outlines])
    triangles, polygon = fans(counts)
    return points, recut(triangles, polygon, counts, points, np.arange(len(points))), polygon


def signed_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = points[triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a)[:, 2] / 2


@pytest.mark.parametrize(
    ("outline", "area"), [(FRAME, 0.72), (FRAME[::-1], -0.72), (KEYHOLE, 12.0)], ids=["C", "clockwise", "keyhole"]
)
def test_no_triangle_covers_the_hole_of_a_concave_polygon(outline: np.ndarray, area: float) -> None:
    points, triangles, _ = cut(outline)
    areas = signed_areas(points, triangles)
    assert len(triangles) == len(outline) - 2
    assert areas.sum() == pytest.approx(area)
    assert np.abs(areas).sum() == pytest.approx(abs(area))  # no two overlap


def test_an_outline_may_repeat_its_corners() -> None:
    points, triangles, _ = cut(np.repeat(FRAME, 2, axis=0))
    areas = signed_areas(points, triangles)
    assert len(triangles) == 2 * len(FRAME) - 2
    assert np.abs(areas).sum() == pytest.approx(areas.sum()) == pytest.approx(0.72)


def test_convex_polygons_are_fanned_and_neighbours_stay() -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    _, triangles, polygon = cut(square, FRAME, square[:3])
    assert triangles[polygon == 0].tolist() == [[0, 1, 2], [0, 2, 3]]
    assert set(triangles[polygon == 1].ravel()) == set(range(4, 12))  # every corner stays
    assert triangles[polygon == 2].tolist() == [[12, 13, 14]]


@given(st.integers(4, 24), st.integers(0, 10_000))
def test_stars_in_any_plane_keep_their_area(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle = (np.arange(count) + 0.8 * rng.random(count)) * 2 * np.pi / count
    flat = (0.2 + rng.random(count))[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points, triangles, _ = cut(np.pad(flat, ((0, 0), (0, 1))) @ turn)
    a, b, c = points[triangles].transpose(1, 0, 2)
    x, y = flat.T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(area)


def test_a_window_frame_in_an_obj_stays_open(tmp_path) -> None:
    text = "".join(f"v {x} {y} 0\n" for x, y in FRAME) + "f " + " ".join(map(str, range(1, 9))) + "\nf 98 99\n"
    (tmp_path / "frame.obj").write_text(text)
    assert load_mesh(tmp_path / "frame.obj").mesh.face_areas.sum() == pytest.approx(0.72)
