"""Test the set of formats, and its errors."""

import sys

import pytest
from assets import cabinet
from models import CONFIG, model_of, with_meshes

from anymesh.errors import MissingExtraError, OptionError
from anymesh.export.formats import (
    DEFAULT,
    WRITERS,
    ExportOptions,
    Format,
    load_libraries,
    main_file,
    parse_formats,
    write_formats,
)


def test_formats_are_read_once_each_in_the_order_of_the_set():
    assert parse_formats("glb, URDF,glb") == (Format.URDF, Format.GLB)
    assert parse_formats(",".join(Format)) == tuple(Format)
    assert Format.USD not in DEFAULT  # requires the extra


@pytest.mark.parametrize("text", ["", " , ", "urdf,stl", "xml"])
def test_what_is_not_a_format_is_named_with_what_is(text):
    with pytest.raises(OptionError, match="valid are urdf, mjcf, usd, sdf, glb") as error:
        parse_formats(text)
    assert text.rpartition(",")[2].strip() in str(error.value)


def test_every_format_has_a_writer_and_writes_its_main_file(tmp_path):
    assert set(WRITERS) == set(Format)
    model = model_of(cabinet())
    for kind in Format:
        folder = tmp_path / kind
        folder.mkdir()
        write_formats(model, with_meshes(model, folder), [kind], CONFIG)
        written = {p.name for p in folder.iterdir()} - {"meshes", "model.config"}
        assert written == {main_file(kind, "cabinet")}


@pytest.mark.parametrize(
    ("kind", "package", "told"), [("usd", "pxr", r"articulate-anymesh\[usd\]"), ("mjcf", "mujoco", "reinstall")]
)
def test_a_missing_package_is_one_error_that_says_how_it_is_had(kind, package, told, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingExtraError, match=told):
        write_formats(model_of(cabinet()), tmp_path, [Format(kind)], CONFIG)
    assert not list(tmp_path.iterdir())
    if kind == "usd":
        with pytest.raises(MissingExtraError, match=told):
            load_libraries([Format.URDF, Format.USD])


def test_the_options_of_an_asset_are_those_that_it_was_written_with() -> None:
    asset = {"files": {"usd": "a.usda", "mjcf": "a.xml"}, "base": "free", "drives": "position"}
    assert ExportOptions.of(asset) == ExportOptions.parse("free", "mjcf,usd", "position")
    assert ExportOptions.of({}) == ExportOptions.parse("fixed", "urdf,mjcf,sdf,glb", "passive")


@pytest.mark.parametrize("damaged", [{"base": "fixd"}, {"base": ["fixed"]}, {"drives": 1}])
def test_a_damaged_record_of_an_asset_gives_one_clear_error(damaged: dict) -> None:
    with pytest.raises(OptionError, match=r"found .*; valid are"):
        ExportOptions.of(damaged)
