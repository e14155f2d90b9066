"""Files handed to the page: names, sizes and zips that are not to be trusted, and zips that are fine."""

import io
import stat
import zipfile

import pytest

from anymesh.errors import InputError
from anymesh.formats import zipped as archives
from anymesh.loading import load_mesh
from anymesh.viewer.intake import uploads
from anymesh.viewer.intake.uploads import plain_name, receive

OBJ = b"mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
MTL = b"newmtl red\nKd 1 0 0\n"


def zipped(files: dict[str, bytes], **links: str) -> bytes:
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
        for name, target in links.items():
            entry = zipfile.ZipInfo(name)
            entry.create_system, entry.external_attr = 3, (stat.S_IFLNK | 0o777) << 16
            archive.writestr(entry, target)
    return sink.getvalue()


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("chair.glb", "chair.glb"),
        ("../../etc/passwd.obj", "passwd.obj"),
        ("C:\\Users\\me\\Stuhl ä.GLB", "Stuhl_.GLB"),
        (".hidden.stl", "hidden.stl"),
        ("<img src=x onerror=alert(1)>.glb", "img_src_x_onerror_alert_1_.glb"),
        ("", "mesh"),
        ("..", "mesh"),
        ("a" * 300 + ".glb", "a" * 60 + ".glb"),
    ],
)
def test_names_become_plain(name: str, plain: str) -> None:
    assert plain_name(name) == plain


def test_a_mesh_is_saved_under_its_plain_name(tmp_path) -> None:
    got = receive("../my box.obj", OBJ, tmp_path / "in")
    assert got.mesh == tmp_path / "in" / "my_box.obj"
    assert got.mesh.read_bytes() == OBJ


def test_a_zip_gives_its_mesh_with_what_it_refers_to(tmp_path) -> None:
    files = {"set/model/box.obj": OBJ, "set/model/box.mtl": MTL, "__MACOSX/set/._box.obj": b"junk", "set/.DS_Store": b"junk"}
    got = receive("set.zip", zipped(files), tmp_path / "in")
    assert got.mesh.relative_to(got.root).as_posix() == "set/model/box.obj"
    assert sorted(p.name for p in (tmp_path / "in").rglob("*") if p.is_file()) == ["box.mtl", "box.obj"]
    loaded = load_mesh(got.mesh, root=got.root)
    assert [m.name for m in loaded.mesh.materials] == ["red"]
    assert loaded.warnings == ()


@pytest.mark.parametrize("name", ["../out.obj", "/out.obj", "a/../../out.obj", "C:out.obj", "a\\..\\out.obj"])
def test_entries_that_lead_out_are_refused(tmp_path, name: str) -> None:
    with pytest.raises(InputError, match="unsafe entry"):
        receive("x.zip", zipped({"box.obj": OBJ, name: OBJ}), tmp_path / "in")
    assert not list(tmp_path.rglob("out.obj"))


def test_links_are_refused(tmp_path) -> None:
    with pytest.raises(InputError, match="unsafe entry"):
        receive("x.zip", zipped({"box.obj": OBJ}, link="/etc/passwd"), tmp_path / "in")


def test_a_bomb_is_stopped_while_it_unpacks(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(archives, "MAX_UNPACKED_BYTES", 3 << 20)
    bomb = zipped({"box.obj": OBJ, "a.bin": bytes(2 << 20), "b.bin": bytes(2 << 20)})
    assert len(bomb) < 10_000
    with pytest.raises(InputError, match="more than 3 MB once unpacked"):
        receive("x.zip", bomb, tmp_path / "in")
    assert sum(p.stat().st_size for p in tmp_path.rglob("*") if p.is_file()) < (3 << 20) + 10_000


def test_a_header_that_lies_about_its_size_gains_nothing(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(archives, "MAX_UNPACKED_BYTES", 1 << 20)
    content = bytearray(zipped({"box.obj": bytes(2 << 20)}))
    at = content.rindex(b"PK\x01\x02") + 24  # the uncompressed size in the central directory
    content[at : at + 4] = (100).to_bytes(4, "little")
    with pytest.raises(InputError):
        receive("x.zip", bytes(content), tmp_path / "in")
    assert sum(p.stat().st_size for p in tmp_path.rglob("*") if p.is_file()) < 2 << 20


def test_too_much_too_many_and_nothing(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(uploads, "MAX_UPLOAD_BYTES", 1 << 20)
    monkeypatch.setattr(archives, "MAX_FILES", 5)
    for k, (name, content, told) in enumerate(
        [
            ("x.glb", bytes(3 << 20), "3 MB; at most 1 MB"),
            ("x.zip", zipped({f"{n}.txt": b"" for n in range(6)}), "6 files; at most 5"),
            ("x.zip", zipped({"a.txt": b"text"}), "no mesh"),
            ("x.zip", zipped({"a.obj": OBJ, "b.stl": b"x"}), r"2 meshes \(a.obj, b.stl\)"),
            ("x.zip", b"PK\x03\x04 and no more", "broken or of an unknown kind"),
            ("x.zip", zipped({"a.obj": OBJ, "inner.zip": b"x"})[:-30], "broken or of an unknown kind"),
            ("x.blend", b"BLENDER", "found the format .blend; it is Blender's; in Blender, choose File"),
            ("mesh", b"", r"\(none\)"),
        ]
    ):
        with pytest.raises(InputError, match=told):
            receive(name, content, tmp_path / str(k))
