"""Test what `check_asset` accepts: folders, MJCF files, and files that are not XML."""

import struct

import pytest
from assets import cabinet, slanted
from drawn import chest

from anymesh.checking import check_asset
from anymesh.errors import InputError
from anymesh.export import write_asset


def test_what_is_checked_in_a_folder(tmp_path):
    with pytest.raises(InputError, match="no URDF and no MJCF"):
        check_asset(tmp_path)
    path = chest(tmp_path)
    assert check_asset(tmp_path, engines=()).ok
    (tmp_path / "other.urdf").write_text(path.read_text())
    with pytest.raises(InputError, match=r"chest\.urdf, other\.urdf"):
        check_asset(tmp_path)
    with pytest.raises(InputError, match="not there"):
        check_asset(tmp_path / "none")
    (tmp_path / "a.xml").write_text("<svg/>")
    with pytest.raises(InputError, match="neither URDF nor MJCF"):
        check_asset(tmp_path / "a.xml")


def test_the_mjcf_of_our_own_output_is_in_order_too(tmp_path):
    write_asset(slanted(), tmp_path)  # with a fixed joint
    report = check_asset(tmp_path / "slanted.xml")
    assert report.ok, "\n".join(report.lines())


@pytest.mark.parametrize("file", ["cabinet.urdf", "cabinet.xml", "."])
def test_a_relative_path_is_as_good_as_an_absolute_one(file, tmp_path, monkeypatch):
    """An MJCF names its pictures relative to its own folder."""
    (tmp_path / "out").mkdir()
    write_asset(cabinet(), tmp_path / "out")
    monkeypatch.chdir(tmp_path)
    report = check_asset(f"out/{file}", engines=())
    assert report.ok, "\n".join(report.lines())


def test_a_file_that_is_no_xml_is_a_finding(tmp_path):
    (tmp_path / "a.urdf").write_bytes(struct.pack("<4I", *range(4)))
    report = check_asset(tmp_path)
    assert not report.ok
    assert report.findings[0].check == "schema"
