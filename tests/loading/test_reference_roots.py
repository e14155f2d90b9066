"""Test references that a root admits: folders beside the mesh, packages and links."""

import pytest
from mesh_files import plain_gltf, put
from naming_files import TEXTURED, put_naming, textures, write_png

from anymesh.errors import InputError, OptionError
from anymesh.loading import load_mesh


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
