"""What a file names lies in its own folder; a picture may be missing, the rest may not."""

import pytest
from mesh_files import all_files, dae, obj, plain_gltf, put, refused

from anymesh.loading import load_mesh

FILES = all_files()


OUTSIDE = ["../secret.png", "/etc/hostname", "a/../../secret.png", "..\\secret.png", "C:\\secret.png"]
URLS = ["https://example.org/x.png", "http://127.0.0.1:9/x.png", "file:///etc/hostname"]


def naming(uri: str) -> dict[str, bytes]:
    """Files that name another file, each in its own way."""
    g = plain_gltf()
    g.doc["images"] = [{"uri": uri}]
    picture = dae(look='<texture texture="p" texcoord="c"/>').replace(b"checker.png", uri.encode())
    return {
        "buffer.gltf": plain_gltf().gltf(uri),
        "image.glb": g.glb(),
        "library.obj": obj().replace(b"box.mtl", uri.encode()),
        "picture.obj": obj().replace(b"box.mtl", b"other.mtl"),
        "picture.ply": FILES["ascii.ply"].replace(b"made by hand", b"TextureFile " + uri.encode()),
        "picture.dae": picture,
    }


@pytest.mark.parametrize("uri", [*OUTSIDE, *URLS])
@pytest.mark.parametrize("name", naming(""))
def test_a_reference_that_leads_outside(tmp_path, name, uri) -> None:
    (tmp_path / "secret.png").write_bytes(b"secret")
    folder = tmp_path / "inside"
    folder.mkdir()
    (folder / "other.mtl").write_bytes(f"newmtl red\nmap_Ks {uri}\n".encode())
    refused(put(folder, name, naming(uri)[name]), "URL" if uri in URLS else "outside", "valid are files")


@pytest.mark.parametrize("uri", ["%2e%2e/secret.png", "link.png"])
def test_a_reference_that_leads_outside_in_disguise(tmp_path, uri) -> None:
    (tmp_path / "secret.png").write_bytes(b"secret")
    folder = tmp_path / "inside"
    folder.mkdir()
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    refused(put(folder, "image.glb", naming(uri)["image.glb"]), "outside")


@pytest.mark.parametrize("broken", [False, True])
@pytest.mark.parametrize("name", ["image.glb", "library.obj", "picture.obj", "picture.ply", "picture.dae"])
def test_a_missing_or_broken_picture_is_a_warning(tmp_path, name, broken) -> None:
    (tmp_path / "other.mtl").write_bytes(b"newmtl red\nKd 1 0 0\nmap_Kd gone.png\n")
    if broken:
        (tmp_path / "gone.png").write_bytes(b"\x89PNG\r\n\x1a\n broken")
    loaded = load_mesh(put(tmp_path, name, naming("gone.png")[name]))
    assert len(loaded.mesh.faces) == 12
    if not (broken and name == "library.obj"):  # there the name is one of materials, in which nothing is found
        (warning,) = loaded.warnings
        assert "gone.png" in warning


def test_a_warning_about_a_broken_picture_is_the_same_each_time(tmp_path) -> None:
    (tmp_path / "x.png").write_bytes(b"\x89PNG broken")
    path = put(tmp_path, "picture.dae", naming("x.png")["picture.dae"])
    warnings = [load_mesh(path).warnings for _ in range(3)]
    assert warnings[0]
    assert len(set(warnings)) == 1
    assert "0x" not in " ".join(warnings[0])
