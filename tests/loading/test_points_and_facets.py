"""Test that what PLY, STL and OFF files hold is read, or named in one warning: each row of their tables in docs/formats.md."""

# ruff: noqa: E501
from __future__ import annotations

import struct
from collections.abc import Callable

import numpy as np
import pytest
from assets import QUAD_UV
from mesh_files import FACES, POINTS, UV, all_files, ply_header, put, rows, stl_ascii, stl_binary, triples, write_png
from test_obj import table_rows

from anymesh.loading import LoadedMesh, load_mesh
from anymesh.types.mesh import to_srgb

FILES = all_files()
Check = Callable[[LoadedMesh], object]
RED, BLUE = [200, 30, 30, 255], [30, 30, 200, 255]


def told(loaded: LoadedMesh, *words: str) -> bool:
    return len(loaded.warnings) == 1 and all(word in loaded.warnings[0] for word in words)


def box(loaded: LoadedMesh) -> bool:
    return loaded.warnings == () and np.allclose(loaded.mesh.triangles, POINTS[FACES], atol=1e-6)


def colors(loaded: LoadedMesh) -> list[list[int]]:
    mesh = loaded.mesh
    if mesh.corner_color is None:
        display = [[*np.rint(255 * to_srgb(m.base_color[:3])).astype(int).tolist(), 255] for m in mesh.materials]
        return [display[k] for k in mesh.face_material]
    return mesh.corner_color[:, 0].tolist()


def ply(
    columns: str = "",
    values: object = None,
    comment: str = "made by hand",
    face: str = "",
    ends: list[str] | None = None,
    more: tuple[str, str] = ("", ""),
) -> bytes:
    """Return the box with further columns of its vertices and of its faces, and a further element."""
    extra = "".join(f"property float {c}\n" for c in columns.split())
    head = ply_header("ascii", extra).decode().replace("made by hand", comment)
    head = head.replace("end_header", f"{face}{more[0]}end_header")
    table = POINTS if values is None else np.c_[POINTS, np.asarray(values)]
    ends = ends or [""] * len(FACES)
    lines = "".join(f"3 {a} {b} {c} {end}\n" for (a, b, c), end in zip(FACES, ends, strict=True))
    return (head + rows("", table) + lines + more[1]).encode()


def pictures(loaded: LoadedMesh) -> list[str]:
    return [m.textures["base_color"].name for m in loaded.mesh.materials]


CORNERS = " ".join(str(x) for x in QUAD_UV[0].reshape(-1))
STRIP = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 3\n"
PLY: dict[str, tuple[bytes, Check]] = {
    "ASCII, binary of both byte orders": (FILES["big.ply"], box),
    "`vertex`: `x y z`, `nx ny nz`": (ply("nx ny nz", np.tile([0, 0, 2.0], (8, 1))), lambda m: box(m) and (m.mesh.corner_normal == [0, 0, 1]).all()),
    "`red green blue`, `diffuse_red ...`, `r g b` of vertices or faces": (ply("diffuse_red diffuse_green diffuse_blue", np.tile(RED[:3], (8, 1))), lambda m: box(m) and colors(m) == [RED] * 12),
    "`alpha`": (ply("red green blue alpha", np.c_[np.tile(RED[:3], (8, 1)), np.arange(8)]), lambda m: told(m, "alpha") and colors(m) == [RED] * 12),
    "`texture_u texture_v`, `s t`, `u v`": (ply("texture_u texture_v", UV), lambda m: box(m) and np.allclose(m.mesh.corner_uv, UV[FACES])),
    "`face`: `vertex_indices`, `vertex_index`": (ply().replace(b"vertex_indices", b"vertex_index"), box),
    "`face`: `texcoord`, `t`": (ply(face="property list uchar float t\n", ends=[f"6 {CORNERS}"] * 12), lambda m: box(m) and np.allclose(m.mesh.corner_uv, QUAD_UV[0])),
    "comment `TextureFile`, several with `texnumber`": (ply(comment="TextureFile red.png\ncomment TextureFile blue.png", face="property int texnumber\n", ends=["0", "1"] * 6), lambda m: box(m) and pictures(m) == ["red", "blue"] and m.mesh.face_material.tolist() == [0, 1] * 6),
    "several pictures without `texnumber`": (ply(comment="TextureFile red.png\ncomment TextureFile blue.png"), lambda m: told(m, "texnumber") and pictures(m) == ["red"]),
    "texture coordinates without `TextureFile`": (ply("s t", UV), lambda m: box(m) and pictures(m) == ["box"]),
    "`tristrips`": (STRIP, lambda m: m.warnings == () and np.allclose(m.mesh.face_normals, [[0, 0, 1]] * 3)),
    "a face with an index that does not exist": (ply().replace(b"3 0 1", b"3 9 1", 1), lambda m: told(m, "1 of 12 faces")),
    "`edge` and other elements": (ply(more=("element edge 1\nproperty int a\nproperty int b\n", "0 1\n")), lambda m: told(m, "1 'edge'")),
    "other properties": (ply("quality", np.ones(8)), box),
    "decimal commas": (ply().replace(b".0", b",0"), lambda m: told(m, "decimal commas")),
}  # fmt: skip


def stl(attributes: list[int], header: bytes = b"") -> bytes:
    data = bytearray(header.ljust(80) + stl_binary()[80:])
    for k, value in enumerate(attributes):
        struct.pack_into("<H", data, 84 + 50 * k + 48, value)
    return bytes(data)


LOW, HIGH, FLAG = 31, 31 << 10, 1 << 15
MAGICS = b"made by us COLOR=\xc8\x1e\x1e\xff,MATERIAL="
NAN = struct.pack("<f", np.nan)
STL: dict[str, tuple[bytes, Check]] = {
    "binary and ASCII, several solids": (stl_ascii() + stl_ascii().replace(b"vertex box", b"second"), lambda m: [n.name for n in m.mesh.nodes] == ["vertex box", "second"]),
    "normals": (stl_ascii().replace(b"normal 0 0 0", b"normal nan inf 5"), box),
    "attributes with the highest bit (VisCAM, SolidView)": (stl([FLAG + HIGH, FLAG + LOW, LOW]), lambda m: box(m) and colors(m)[:3] == [[255, 0, 0, 255], [0, 0, 255, 255], [218, 218, 218, 255]]),
    "`COLOR=` in the header (Magics)": (stl([LOW, HIGH, *[FLAG] * 10], MAGICS), lambda m: box(m) and colors(m)[:3] == [[255, 0, 0, 255], [0, 0, 255, 255], RED]),
    "other attributes": (stl([1, 2]), lambda m: told(m, "2 facets have attributes") and m.mesh.corner_color is None and not m.mesh.materials),
    "facets that are not finite": (stl([])[:96] + NAN + stl([])[100:], lambda m: told(m, "1 of 12 faces")),
    "decimal commas": (stl_ascii().replace(b".0", b",0"), lambda m: told(m, "decimal commas")),
}  # fmt: skip
NOFF = "NOFF\n8 12 0\n" + rows("", np.c_[POINTS, np.tile([0, 0, 1.0], (8, 1))]) + triples(before="3 ", first=0)
OFF: dict[str, tuple[bytes, Check]] = {
    "OFF, COFF, NOFF, STOFF": (NOFF.encode(), lambda m: box(m) and (m.mesh.corner_normal == [0, 0, 1]).all()),
    "colours of faces": (FILES["box.off"].replace(b"\n3 0 1", b"\n3 0 1", 1).rstrip().replace(b"\n3 ", b"\n3 ") + b" 7\n", lambda m: told(m, "colours are left out")),
    "a face with an index that does not exist": (FILES["box.off"].replace(b"\n3 0 1", b"\n3 9 1", 1), lambda m: told(m, "1 of 12 faces")),
    "decimal commas": (FILES["box.off"].replace(b".0", b",0"), lambda m: told(m, "decimal commas")),
}  # fmt: skip
CASES = [(kind, row) for kind, table in (("ply", PLY), ("stl", STL), ("off", OFF)) for row in table]


@pytest.mark.parametrize(("kind", "row"), CASES)
def test_each_row_of_the_tables(tmp_path, kind: str, row: str) -> None:
    data, check = {"ply": PLY, "stl": STL, "off": OFF}[kind][row]
    for name in ("red", "blue", "box"):
        write_png(tmp_path / f"{name}.png")
    loaded = load_mesh(put(tmp_path, f"box.{kind}", data))
    assert check(loaded), (loaded.warnings, loaded.mesh)


def test_the_tables_have_these_rows() -> None:
    assert table_rows("PLY") == [*PLY]
    assert table_rows("STL") == [*STL]
    assert table_rows("OFF") == [*OFF, "binary, 4OFF"]


@pytest.mark.parametrize(
    ("attributes", "header", "first"),
    [
        ([0] * 12, MAGICS, RED),  # a writer of the header alone
        ([FLAG + 1, *[FLAG + 2] * 11], MAGICS, [0, 0, 8, 255]),  # all flagged, and different: as VisCAM means it
        ([0xFFFF] * 12, MAGICS, RED),
        ([0xFFFF] * 12, b"", [255, 255, 255, 255]),
    ],
)
def test_which_of_two_conventions_a_coloured_stl_follows(tmp_path, attributes, header, first) -> None:
    assert colors(load_mesh(put(tmp_path, "box.stl", stl(attributes, header))))[0] == first


def test_the_header_of_meshlab_is_no_colour(tmp_path) -> None:
    header = b"COLOR=\x7f\x7f\x7f MATERIAL=\x7f\x7f\x7f \x7f\x7f\x7f \x7f\x7f\x7f "
    assert load_mesh(put(tmp_path, "box.stl", stl([0] * 12, header))).mesh.materials == ()
    assert colors(load_mesh(put(tmp_path, "box.stl", stl([HIGH, *[FLAG] * 11], header))))[1] == [127, 127, 127, 255]


def test_texture_coordinates_and_colours_of_off_in_their_order(tmp_path) -> None:
    table = np.c_[POINTS, np.tile([0, 0, 1.0], (8, 1)), np.tile([0.5, 0.25, 0.0, 1.0], (8, 1)), UV]
    text = "STCNOFF\n8 12 0\n" + rows("", table) + triples(before="3 ", first=0)
    loaded = load_mesh(put(tmp_path, "box.off", text.encode()))
    np.testing.assert_allclose(loaded.mesh.corner_uv, UV[FACES])
    assert colors(loaded) == [[128, 64, 0, 255]] * 12
    assert loaded.warnings == ()


def test_facets_of_few_colours_have_a_material_each(tmp_path) -> None:
    mesh = load_mesh(put(tmp_path, "box.stl", stl([1 << 15 | 31 << 10] * 6 + [1 << 15 | 31] * 6))).mesh
    assert sorted(m.name for m in mesh.materials) == ["color_0000ff", "color_ff0000"]
    assert mesh.corner_color is None
    assert np.bincount(mesh.face_material).tolist() == [6, 6]
