"""Test that what OBJ and MTL files hold is read, or named in one warning: each row of their table in docs/formats.md."""

# ruff: noqa: E501
from __future__ import annotations

import io
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mesh_files import FACES, POINTS, UV, assert_refused, put, rows, write_png
from PIL import Image

from anymesh.loading import LoadedMesh, load_mesh
from anymesh.types import Material
from anymesh.types.mesh import to_linear

TABLE = Path(__file__).parents[2] / "docs" / "formats.md"
CORNERS = "".join("f " + " ".join(f"{i + 1}/{i + 1}" for i in face) + "\n" for face in FACES)
BOX = rows("v ", POINTS) + rows("vt ", UV)
GREY = 127 / 255
Check = Callable[[LoadedMesh], object]


def table_rows(section: str) -> list[str]:
    """Return the first cells of the table in a section of the page on formats."""
    text = TABLE.read_text(encoding="utf-8").split(f"### {section}\n")[1].split("\n### ")[0]
    cells = [re.split(r" \| ", line)[0].removeprefix("| ") for line in text.split("\n") if line.startswith("| ")]
    return cells[1:]


def obj(*lines: str, body: str = BOX + CORNERS) -> dict[str, str]:
    return {"box.obj": "\n".join(lines) + "\n" + body}


def mtl(*lines: str) -> dict[str, str]:
    return obj("mtllib box.mtl", "usemtl m") | {"box.mtl": "newmtl m\n" + "\n".join(lines) + "\n"}


def parted(pattern: str, *, shared: bool = False) -> dict[str, str]:
    """Return two boxes, each below its own lines of a pattern; shared: of the same vertices."""
    second = "".join("f " + " ".join(str(i + 1 if shared else i + 9) for i in face) + "\n" for face in FACES)
    first = "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in FACES)
    text = rows("v ", POINTS) + ("" if shared else rows("v ", POINTS + 5))
    return {"box.obj": text + pattern.format("left") + first + pattern.format("right") + second}


def look(loaded: LoadedMesh) -> Material:
    (material,) = loaded.mesh.materials
    return material


def names(loaded: LoadedMesh) -> list[str]:
    return [node.name for node in loaded.mesh.nodes]


def told(loaded: LoadedMesh, *words: str) -> bool:
    return len(loaded.warnings) == 1 and all(word in loaded.warnings[0] for word in words)


def quiet(loaded: LoadedMesh) -> bool:
    return loaded.warnings == () and len(loaded.mesh.faces) == len(FACES)


def pixels(loaded: LoadedMesh, slot: str) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(look(loaded).textures[slot].data)))


def uv_is(loaded: LoadedMesh, scale: tuple[float, float], offset: tuple[float, float]) -> bool:
    return bool(np.allclose(loaded.mesh.corner_uv, UV[FACES] * scale + offset, atol=1e-6))


def colors(loaded: LoadedMesh) -> list[int]:
    assert loaded.mesh.corner_color is not None
    return loaded.mesh.corner_color[0, 0].tolist()


PAINTED = rows("v ", np.c_[POINTS, np.tile([1, 0, 0.2], (8, 1))])
HALF = to_linear([0.5])[0]
ROWS: dict[str, tuple[dict[str, str], Check]] = {
    "`v x y z`, `v x y z w`": (obj(body=rows("v ", np.c_[POINTS, np.ones(8)]) + rows("vt ", UV) + CORNERS), quiet),
    "`v x y z r g b`": (obj(body=PAINTED.replace("0.2\n", "0.2\nv 9 9 9\n", 1).replace("v 9 9 9\n", "") + rows("vt ", UV) + CORNERS), lambda m: colors(m) == [255, 0, 51, 255]),
    "`#MRGB` (ZBrush)": (obj("#MRGB " + "ffff0033" * 8), lambda m: colors(m) == [255, 0, 51, 255]),
    "`vt`, `vn`": (obj(body=BOX + "vn nan 0 0\n" * 8 + "vn 0 0 1\n" + re.sub(r"(\d+)/(\d+)", r"\1/\2/\2", CORNERS)), quiet),
    "`f` with `v`, `v/vt`, `v//vn`, `v/vt/vn`, negative indices": (obj(body=BOX + "vn 0 0 1\n" + "f 1 2 4\nf 1/1 2/2 4/4\nf 1//1 2//1 4//1\nf 1/1/1 2/2/1 4/4/1\nf -8/-8/-1 -7 -5\n"), lambda m: m.warnings == () and len(m.mesh.faces) == 5),
    "a face with an index that does not exist or a vertex that is not finite": (obj(body=BOX + "v nan 0 0\n" + CORNERS + "f 1 2 99\nf 1 2 9\n"), lambda m: told(m, "2 of 14 faces are left out", "vertex 99; valid are 1 to 9")),
    "an index of a normal or texture coordinate that does not exist": (obj(body=BOX + CORNERS.replace("/8", "/99")), lambda m: told(m, "texture coordinate that does not exist")),
    "a broken line": (obj(body=BOX + CORNERS + "f 1 2 x\nvn 1\n"), lambda m: told(m, "line 30 is broken", "'f 1 2 x'", "and 1 more")),
    "`-nan(ind)`, `1.#IND`": (obj(body=BOX + "vn -nan(ind) 1.#IND -1.#QNAN\nv nan(snan) 1 1\n" + CORNERS), quiet),
    "decimal commas": (obj(body=(BOX + CORNERS).replace(".", ",")), lambda m: told(m, "decimal commas") and np.allclose(m.mesh.triangles, POINTS[FACES])),
    "a line that `\\` continues": (obj(body=BOX + CORNERS.replace(" ", " \\\n", 5)), quiet),
    "`o`": (parted("o {}\ng x\n"), lambda m: names(m) == ["left", "right"]),
    "`g` without `o`, or of several parts in one object": (parted("o both\ng {}\n"), lambda m: names(m) == ["left", "right"]),
    "`usemtl`": (mtl("Kd .5 .5 .5") | obj("mtllib box.mtl", "usemtl M"), lambda m: look(m).base_color[0] == pytest.approx(HALF)),
    "`usemtl` of a material that is not there": (mtl("Kd 1 0 0") | obj("mtllib box.mtl", "usemtl gone"), lambda m: told(m, "material 'gone'", "none")),
    "`mtllib`, also several or with spaces": (obj("mtllib my looks.mtl", "mtllib a.mtl b.mtl", "usemtl m") | {"my looks.mtl": "newmtl m\nKd 1 0 0\n", "a.mtl": "", "b.mtl": ""}, lambda m: quiet(m) and look(m).base_color == (1, 0, 0, 1)),
    "no `mtllib`, or one that is missing": (obj("usemtl m") | {"box.mtl": "newmtl m\nKd 1 0 0\n"}, lambda m: quiet(m) and look(m).base_color == (1, 0, 0, 1)),
    "`s` without `vn`": (obj("s 1"), lambda m: told(m, "smoothing groups")),
    "`l`, `p`, `curv`, `surf` and others": (obj("l 1 2", "l 2 3", "p 1", "curv 0 1 1 2", "surf 0 1 0 1 1 2", "vp 0 1"), lambda m: told(m, "2 lines", "1 points", "1 curves", "1 free-form surfaces", "1 'vp'")),
    "`Kd`, `Ke`": (mtl("Kd .5", "Ke .5 0 0"), lambda m: quiet(m) and look(m).base_color[:3] == pytest.approx((HALF,) * 3) and look(m).emissive == pytest.approx((HALF, 0, 0))),
    "`Kd xyz`": (mtl("Kd xyz .9505 1 1.089"), lambda m: look(m).base_color[:3] == pytest.approx((1, 1, 1), abs=2e-3)),
    "`Kd spectral`": (mtl("Kd spectral a.rfl"), lambda m: told(m, "spectral")),
    "`d`, `Tr`": (mtl("Kd 1 1 1", "Tr .75"), lambda m: quiet(m) and look(m).base_color[3] == 0.25 and look(m).alpha_mode == "BLEND"),
    "`d 0`": (mtl("Kd 1 1 1", "d 0"), lambda m: told(m, "'m' would be invisible (d 0)") and look(m).base_color[3] == 1),
    "`Pr`, `Pm`": (mtl("Pr .3", "Pm 1"), lambda m: quiet(m) and (look(m).roughness, look(m).metallic) == (0.3, 1)),
    "`map_Kd`, `map_Ke`, `norm`": (mtl("map_Kd red.png", "map_Ke red.png", "norm blue.png"), lambda m: quiet(m) and set(look(m).textures) == {"base_color", "emissive", "normal"}),
    "`map_d`": (mtl("map_Kd red.png", "map_d mask.png"), lambda m: quiet(m) and look(m).alpha_mode == "MASK" and sorted({*pixels(m, "base_color")[..., 3].ravel().tolist()}) == [0, 255]),
    "`map_Bump`, `bump`": (mtl("map_Bump blue.png") | obj("mtllib box.mtl", "usemtl m"), lambda m: quiet(m) and "normal" in look(m).textures),
    "`map_Pr`, `map_Pm`": (mtl("map_Pr grey.png", "map_Pm mask.png"), lambda m: quiet(m) and (look(m).roughness, look(m).metallic) == (1, 1) and set(pixels(m, "metallic_roughness")[..., 1].ravel()) == {127}),
    "`-s`, `-o`": (mtl("map_Kd -s 4 2 1 -o .25 0 0 red.png"), lambda m: quiet(m) and uv_is(m, (4, 2), (0.25, 0))),
    "`-clamp on`": (mtl("map_Kd -clamp on red.png"), lambda m: look(m).textures["base_color"].wrap == ("clamp", "clamp")),
    "`-bm`": (mtl("bump -bm .5 blue.png"), lambda m: look(m).textures["normal"].strength == 0.5),
    "`-imfchan`": (mtl("map_Pr -imfchan b blue.png"), lambda m: set(pixels(m, "metallic_roughness")[..., 1].ravel()) == {255}),
    "options after the name": (mtl("map_Kd red.png -s 4 4 1", "bump blue.png -bm 1"), lambda m: quiet(m) and uv_is(m, (4, 4), (0, 0)) and len(look(m).textures) == 2),
    "`-mm`, `-t`": (mtl("map_Kd -mm .1 2 -t 1 1 1 red.png"), lambda m: told(m, "-mm", "-t")),
    "`map_Ka`, `map_Ks`, `map_Ns`, `disp`, `decal`, `refl`, `Pc`, `Ps`, `aniso`": (mtl("map_Kd red.png", "map_Ka red.png", "map_Ks red.png", "disp red.png", "decal red.png", "refl -type sphere red.png", "Pc .5", "Ps 0"), lambda m: told(m, "map_ks (1)", "disp (1)", "decal", "refl", "pc") and "map_ka" not in m.warnings[0]),
    "`Ka`, `Ks`, `Ns`, `Ni`, `Tf`, `illum`": (mtl("Ka 1 1 1", "Ks 1 1 1", "Ns 10", "Ni 1.5", "Tf 1 1 1", "illum 4"), quiet),
}  # fmt: skip


def load(folder: Path, files: dict[str, str]) -> LoadedMesh:
    for name, color in (("red", "red"), ("grey", (127, 127, 127)), ("blue", (127, 127, 255))):
        Image.new("RGB", (2, 2), color).save(folder / f"{name}.png")
    Image.fromarray(np.array([[0, 255], [255, 0]], np.uint8)).save(folder / "mask.png")
    (folder / "box.mtl").unlink(missing_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="latin-1")
    return load_mesh(folder / "box.obj")


@pytest.mark.parametrize("row", ROWS)
def test_each_row_of_the_table(tmp_path, row) -> None:
    files, check = ROWS[row]
    loaded = load(tmp_path, files)
    assert check(loaded), (loaded.warnings, loaded.mesh.materials, names(loaded))


def test_the_table_has_these_rows() -> None:
    assert table_rows("OBJ and MTL") == [*ROWS]


@pytest.mark.parametrize(
    ("pattern", "shared", "nodes"),
    [
        ("o both\ng {}\n", True, ["both"]),  # polygroups of one surface
        ("o both\ng both_{0}\nusemtl {0}\n", False, ["both"]),  # one group for each material
        ("g {}\n", True, ["left", "right"]),
        ("o {0}\ng {0}_wood\nusemtl wood\n", False, ["left", "right"]),
        ("o both\ng {0} all\nusemtl wood\n", False, ["left all", "right all"]),
        ("g default\ng {}\ns 1\n", False, ["left", "right"]),
    ],
)
def test_groups_are_nodes_where_they_tell_parts_apart(tmp_path, pattern: str, shared: bool, nodes: list[str]) -> None:
    assert names(load(tmp_path, parted(pattern, shared=shared))) == nodes


def test_both_meanings_of_transparency(tmp_path) -> None:
    """Photogrammetry writes Tr 1 for opaque surfaces, so a Tr of .5 beside it is an opacity too."""
    files = obj("mtllib box.mtl", "usemtl m") | {"box.mtl": "newmtl m\nTr .75\nnewmtl n\nTr 1\n"}
    assert look(load(tmp_path, files)).base_color[3] == 0.75
    files = obj("mtllib box.mtl", "usemtl n") | {"box.mtl": "newmtl n\nTr 1\n"}
    loaded = load(tmp_path, files)
    assert look(loaded).alpha_mode == "OPAQUE"
    assert told(loaded, "Tr 1")
    both = load(tmp_path, mtl("d 1", "Tr 1"))
    assert look(both).alpha_mode == "OPAQUE"
    assert both.warnings == ()


def test_pictures_placed_apart_have_their_own_coordinates(tmp_path) -> None:
    loaded = load(tmp_path, mtl("map_Kd -s 2 2 red.png", "norm -o .5 blue.png", "map_Ke -s 2 2 1 red.png"))
    sets = {slot: texture.uv_set for slot, texture in look(loaded).textures.items()}
    assert sets == {"base_color": 0, "emissive": 0, "normal": 1}
    assert uv_is(loaded, (2, 2), (0, 0))
    np.testing.assert_allclose(loaded.mesh.corner_more_uv, UV[FACES] + (0.5, 0), atol=1e-6)


def test_commas_between_coordinates_are_no_decimal_commas(tmp_path) -> None:
    loaded = load(tmp_path, obj(body=re.sub(r"(v \S+) (\S+) ", r"\1, \2, ", BOX) + CORNERS))
    np.testing.assert_allclose(loaded.mesh.triangles, POINTS[FACES])
    assert loaded.warnings == ()


def test_a_grey_bump_is_named(tmp_path) -> None:
    assert told(load(tmp_path, mtl("map_bump grey.png")), "bump pictures of heights")


def test_names_in_any_encoding_find_their_files(tmp_path) -> None:
    for encoding, name in (
        ("latin-1", "Türgrün"),
        ("cp932", "ドア"),
        ("gbk", "木门"),
        ("cp1251", "дверь"),
        ("utf-8", "Türgrün"),
    ):
        folder = tmp_path / encoding
        folder.mkdir()
        write_png(folder / f"{name}.png")
        (folder / f"{name}.mtl").write_bytes(f"newmtl {name}\nmap_Kd {name}.png\n".encode(encoding))
        text = f"mtllib {name}.mtl\no {name}\nusemtl {name}\n{BOX}{CORNERS}"
        loaded = load_mesh(put(folder, "x.obj", text.encode(encoding)))
        assert loaded.warnings == ()
        assert "base_color" in look(loaded).textures
        if encoding != "cp1251":  # its bytes may be Chinese too
            assert (look(loaded).name, names(loaded)) == (name, [name])
        look(loaded).name.encode()


def test_a_library_of_the_old_name_is_found_by_the_name_of_the_mesh(tmp_path) -> None:
    loaded = load(tmp_path, obj("mtllib old.mtl", "usemtl m") | {"box.mtl": "newmtl m\nKd 1 0 0\n"})
    assert told(loaded, "'old.mtl' is missing; box.mtl is read instead")
    assert look(loaded).base_color == (1, 0, 0, 1)
    assert told(load(tmp_path, obj("usemtl wood")), "material 'wood': put its library box.mtl beside the mesh")


def test_a_file_of_bad_faces_is_refused(tmp_path) -> None:
    assert_refused(put(tmp_path, "x.obj", (BOX + "f 1 2 4\n" + "f 1 2 99\n" * 3).encode()), "vertex 99; valid are 1 to 8")
    assert_refused(put(tmp_path, "y.obj", (BOX + "f 1 2 x\n").encode()), "no triangle", "line 17 is broken")
