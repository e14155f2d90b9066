"""Test that references are read within one folder; an unreadable texture gives a warning, unreadable geometry an error."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from mesh_files import FILES, MTL, TEXTURED, assert_refused, naming, obj, plain_gltf, put, put_naming, textures, write_png
from PIL import Image

from anymesh.errors import InputError, OptionError
from anymesh.loading import load_mesh

OUTSIDE = ["../secret.png", "/etc/hostname", "a/../../secret.png", "..\\secret.png", "C:\\secret.png", "\\\\server\\secret.png"]
OUTSIDE += ["file:///etc/hostname", "file:///C:/secret.png", "file:../secret.png", "package://inside/../secret.png"]
URLS = ["https://example.org/x.png", "http://127.0.0.1:9/x.png", "ftp://x/y.png", "odd:x.png"]
MISSING = ["gone.png", "a/gone.png", "x" * 300 + ".png", "package://other/gone.png", "model://", "%00.png"]


@pytest.mark.parametrize("uri", [*OUTSIDE, *URLS, *MISSING])
@pytest.mark.parametrize("name", [*TEXTURED, "library.obj"])
def test_a_texture_that_cannot_be_read_is_one_warning(tmp_path, name, uri) -> None:
    write_png(tmp_path / "secret.png")
    path = put_naming(tmp_path / "inside", name, uri)
    loaded = load_mesh(path)
    assert textures(loaded) == 0
    (warning,) = loaded.warnings
    assert f"{'material library' if name == 'library.obj' else 'texture'} {uri[:100]!r} left out" in warning
    foreign, helps = "C:" in uri or "server" in uri, "beside the mesh" in warning or uri == "model://"
    told = (
        "another computer"
        if foreign
        else "--root FOLDER"
        if uri in OUTSIDE
        else "not followed"
        if uri in URLS
        else "is missing"
    )
    assert told in warning
    assert helps
    assert len(warning) < 250


@pytest.mark.parametrize("uri", [*OUTSIDE, *URLS, *MISSING])
def test_geometry_that_cannot_be_read_is_an_error(tmp_path, uri) -> None:
    (tmp_path / "inside").mkdir()
    (tmp_path / "secret.png").write_bytes(plain_gltf().bin)
    told = "" if uri not in OUTSIDE else "another computer" if "C:" in uri or "server" in uri else "--root"
    assert_refused(put(tmp_path / "inside", "buffer.gltf", naming(uri)["buffer.gltf"]), "refers to", told)


@pytest.mark.parametrize("uri", ["%2e%2e/secret.png", "link.png", "LINK.png", "folder/secret.png", "circle.png"])
def test_a_reference_that_leads_outside_in_disguise(tmp_path, uri) -> None:
    write_png(tmp_path / "secret.png")
    path = put_naming(tmp_path / "inside", "image.glb", uri)
    (path.parent / "link.png").symlink_to(tmp_path / "secret.png")
    (path.parent / "folder").symlink_to(tmp_path)
    (path.parent / "circle.png").symlink_to(path.parent / "circle.png")
    loaded = load_mesh(path)
    assert textures(loaded) == 0
    assert ("outside" in loaded.warnings[0]) == (uri != "circle.png")


@pytest.mark.parametrize("name", TEXTURED)
@pytest.mark.parametrize("content", [b"", b"no picture", b"\x89PNG\r\n\x1a\n broken"])
def test_a_texture_that_is_broken_is_one_warning_and_always_the_same(tmp_path, name, content) -> None:
    path = put_naming(tmp_path, name, "bad.png")
    (tmp_path / "bad.png").write_bytes(content)
    loaded = load_mesh(path)
    assert textures(loaded) == 0
    (warning,) = loaded.warnings
    assert "'bad.png'" in warning
    assert "0x" not in warning
    assert load_mesh(path).warnings == loaded.warnings


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="everything can be opened")
def test_a_texture_that_may_not_be_opened_is_a_warning(tmp_path) -> None:
    path = put_naming(tmp_path, "image.glb", "x.png")
    write_png(tmp_path / "x.png").chmod(0)
    assert "Permission denied" in load_mesh(path).warnings[0]


@pytest.mark.parametrize("image", [{"bufferView": 99}, {}, {"uri": "data:image/png;base64,!"}, {"bufferView": 0}])
def test_an_embedded_texture_that_is_broken_is_a_warning(tmp_path, image) -> None:
    g = plain_gltf()
    g.doc["images"] = [image]
    loaded = load_mesh(put(tmp_path, "x.glb", g.glb()))
    assert len(loaded.mesh.faces) == 12
    assert "'image_0'" in loaded.warnings[0]


def test_a_buffer_of_textures_alone_may_be_missing(tmp_path) -> None:
    g = plain_gltf()
    g.doc["images"] = [{"bufferView": len(g.doc["bufferViews"]), "mimeType": "image/png"}]
    tree = json.loads(g.gltf())
    tree["bufferViews"].append({"buffer": 1, "byteLength": 10})
    tree["buffers"].append({"uri": "gone.bin", "byteLength": 10})
    loaded = load_mesh(put(tmp_path, "x.gltf", json.dumps(tree).encode()))
    assert len(loaded.mesh.faces) == 12
    assert "gone.bin" in loaded.warnings[0]


def test_a_name_in_another_case_is_taken_only_where_it_is_the_only_one(tmp_path) -> None:
    path = put_naming(tmp_path, "image.glb", "Texture.PNG")
    write_png(tmp_path / "texture.png")
    assert textures(load_mesh(path)) == 1
    write_png(tmp_path / "TEXTURE.png")
    if len(list(tmp_path.glob("*.png"))) == 2:  # a case-sensitive file system
        assert "missing" in load_mesh(path).warnings[0]
        write_png(tmp_path / "Texture.PNG")
        assert textures(load_mesh(path)) == 1


def test_textures_of_a_material_library_lie_beside_it_or_beside_the_mesh(tmp_path) -> None:
    path = put(tmp_path, "x.obj", obj().replace(b"box.mtl", b"looks/other.mtl"))
    (tmp_path / "looks").mkdir()
    (tmp_path / "looks" / "other.mtl").write_bytes(MTL + b"map_Kd x.png\n")
    assert "'x.png'" in load_mesh(path).warnings[0]
    write_png(tmp_path / "x.png")
    assert textures(load_mesh(path)) == 1
    Image.new("RGB", (3, 3)).save(tmp_path / "looks" / "x.png")
    texture = load_mesh(path).mesh.materials[0].textures["base_color"]
    assert texture.data == (tmp_path / "looks" / "x.png").read_bytes()


def test_a_library_that_is_left_out_leaves_the_surface_plain(tmp_path) -> None:
    loaded = load_mesh(put(tmp_path, "x.obj", naming("gone.mtl")["library.obj"]))
    assert len(loaded.warnings) == 1
    assert (loaded.mesh.face_material == -1).all()


def test_the_digest_follows_what_was_read(tmp_path) -> None:
    path = put_naming(tmp_path / "root" / "meshes", "image.glb", "../x.png")
    outside = load_mesh(path).references
    missing = load_mesh(path, root=tmp_path / "root").references
    write_png(tmp_path / "root" / "x.png")
    found = load_mesh(path, root=tmp_path / "root").references
    assert found == load_mesh(path, root=tmp_path).references
    Image.new("RGB", (2, 2), "blue").save(tmp_path / "root" / "x.png")
    other = load_mesh(path, root=tmp_path / "root").references
    assert len({outside, missing, found, other}) == 4
    plain = [load_mesh(put(tmp_path / "root", "box.glb", FILES["box.glb"]), root=r).references for r in (None, tmp_path)]
    assert plain[0] == plain[1]


def test_nothing_outside_is_opened_or_listed(tmp_path, monkeypatch) -> None:
    write_png(tmp_path / "secret.png")
    path = put_naming(tmp_path / "inside", "image.glb", "../SECRET.png")
    touched: list[Path] = []
    for name in ("open", "read_bytes", "iterdir"):
        true = getattr(Path, name)
        monkeypatch.setattr(Path, name, lambda self, *a, true=true, **k: touched.append(self) or true(self, *a, **k))
    load_mesh(path)
    assert {p.resolve() for p in touched} <= {path.resolve(), path.parent.resolve()}
    assert np.isfinite(load_mesh(path).mesh.vertices).all()


@pytest.mark.parametrize("name", TEXTURED)
@pytest.mark.parametrize(
    "uri",
    [
        "../materials/textures/Wood Grain.png",
        "..\\materials\\textures\\Wood Grain.png",
        "../materials/textures/Wood%20Grain.png",
        "../Materials/Textures/wood grain.PNG",
        "file:../materials/textures/Wood%20Grain.png",
        "file://{root}/materials/textures/Wood%20Grain.png",
        "file://localhost{root}/materials/textures/Wood Grain.png",
        "{root}/materials/textures/Wood Grain.png",
        "model://box_model/materials/textures/Wood Grain.png",
        "package://materials/textures/Wood%20Grain.png",
        "package:\\\\box_model\\materials\\textures\\Wood Grain.png",
    ],
)
def test_a_root_lets_textures_lie_beside_the_folder_of_the_mesh(tmp_path, name, uri) -> None:
    root = tmp_path / "box_model"
    write_png(root / "materials" / "textures" / "Wood Grain.png")
    path = put_naming(root / "meshes", name, uri.replace("{root}", str(root.resolve())))
    loaded = load_mesh(path, root=root)
    assert (textures(loaded), loaded.warnings) == (1, ())
    assert textures(load_mesh(path)) == 0


def test_packages_lie_on_the_way_to_the_root_or_in_it(tmp_path) -> None:
    for folder in ("ws/robot/robot", "ws/robot", "ws/other"):
        write_png(tmp_path / folder / "x.png")
    path = put_naming(tmp_path / "ws" / "robot" / "meshes", "image.glb", "package://robot/robot/x.png")
    assert textures(load_mesh(path, root=tmp_path / "ws")) == 1
    for uri, readable in (("package://other/x.png", 1), ("package://meshes/../x.png", 1), ("package://gone/x.png", 0)):
        put_naming(path.parent, "image.glb", uri)
        assert textures(load_mesh(path, root=tmp_path / "ws")) == readable
    put_naming(path.parent, "image.glb", "package://ws/../../x.png")
    write_png(tmp_path.parent / "x.png")
    assert "outside" in load_mesh(path, root=tmp_path / "ws").warnings[0]


def test_a_root_does_not_follow_links_that_leave_it(tmp_path) -> None:
    write_png(tmp_path / "secret" / "x.png")
    path = put_naming(tmp_path / "root" / "meshes", "image.glb", "../textures/x.png")
    (tmp_path / "root" / "textures").symlink_to(tmp_path / "secret")
    loaded = load_mesh(path, root=tmp_path / "root")
    assert textures(loaded) == 0
    assert "outside" in loaded.warnings[0]


def test_geometry_may_lie_within_the_root(tmp_path) -> None:
    (tmp_path / "buffers").mkdir()
    (tmp_path / "meshes").mkdir()
    (tmp_path / "buffers" / "box.bin").write_bytes(plain_gltf().bin)
    path = put(tmp_path / "meshes", "box.gltf", plain_gltf().gltf("../buffers/box.bin"))
    (tmp_path / "meshes" / "box.bin").unlink()
    assert len(load_mesh(path, root=tmp_path).mesh.faces) == 12
    with pytest.raises(InputError, match="outside"):
        load_mesh(path)


@pytest.mark.parametrize("root", ["file.txt", "none", "inside/deeper", "other", ""])
def test_a_root_that_is_not_valid(tmp_path, monkeypatch, root) -> None:
    path = put_naming(tmp_path / "inside", "image.glb", "x.png")
    for folder in ("inside/deeper", "other"):
        (tmp_path / folder).mkdir()
    (tmp_path / "file.txt").touch()
    monkeypatch.chdir(tmp_path / "other")
    with pytest.raises(OptionError, match=r"--root: .*valid is the mesh's folder or one above it"):
        load_mesh(path, root=tmp_path / root if root else "")
