"""Test the ROS package and the zip of a written asset."""

import zipfile
from dataclasses import replace
from xml.etree import ElementTree

import pytest
import yourdfpy
from models import CONFIG, desk, model_of, with_meshes

from anymesh.errors import InputError, OutputError
from anymesh.export.formats import DEFAULT, write_formats
from anymesh.export.model import Base
from anymesh.export.package import check_zip, write_package, write_zip


@pytest.fixture
def written(tmp_path):
    model = model_of(replace(desk(), name="Desk__No_7"))
    folder = tmp_path / "Desk__No_7"
    folder.mkdir()
    write_formats(model, with_meshes(model, folder), DEFAULT, CONFIG)
    return folder


@pytest.mark.parametrize("base", Base)
def test_a_package_is_whole_by_itself(written, tmp_path, base):
    package = write_package(written, tmp_path / "ros", base=base)
    assert package.name == "desk_no_7"
    assert ElementTree.parse(package / "package.xml").getroot().findtext("name") == package.name
    assert f"project({package.name})" in (package / "CMakeLists.txt").read_text()
    urdf = package / "urdf" / "Desk__No_7.urdf"
    files = [str(m.get("filename")) for m in ElementTree.parse(urdf).getroot().iter("mesh")]
    assert files
    assert all((package / f.removeprefix(f"package://{package.name}/")).is_file() for f in files)
    assert all(f.startswith(f"package://{package.name}/meshes/") for f in files)
    for mtl in (package / "meshes").glob("*.mtl"):
        for line in mtl.read_text().splitlines():
            assert not line.startswith(("map_", "norm ")) or (package / "meshes" / line.split()[1]).is_file()
    assert not list(package.rglob("*.npy"))
    robot = yourdfpy.URDF.load(str(urdf), load_meshes=False)
    assert robot.base_link == ("world" if base is Base.FIXED else "desk")
    assert robot.validate()


def test_a_package_is_not_overwritten_and_needs_a_urdf(written, tmp_path):
    write_package(written, tmp_path, base=Base.FREE)
    with pytest.raises(OutputError, match="exists"):
        write_package(written, tmp_path, base=Base.FREE)
    with pytest.raises(InputError, match=r"one \.urdf, found 0"):
        write_package(tmp_path / "desk_no_7", tmp_path, base=Base.FREE)


def test_a_package_needs_a_folder(written, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="exists"):
        write_package(written, tmp_path / "file", base=Base.FREE)


@pytest.mark.parametrize("path", ["", "asset.json", "lost/a.zip", "folder.zip"])
def test_a_zip_needs_a_name_of_its_own_in_a_folder_that_exists(tmp_path, path):
    (tmp_path / "folder.zip").mkdir()
    with pytest.raises(OutputError, match=r"ends in \.zip"):
        check_zip(tmp_path / path)
    check_zip(tmp_path / "a.zip")


def test_a_zip_holds_the_folder_and_its_bytes_do_not_depend_on_when(written, tmp_path):
    contents = []
    for run in ("a.zip", "b.zip"):
        for file in written.rglob("*"):
            file.touch()
        (written / ".hidden").touch()
        write_zip(written, tmp_path / run)
        contents.append((tmp_path / run).read_bytes())
    assert contents[0] == contents[1]
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        assert archive.testzip() is None
        assert {i.date_time[0] for i in archive.infolist()} == {1980}
        found = {name: archive.read(name) for name in archive.namelist()}
    whole = {p.relative_to(tmp_path).as_posix(): p.read_bytes() for p in written.rglob("*") if p.is_file()}
    del whole["Desk__No_7/.hidden"]
    assert found == whole
    assert list(found) == sorted(found)
