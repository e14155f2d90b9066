"""What the error says of a file that is not read as it is, and that the documentation has the same line."""

from pathlib import Path

import pytest

from anymesh.errors import InputError, MissingExtraError
from anymesh.formats import reading
from anymesh.formats.advice import CASES, LIBRARIES, OTHERS, advise, needs_extra, rows
from anymesh.loading.load import load_mesh

GLB = b"glTF\x02\0\0\0"


@pytest.mark.parametrize(
    ("name", "content", "line"),
    [
        ("a.glb", b"<!DOCTYPE html><title>Sign in</title>", advise("page")),
        ("a.glb", b"version https://git-lfs.github.com/spec/v1\noid sha256:0", advise("lfs")),
        ("a.glb", b"404: Not Found", advise("text", expected="GLB", text="404: Not Found")),
        ("a.ply", GLB, advise("renamed", expected="PLY", kind="a GLB", way="give it the extension .glb")),
        ("a.fbx", b"BLENDER-v405", f"but a Blender file; {OTHERS['.blend'].partition('; ')[2]}"),
        ("a.glb", bytes(90), advise("unknown", expected="GLB")),
        ("a.obj", b"\x89PNG\r\n", "but a PNG picture; give the mesh"),
    ],
)
def test_what_a_file_is_and_what_to_do(name, content, line, tmp_path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError) as error:
        load_mesh(tmp_path / name)
    assert str(error.value).startswith(f"{name}: ")
    assert str(error.value).endswith(line)


def test_an_address_is_quoted_as_it_was_given() -> None:
    with pytest.raises(InputError) as error:
        load_mesh(Path("https://example.com/chair.glb?raw=1"))
    assert str(error.value) == f"https://example.com/chair.glb?raw=1: {advise('url')}"


def test_a_format_without_its_extra_names_the_command(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(reading, "find_spec", lambda library: None)
    files = {"a.usdz": (b"PK", "pxr"), "a.fbx": (b"Kaydara FBX", "ufbx"), "a.step": (b"ISO-10303-21", "cascadio")}
    for name, (start, library) in files.items():
        (tmp_path / name).write_bytes(start)
        with pytest.raises(MissingExtraError) as error:
            load_mesh(tmp_path / name)
        assert str(error.value) == f"{name}: {needs_extra(library)}"


def test_the_lines_say_what_was_found_and_what_to_do() -> None:
    table = dict(rows())
    assert len(table) == len(CASES) + len(LIBRARIES) + len(set(OTHERS.values()))
    assert [line for line in table.values() if "; " not in line or "\n" in line or "{" in line] == []


def test_the_page_has_the_same_lines() -> None:
    page = (Path(__file__).parents[2] / "docs" / "your-mesh.md").read_text(encoding="utf-8").replace("`", "")
    assert [row for row in rows() if "| {} | {} |".format(*row).replace("`", "") not in page] == []
