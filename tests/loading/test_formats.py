"""Test that one solid is read alike from every format, with its materials and placement."""

from __future__ import annotations

import io
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from assets import QUAD_UV, checker
from mesh_files import (
    DAE_INSTANCE,
    FACES,
    HIGH,
    LOW,
    MTL,
    POINTS,
    UV,
    Gltf,
    all_files,
    assert_refused,
    dae,
    obj,
    plain_gltf,
    ply_header,
    put,
    rows,
    stl_ascii,
    stl_binary,
    triples,
)
from PIL import Image

from anymesh.formats.dae.document import with_decimal_points
from anymesh.loading import load_mesh, place_mesh
from anymesh.types.mesh import to_linear

FILES = all_files()
MIRROR = (-1, 1, 1)
LINEAR_HALF = 0.21404114  # sRGB 0.5


def volume(mesh) -> float:
    t = mesh.triangles
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


@pytest.mark.parametrize("name", FILES)
def test_every_format_gives_the_same_solid(tmp_path, name) -> None:
    loaded = load_mesh(put(tmp_path, name, FILES[name]))
    mesh = loaded.mesh
    np.testing.assert_allclose(mesh.triangles, POINTS[FACES], atol=1e-6)
    np.testing.assert_allclose(mesh.bounds, [LOW, HIGH])
    assert mesh.face_areas.sum() == pytest.approx(22)
    assert volume(mesh) == pytest.approx(6)
    assert len(mesh.nodes) == 1
    assert loaded.warnings == ()


@pytest.mark.parametrize("kind", ["glb", "obj", "ply", "stl", "off"])
def test_files_of_another_writer_are_read(tmp_path, kind) -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    path = tmp_path / f"ball.{kind}"
    ball.export(path)
    found = load_mesh(path).mesh
    assert len(found.faces) == len(ball.faces)
    np.testing.assert_allclose(found.bounds, ball.bounds, atol=1e-6)
    assert volume(found) == pytest.approx(ball.volume, rel=1e-5)


def scene() -> bytes:
    g = Gltf()
    mesh = g.mesh(g.solid())
    g.node(name="group", translation=[10, 0, 0], scale=[2, 2, 2], children=[1, 2])
    g.node(root=False, name="leaf", mesh=mesh, rotation=[0, 0, 0.5**0.5, 0.5**0.5])
    g.node(root=False, name="leaf", mesh=mesh, scale=MIRROR)
    g.node(name="camera", camera=0, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1], mesh=mesh)
    return g.glb()


def test_instances_are_placed_and_mirrored_ones_keep_their_outside(tmp_path) -> None:
    path = put(tmp_path, "scene.glb", scene())
    mesh = load_mesh(path).mesh
    x, y, z = POINTS.T
    points = {
        "turned": np.c_[10 - 2 * y, 2 * x, 2 * z],
        "mirrored": np.c_[10 - 2 * x, 2 * y, 2 * z],
        "camera": np.c_[x, y + 5, z],
    }
    found = [mesh.subset(mesh.face_node == k) for k in range(len(mesh.nodes))]
    boxes = sorted(np.round(part.bounds, 5).tolist() for part in found)
    assert boxes == sorted(np.round([p.min(0), p.max(0)], 5).tolist() for p in points.values())
    assert sorted(round(volume(part), 4) for part in found) == [6, 48, 48]
    assert len({node.name for node in mesh.nodes}) == 3
    assert {node.geometry for node in mesh.nodes} == {"box"}
    assert [n.name for n in load_mesh(path).mesh.nodes] == [n.name for n in mesh.nodes]


def test_normals_of_the_file_survive_and_are_not_made_up(tmp_path) -> None:
    outward = POINTS - POINTS.mean(0)
    normals = outward / np.linalg.norm(outward, axis=1, keepdims=True)
    g = Gltf()
    g.node(mesh=g.mesh(g.solid(NORMAL=g.array(normals))), scale=[-1, 1, 2])
    found = load_mesh(put(tmp_path, "n.glb", g.glb())).mesh
    outward = found.triangles - found.bounds.mean(0)
    assert (np.einsum("fkc,fkc->fk", found.corner_normal, outward) > 0).all()
    np.testing.assert_allclose(np.linalg.norm(found.corner_normal, axis=2), 1, atol=1e-6)
    text = (
        rows("v ", POINTS)
        + rows("vn ", normals)
        + "".join("f " + " ".join(f"{i + 1}//{i + 1}" for i in f) + "\n" for f in FACES)
    )
    extra = "property float nx\nproperty float ny\nproperty float nz\n"
    body = rows("", np.c_[POINTS, normals]) + rows("3 ", FACES)
    for name, data in (("n.obj", text.encode()), ("n.ply", ply_header("ascii", extra) + body.encode())):
        np.testing.assert_allclose(load_mesh(put(tmp_path, name, data)).mesh.corner_normal, normals[FACES], atol=1e-6)
    assert all(load_mesh(put(tmp_path, name, FILES[name])).mesh.corner_normal is None for name in FILES)


def test_vertex_and_face_colours(tmp_path) -> None:
    colors = np.arange(32, dtype=np.uint8).reshape(8, 4) * 8
    extra = "".join(f"property uchar {c}\n" for c in ("red", "green", "blue", "alpha"))
    table = np.zeros(8, np.dtype([("p", "<f4", 3), ("c", "u1", 4)]))
    table["p"], table["c"] = POINTS, colors
    faces = FILES["little.ply"][-13 * len(FACES) :]
    text = [" ".join(map(str, [*p, *c])) + "\n" for p, c in zip(POINTS, colors, strict=True)]
    g = Gltf()
    light = np.c_[to_linear(colors[:, :3] / 255), colors[:, 3:] / 255].astype(np.float32)  # a factor of the linear colour
    g.node(mesh=g.mesh(g.solid(COLOR_0=g.array(light, "f"))))
    files = {
        "a.ply": ply_header("ascii", extra) + "".join(text).encode() + rows("3 ", FACES).encode(),
        "b.ply": ply_header("binary_little_endian", extra) + table.tobytes() + faces,
        "c.glb": g.glb(),
        "d.off": ("COFF\n8 12 0\n" + "".join(text) + triples(before="3 ", first=0)).encode(),
    }
    for name, data in files.items():
        loaded = load_mesh(put(tmp_path, name, data))
        counts = 3 if name.endswith("ply") else 4  # the alpha of a PLY is no opacity
        np.testing.assert_array_equal(loaded.mesh.corner_color[..., :counts], colors[FACES][..., :counts], name)
        assert (counts == 4) == (loaded.warnings == ())
    lines = rows("v ", np.c_[POINTS, colors[:, :3] / 255]) + triples()
    found = load_mesh(put(tmp_path, "e.obj", lines.encode())).mesh.corner_color
    np.testing.assert_array_equal(found[..., :3], colors[FACES][..., :3])
    lines = rows("v ", np.c_[POINTS, np.full((8, 3), np.nan)]) + triples()
    with warnings.catch_warnings(action="error"):
        assert (load_mesh(put(tmp_path, "n.obj", lines.encode())).mesh.corner_color == 255).all()
    off = "OFF\n8 12 0\n" + rows("", POINTS) + "".join(f"3 {a} {b} {c} {k} 0 255\n" for k, (a, b, c) in enumerate(FACES))
    found = load_mesh(put(tmp_path, "f.off", off.encode())).mesh.corner_color
    assert found[:, 0].tolist() == found[:, 2].tolist() == [[k, 0, 255, 255] for k in range(12)]


def test_obj_materials_in_the_order_of_the_file(tmp_path) -> None:
    (tmp_path / "my checker.png").write_bytes(checker())
    library = b"newmtl half\nKd .5 .5 .5\nd 0.25\nKe 0.5 0 0\nnewmtl pic\nKd 0 0 0\nmap_Kd -s 1 1 1 my checker.png\n"
    (tmp_path / "looks.mtl").write_bytes(library)
    faces = ["f " + " ".join(f"{i + 1}/{i + 1}" for i in f) + "\n" for f in FACES]
    looks = ["usemtl pic\n" if k % 2 else "usemtl half\n" for k in range(11)] + ["usemtl none\n"]
    body = "".join(look + f for look, f in zip(looks, faces, strict=True))
    text = "mtllib looks.mtl\n" + rows("v ", POINTS) + rows("vt ", UV) + body
    loaded = load_mesh(put(tmp_path, "x.obj", text.encode()))
    mesh, (half, pic) = loaded.mesh, loaded.mesh.materials
    assert any("material 'none': in no material library" in w for w in loaded.warnings)
    assert half.base_color == pytest.approx((LINEAR_HALF, LINEAR_HALF, LINEAR_HALF, 0.25), abs=1e-6)
    assert half.emissive[0] == pytest.approx(LINEAR_HALF)
    assert half.alpha_mode == "BLEND"
    assert pic.textures["base_color"].data == checker()
    assert pic.base_color == (1, 1, 1, 1)  # a picture multiplied by black would be black
    assert mesh.face_material.tolist() == [k % 2 for k in range(11)] + [-1]
    np.testing.assert_allclose(mesh.triangles, POINTS[FACES])
    np.testing.assert_allclose(mesh.corner_uv, UV[FACES])


def test_obj_polygons_groups_and_indices_from_the_end(tmp_path) -> None:
    square = "v {0} 0 0\nv {0} 1 0\nv {0} 1 1\nv {0} 0 1\n"
    text = "g left\n" + square.format(0) + "f -4 -3 -2 -1 # quad\ng right\n" + square.format(5) + "f -4 \\\n-3 -2\nf 8 7 6 5"
    mesh = load_mesh(put(tmp_path, "x.obj", text.encode())).mesh
    assert [mesh.nodes[n].name for n in mesh.face_node] == ["left"] * 2 + ["right"] * 3
    assert mesh.triangles[:, :, 0].tolist() == [[0] * 3] * 2 + [[5] * 3] * 3
    assert mesh.face_areas.tolist() == [0.5] * 5


def test_polygons_of_mixed_sizes_in_ply_and_off(tmp_path) -> None:
    points = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0], [0, 0, 1]], float)
    polygons = [(0, 1, 2, 3, 4), (0, 4, 5), (0, 5, 4, 3)]
    text = "".join(f"{len(p)} {' '.join(map(str, p))}\n" for p in polygons)
    head = ply_header("{}", faces=3).decode().replace("vertex 8", "vertex 6")
    binary = b"".join(bytes([len(p)]) + np.array(p, "<i4").tobytes() for p in polygons)
    files = {
        "a.off": ("OFF\n6 3 0\n" + rows("", points) + text).encode(),
        "a.ply": (head.format("ascii") + rows("", points) + text).encode(),
        "b.ply": head.format("binary_little_endian").encode() + points.astype("<f4").tobytes() + binary,
    }
    fans = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 4), (0, 4, 3)]
    for name, data in files.items():
        np.testing.assert_allclose(load_mesh(put(tmp_path, name, data)).mesh.triangles, points[fans], err_msg=name)


def test_ply_picture_and_texture_coordinates(tmp_path) -> None:
    (tmp_path / "checker.png").write_bytes(checker())
    head = ply_header("ascii", "property float s\nproperty float t\n").replace(b"made by hand", b"TextureFile checker.png")
    by_vertex = head + (rows("", np.c_[POINTS, UV]) + rows("3 ", FACES)).encode()
    head = ply_header("ascii").replace(b"end_header", b"property list uchar float texcoord\nend_header")
    corners = np.tile(QUAD_UV, (6, 1, 1))
    lines = [" ".join(map(str, [3, *f, 6, *c.reshape(-1)])) + "\n" for f, c in zip(FACES, corners, strict=True)]
    mesh = load_mesh(put(tmp_path, "v.ply", by_vertex)).mesh
    assert mesh.materials[0].textures["base_color"].data == checker()
    np.testing.assert_allclose(mesh.corner_uv, UV[FACES])
    found = load_mesh(put(tmp_path, "c.ply", head + (rows("", POINTS) + "".join(lines)).encode())).mesh
    np.testing.assert_allclose(found.corner_uv, corners)


@pytest.mark.parametrize(("up", "axis"), [("X_UP", "x"), ("Y_UP", "y"), ("Z_UP", "z")])
def test_dae_up_axis_and_unit_are_applied_once(tmp_path, up, axis) -> None:
    path = put(tmp_path, "box.dae", dae(up, '<unit name="decimeter" meter="0.1"/>'))
    loaded = load_mesh(path)
    np.testing.assert_allclose(loaded.mesh.triangles, POINTS[FACES])
    assert (loaded.format_up, loaded.unit_in_metres) == (axis, 0.1)
    placed = place_mesh(loaded)
    height = dict(zip("xyz", HIGH - LOW, strict=True))[axis]
    assert placed.mesh.extents[2] == pytest.approx(0.1 * height)
    moved = POINTS[FACES] @ placed.T_asset_source[:3, :3].T + placed.T_asset_source[:3, 3]
    np.testing.assert_allclose(placed.mesh.triangles, moved, atol=1e-12)


def test_dae_instances_transforms_and_looks(tmp_path) -> None:
    (tmp_path / "checker.png").write_bytes(checker())
    inner = f'<node id="b"><scale>-1 1 1</scale>{DAE_INSTANCE}</node>'
    nodes = f'<node id="a"><translate>0 0 9</translate>{DAE_INSTANCE}{inner}</node>'
    mesh = load_mesh(put(tmp_path, "two.dae", dae(nodes=nodes, look="<color>0.5 0 1 1</color>"))).mesh
    parts = [mesh.subset(mesh.face_node == k) for k in range(2)]
    assert [volume(p) for p in parts] == pytest.approx([6, 6])
    np.testing.assert_allclose(parts[0].bounds, np.add([LOW, HIGH], [0, 0, 9]))
    np.testing.assert_allclose(parts[1].bounds, [[-2, 2, 12], [-1, 4, 15]])
    assert len(mesh.materials) == 1
    assert mesh.materials[0].base_color == pytest.approx((LINEAR_HALF, 0, 1, 1), abs=2e-3)
    pictured = load_mesh(put(tmp_path, "pic.dae", dae(look='<texture texture="p" texcoord="c"/>')))
    texture = pictured.mesh.materials[0].textures["base_color"]
    shown, meant = (np.asarray(Image.open(io.BytesIO(b)).convert("RGB")) for b in (texture.data, checker()))
    np.testing.assert_array_equal(shown, meant)
    assert pictured.warnings == ()


def test_obj_material_is_red_and_the_solid_keeps_shared_corners(tmp_path) -> None:
    mesh = load_mesh(put(tmp_path, "box.obj", obj())).mesh
    assert MTL.startswith(b"newmtl red")
    assert mesh.materials[0] == replace(mesh.materials[0], name="red", base_color=(1.0, 0.0, 0.0, 1.0))
    assert len(mesh.vertices) == 8


def test_dae_geometry_survives_a_broken_material(tmp_path) -> None:
    """Exporters of Blender name surfaces that do not exist; the geometry with that material was lost."""
    (tmp_path / "checker.png").write_bytes(checker())
    broken = dae(look='<texture texture="p" texcoord="c"/>').replace(b"<source>s</source>", b"<source>gone</source>")
    loaded = load_mesh(put(tmp_path, "box.dae", broken))
    np.testing.assert_allclose(loaded.mesh.triangles, POINTS[FACES])
    (warning,) = loaded.warnings
    assert "picture 'gone'" in warning
    assert loaded.mesh.materials[0].name == "red"


def test_dae_decimal_commas_are_points(tmp_path) -> None:
    """FBX exporters write them on computers that are set to German or French."""
    plain = dae(unit='<unit meter="0.01"/>', look="<color>0.5 0.25 1.0 1</color>").replace(b"0 0 9", b"0.0 0.0 9.5")
    commas = re.sub(rb"(?<=[\d> \"-])(\d+)\.(\d+)(?=[\s<\"])", rb"\1,\2", plain).replace(b'version="1,', b'version="1.')
    assert b"0,5 0,25" in commas
    assert b'"0,01"' in commas
    first, second = (load_mesh(put(tmp_path, name, data)) for name, data in (("a.dae", plain), ("b.dae", commas)))
    np.testing.assert_array_equal(first.mesh.triangles, second.mesh.triangles)
    assert first.mesh.materials[0].base_color == second.mesh.materials[0].base_color
    assert first.unit_in_metres == second.unit_in_metres == 0.01
    assert second.warnings == ("found decimal commas, which are taken for points",)
    assert first.warnings == ()


@pytest.mark.parametrize(
    "text", [b"<a>1,2,3</a>", b"<a>0,5 1.5</a>", b"<a>p, q</a>", b'<a n="Box 1,5"/>', b'<a id="1,5"/>', b"<a>1,5 x</a>"]
)
def test_other_commas_of_a_dae_stay(text: bytes) -> None:
    assert with_decimal_points(text) == text


@pytest.mark.parametrize("name", ["ascii.stl", "box.obj"])
@pytest.mark.parametrize("end", [b"\r", b"\r\n"])
def test_lines_may_end_with_a_carriage_return(tmp_path, name, end) -> None:
    mesh = load_mesh(put(tmp_path, name, all_files()[name].replace(b"\n", end))).mesh
    np.testing.assert_allclose(mesh.triangles, POINTS[FACES], atol=1e-6)


@pytest.mark.parametrize("value", ["nan", "inf", "1e37", "1e300"])
def test_texture_coordinates_that_mean_no_place_are_0(tmp_path, value) -> None:
    uv = "\n".join(f"vt {value if k == 0 else u} {v}" for k, (u, v) in enumerate(UV))
    corners = "\n".join("f " + " ".join(f"{c + 1}/{c + 1}" for c in face) for face in FACES)
    read = load_mesh(put(tmp_path, "box.obj", (rows("v ", POINTS) + uv + "\n" + corners + "\n").encode()))
    uv_read = read.mesh.corner_uv
    assert uv_read is not None
    assert np.isfinite(uv_read).all()
    first = np.array(FACES) == 0
    assert (uv_read[first][:, 0] == 0).all()
    assert uv_read[~first] == pytest.approx(UV[np.array(FACES)][~first])
    if value != "nan":  # the OBJ reader takes NaN for 0 without a warning
        assert any("texture coordinates" in w for w in read.warnings)


@pytest.mark.parametrize(("cutoff", "kept"), [(float("nan"), 0.5), (float("inf"), 0.5), (0.3, 0.3), (1.5, 1.5)])
def test_a_cutoff_is_finite(tmp_path, cutoff, kept) -> None:
    document = plain_gltf()
    document.doc["materials"] = [{"alphaMode": "MASK", "alphaCutoff": cutoff}]
    document.doc["meshes"][0]["primitives"][0]["material"] = 0
    assert load_mesh(put(tmp_path, "a.glb", document.glb())).mesh.materials[0].alpha_cutoff == kept


def test_a_mesh_that_does_not_exist_is_refused(tmp_path) -> None:
    document = plain_gltf()
    document.doc["nodes"][0]["mesh"] = -1
    assert_refused(put(tmp_path, "a.glb", document.glb()), "index -1")


def test_what_moves_a_mesh_is_told(tmp_path) -> None:
    document = plain_gltf()
    document.doc["meshes"][0]["primitives"][0]["targets"] = [{}]
    document.doc["extensionsRequired"] = ["KHR_materials_unlit", "ACME_gravity"]
    warnings = " ".join(load_mesh(put(tmp_path, "a.glb", document.glb())).warnings)
    assert "morph targets" in warnings
    assert "ACME_gravity" in warnings
    assert "unlit" not in warnings


def test_an_obj_counts_from_1_also_in_its_errors(tmp_path) -> None:
    data = (rows("v ", POINTS) + triples() + "f 1 2 1000\n").encode()
    loaded = load_mesh(put(tmp_path, "a.obj", data))
    assert len(loaded.mesh.faces) == 12
    assert "vertex 1000; valid are 1 to 8" in loaded.warnings[0]


@pytest.mark.parametrize(
    "change",
    [
        bytes.upper,
        lambda d: b"\xef\xbb\xbf" + d,
        lambda d: d.replace(b"\n", b" "),
        lambda d: d.replace(b"\n", b"\r"),
        lambda d: b"\f" + d,
        lambda d: re.sub(rb" normal [^\n]*", b"", d),
        lambda d: re.sub(rb"solid[^\n]*", b"solid my facet normal map, vertex one two three", d, count=1),
        lambda d: re.sub(rb"endsolid[^\n]*", b"endsolid facet normal vertex a b c", d),
        lambda d: d.replace(b"outer loop", b"outer loop ; a vertex of the box here"),
    ],
    ids=["capitals", "mark", "one line", "returns", "feed", "no normals", "title", "end", "comments"],
)
def test_spellings_of_ascii_stl(tmp_path, change) -> None:
    plain = load_mesh(put(tmp_path, "a.stl", stl_ascii())).mesh
    assert (load_mesh(put(tmp_path, "b.stl", change(stl_ascii()))).mesh.triangles == plain.triangles).all()


def test_a_binary_stl_may_have_text_in_its_header(tmp_path) -> None:
    data = b"solid made of facets".ljust(80) + stl_binary()[80:]
    assert len(load_mesh(put(tmp_path, "a.stl", data)).mesh.faces) == len(FACES)


def test_large_outlines_and_empty_lines_are_read(tmp_path) -> None:
    rng = np.random.default_rng(0)
    outline = np.c_[rng.random((3000, 2)), np.zeros(3000)]  # crosses itself thousands of times
    polygon = put(tmp_path, "a.obj", (rows("v ", outline) + "f " + " ".join(map(str, range(1, 3001))) + "\n").encode())
    empty = put(tmp_path, "b.stl", stl_ascii().replace(b"endfacet\n", b"endfacet" + b"\n" * 50_000))
    assert len(load_mesh(polygon).mesh.faces) == 2998
    assert len(load_mesh(empty).mesh.faces) == len(FACES)
    twice = put(tmp_path, "c.stl", stl_ascii() + stl_ascii().replace(b"solid", b"solid" + b" " * 100_000, 1))
    assert len(load_mesh(twice).mesh.faces) == 2 * len(FACES)
