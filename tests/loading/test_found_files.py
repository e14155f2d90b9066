"""Test how files are found that do not lie where a reference says, and how zips are read: a table in docs/formats.md."""

from __future__ import annotations

import io
import zipfile

import pytest
from mesh_files import FILES, MTL, assert_refused, obj, plain_gltf, put, put_naming, textures, write_png
from PIL import Image
from test_obj import table_rows

from anymesh.formats import zipped as archives
from anymesh.loading import load_mesh, place_mesh

POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"
TEXTURED = MTL + b"map_Kd C:\\Users\\me\\wood\\x.png\n"


def png() -> bytes:
    sink = io.BytesIO()
    Image.new("RGB", (2, 2), "red").save(sink, "PNG")
    return sink.getvalue()


def archive(files: dict[str, bytes]) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as target:
        for name, content in files.items():
            target.writestr(name, content)
    return sink.getvalue()


@pytest.mark.parametrize("name", ["image.glb", "picture.obj", "picture.ply", "picture.dae"])
@pytest.mark.parametrize(
    "uri", ["C:\\Users\\me\\wood\\x.png", "/Users/me/x.png", "..\\..\\maps\\x.png", "https://example.org/x.png"]
)
@pytest.mark.parametrize("place", ["x.png", "Textures/X.PNG", "maps/x.png", "../textures/x.png"])
def test_a_picture_is_found_beside_the_mesh_and_in_folders_of_pictures(tmp_path, name, uri, place) -> None:
    path = put_naming(tmp_path / "source", name, uri)
    write_png(path.parent / place)
    loaded = load_mesh(path)
    assert (textures(loaded), loaded.warnings) == (1, ())


def test_other_folders_beside_that_of_the_mesh_are_not_read(tmp_path) -> None:
    path = put_naming(tmp_path / "source", "image.glb", "x.png")
    for folder in ("secret", "maps"):
        write_png(tmp_path / folder / "x.png")
    (tmp_path / "textures").symlink_to(tmp_path / "secret")
    assert textures(load_mesh(path)) == 0
    assert textures(load_mesh(path, root=tmp_path)) == 1  # in maps


def test_a_file_of_two_names_that_differ_in_case_is_not_guessed(tmp_path) -> None:
    path = put_naming(tmp_path, "image.glb", "D:\\X.png")
    write_png(tmp_path / "x.png")
    write_png(tmp_path / "x.PNG")
    assert textures(load_mesh(path)) == (0 if len(list(tmp_path.glob("x.*"))) == 2 else 1)


def test_git_lfs_pointers_are_told(tmp_path) -> None:
    for name in FILES:
        assert_refused(put(tmp_path, name, POINTER), "a Git LFS pointer", "git lfs pull")
    path = put_naming(tmp_path, "image.glb", "x.png")
    (tmp_path / "x.png").write_bytes(POINTER)
    (warning,) = load_mesh(path).warnings
    assert "texture 'x.png' left out: it is a Git LFS pointer" in warning
    path = put(tmp_path, "box.gltf", FILES["box.gltf"])
    (tmp_path / "box.bin").write_bytes(POINTER)
    assert_refused(path, "git lfs pull")


SKETCHFAB = {"source/model.obj": obj(), "source/box.mtl": TEXTURED, "textures/x.png": png()}
NESTED = {"source/a.zip": archive({"a/model.obj": obj(), "a/box.mtl": TEXTURED}), "textures/x.png": png()}
FORMATS = {"obj/Chair_OBJ.obj": obj(), "obj/box.mtl": TEXTURED, "obj/x.png": png(), "Chair.stl": FILES["binary.stl"]}
LEVELS = {f"a/chair_LOD{k}.obj": obj() for k in range(3)} | {"a/box.mtl": TEXTURED, "a/x.png": png()}
WINDOWS = {"set\\model.obj": obj(), "set\\box.mtl": TEXTURED, "set\\maps\\x.png": png(), "__MACOSX\\set\\._model.obj": b"junk"}


@pytest.mark.parametrize(("files", "warned"), [(SKETCHFAB, 0), (NESTED, 0), (FORMATS, 1), (LEVELS, 1), (WINDOWS, 0)])
def test_a_zip_is_read_like_a_folder(tmp_path, files, warned) -> None:
    path = put(tmp_path, "old cabinet.zip", archive(files))
    loaded = load_mesh(path)
    assert textures(loaded) == 1
    assert len(loaded.warnings) == warned
    assert loaded.path.startswith(str(path))
    assert loaded.path.endswith(".obj")
    assert load_mesh(path).references == loaded.references
    assert "cabinet" in place_mesh(loaded).notes[1]


def test_a_zip_in_another_encoding(tmp_path) -> None:
    names = {"Tür.obj": obj().replace(b"box.mtl", "Tür.mtl".encode("cp850")), "Tür.mtl": MTL}
    data = archive({name.replace("ü", "_"): content for name, content in names.items()})
    loaded = load_mesh(put(tmp_path, "x.zip", data.replace(b"T_r.", "Tür.".encode("cp850"))))  # as programs of Windows write
    assert (len(loaded.mesh.materials), loaded.warnings) == (1, ())


def test_zips_that_are_refused(tmp_path, monkeypatch) -> None:
    several = archive({"a.obj": obj(), "b.obj": obj()})
    assert_refused(put(tmp_path, "x.zip", several), "2 meshes (a.obj, b.obj)", "unpack it and give one")
    assert_refused(put(tmp_path, "x.zip", archive({"a.txt": b""})), "no mesh")
    assert_refused(put(tmp_path, "x.zip", archive({"../a.obj": obj()})), "unsafe entry")
    assert_refused(put(tmp_path, "x.zip", b"PK\x03\x04"), "broken or of an unknown kind")
    assert_refused(put(tmp_path, "x.zip", b"Rar!\x1a\x07"), "no ZIP file inside")
    assert_refused(put(tmp_path, "x.zip", archive({"a.obj": b"v 0 0 0\n"})), "x.zip: a.obj: found no triangle")
    monkeypatch.setattr(archives, "MIN_BYTES", 1 << 10)
    assert_refused(put(tmp_path, "x.zip", archive({"a.obj": obj(), "b.bin": bytes(1 << 20)})), "once unpacked")


def test_a_zip_within_a_zip_within_a_zip_is_read_once(tmp_path) -> None:
    inner = archive({"a.zip": archive({"b.zip": archive({"c.obj": obj()})})})
    assert_refused(put(tmp_path, "x.zip", inner), "no mesh")


def test_the_table_has_these_rows() -> None:
    """The tests of this file, of test_references.py and of test_place.py, in the order of the table."""
    assert [row.split(",")[0].split(" (")[0] for row in table_rows("References, archives and size")] == [
        "a file that lies elsewhere than its path says",
        "`source/` with `textures/` beside it",
        "a name that is not UTF-8",
        "a missing file",
        "a URL of the web",
        "a Git LFS pointer",
        "a zip",
        "a zip of several meshes",
        "a size in the file's unit outside of .01 to 20 m",
    ]


def test_a_buffer_is_found_beside_the_mesh(tmp_path) -> None:
    path = put(tmp_path, "box.gltf", plain_gltf().gltf("C:\\out\\box.bin"))
    assert len(load_mesh(path).mesh.faces) == 12
