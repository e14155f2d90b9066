"""The report as a file: what it holds, that it asks for nothing from outside, and that no word in it becomes markup."""

import json
import math
import sys
from dataclasses import replace

import numpy as np
import pytest
import typer
from assets import cabinet, joint, mesh_of, posed_triangles, slanted, source
from correctable import write_output
from shown import Page, asked, folder_of, hostile, picture, script_hash, styles
from typer.testing import CliRunner

import anymesh
from anymesh.errors import InputError, OutputError
from anymesh.loading import load_mesh
from anymesh.types import Asset, Part, Segmentation
from anymesh.viewer.command_line import picture as picture_command
from anymesh.viewer.command_line import report
from anymesh.viewer.report import asset_html, show, write_report
from anymesh.viewer.report_asset import FROM_Y_UP, asset_entry, displayed, find_assets, read_asset
from anymesh.viewer.report_html import html_report


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    """A folder of two assets and one that is broken; names with markup in them."""
    root = tmp_path_factory.mktemp("results")
    told = replace(hostile(), exchanges=(asked(picture((200, 0, 0)), text="<script>window.hacked = 3</script>"),))
    folder_of(told, root / "<i>cabinet</i>")
    folder_of(slanted(), root / "deep" / "slanted")
    (root / "broken").mkdir()
    (root / "broken" / "asset.json").write_text("{")
    (root / ".hidden").mkdir()
    (root / ".hidden" / "asset.json").write_text("{}")
    write_report(root, root / "page.html")
    return root


@pytest.fixture(scope="module")
def page(two) -> Page:
    return Page((two / "page.html").read_text(encoding="utf-8"))


def grid(count: int) -> Asset:
    """A box-like heightfield of 2 * count^2 faces, its left half red, in two parts."""
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    points = np.stack([x, y, 0.05 * np.sin(6 * x) * np.cos(5 * y)], -1).reshape(-1, 3)
    at = np.arange(count)[:, None] * (count + 1) + np.arange(count)
    faces = np.concatenate(
        [np.stack(c, -1).reshape(-1, 3) for c in ((at, at + count + 1, at + count + 2), (at, at + count + 2, at + 1))]
    )
    mesh, _ = mesh_of([(points, faces)])
    left = mesh.triangles.mean(1)[:, 0] < 0.5
    colors = np.where(left[:, None, None], np.array([220, 20, 20, 255]), np.array([20, 20, 220, 255])).astype(np.uint8)
    mesh = replace(mesh, corner_color=np.repeat(colors, 3, axis=1))
    slide = joint("slide", "prismatic", "base", "lid", (0.7, 0.5, 0), (0, 0, 1), (0.0, 0.3))
    return Asset(
        "grid", source(), mesh, Segmentation((~left).astype(int), (Part("base", "base"), Part("lid", "lid"))), (slide,), "test"
    )


def test_a_folder_is_read_back_as_the_asset_that_was_written(tmp_path):
    for asset in (cabinet(exchanges=(asked(picture((1, 2, 3))),)), slanted()):
        found = read_asset(folder_of(asset, tmp_path / asset.name))
        was = posed_triangles(asset, {})
        for name, triangles in posed_triangles(found, {}).items():
            low, high = (np.sort(t.reshape(-1, 9), axis=0)[[0, -1]] for t in (triangles, was[name]))
            np.testing.assert_allclose(low, high, atol=1e-6)
            assert len(triangles) == len(was[name])
        for mine, theirs in zip(found.joints, asset.joints, strict=True):
            assert (mine.name, mine.type, mine.parent, mine.child) == (theirs.name, theirs.type, theirs.parent, theirs.child)
            np.testing.assert_allclose([*mine.axis, *mine.origin], [*theirs.axis, *theirs.origin], atol=1e-9)
            assert mine.reason == theirs.reason
        assert found.warnings == asset.warnings
        assert found.exchanges == asset.exchanges


def test_what_is_no_asset_is_told(tmp_path):
    with pytest.raises(InputError, match="articulate"):
        find_assets(tmp_path)
    with pytest.raises(InputError, match="not a folder"):
        write_report(tmp_path / "nothing")
    folder = folder_of(cabinet(), tmp_path / "cabinet")
    record = json.loads((folder / "asset.json").read_text())
    (folder / "cabinet.glb").rename(folder / "kept.glb")
    with pytest.raises(InputError, match="anymesh export"):
        read_asset(folder)
    (folder / "kept.glb").rename(folder / "cabinet.glb")
    for change in ({"joints": 3}, {"parts": []}, {"parts": record["parts"][:2]}, {"name": "../cabinet"}, {"source": {}}):
        (folder / "asset.json").write_text(json.dumps(record | change))
        with pytest.raises(InputError):
            read_asset(folder)


def test_assets_come_least_sure_first_and_a_broken_one_does_not_end_the_report(page, two):
    assert [p.relative_to(two).as_posix() for p in find_assets(two)] == ["<i>cabinet</i>", "broken", "deep/slanted"]
    links = [(a["href"]) for a in page.all("a")]
    assert links == ["#a0", "#a1", "#a2"]
    assert page.words["h2"] == "broken<i>cabinet</i>deep/slanted"
    assert "cannot be shown" in page.words["span"]
    assert sorted(k for k in page.data if k.startswith("glb")) == ["glb-1", "glb-2"]


def test_the_page_asks_for_nothing_from_outside(page, two):
    assert page.open == []
    assert all(a.startswith(("#a", "data:image/jpeg;base64,")) for a in page.addresses())
    policy = page.policy()
    assert policy["default-src"] == ["'none'"]
    assert policy["script-src"] == [script_hash(s) for s in page.scripts]
    assert policy["style-src"] == [script_hash(styles((two / "page.html").read_text(encoding="utf-8")))]
    assert (policy["connect-src"], policy["img-src"]) == (["blob:"], ["data:", "blob:"])
    assert not any(name.startswith("on") or name == "style" for _, found in page.elements for name in found)


def test_words_are_words(page):
    assert {tag for tag, _ in page.elements} <= set(
        "html head meta title style body header h1 h2 h3 h4 p details summary div table thead tbody tr th td a section ul ol "
        "li span button label input output i b small img article pre figure figcaption script".split()
    )
    assert all(i.get("data-picture") or str(i.get("src")).startswith("data:") for i in page.all("img"))
    assert "window.hacked = 3" in page.words["pre"]
    assert "window.hacked = 2" in page.words["li"] + page.words["td"]
    assert "\u202e" not in page.words["li"]
    assert not any("hacked" in s for s in page.scripts)


def test_no_name_ends_the_data_it_stands_in(tmp_path):
    folder = folder_of(cabinet(), tmp_path / "cabinet")
    record = json.loads((folder / "asset.json").read_text())
    bad = record["joints"][0]["name"] = "</script><script>alert(1)</script>"
    (folder / "asset.json").write_text(json.dumps(record))
    write_report(folder, tmp_path / "page.html")
    page = Page((tmp_path / "page.html").read_text(encoding="utf-8"))
    assert page.scene(0)["joints"][0]["name"] == bad
    assert bad in page.words["b"]
    assert len(page.scripts) == 3


def test_the_3d_data_is_the_assets_own(page, two, tmp_path):
    folder = two / "<i>cabinet</i>"
    assert page.glb(1) == (folder / "cabinet.glb").read_bytes()
    scene = page.scene(1)
    assert [link["name"] for link in scene["links"]] == ["base", "door", "drawer", "knob"]
    assert [link["parent"] for link in scene["links"]] == [-1, 0, 0, 2]
    for told, j in zip(scene["joints"], cabinet().joints, strict=True):
        assert (told["name"], told["type"], told["axis"]) == (j.name, j.type, j.axis.tolist())
        assert told["limits"] == (j.limits and list(j.limits))
        ends = np.array(told["ends"])
        np.testing.assert_allclose(np.cross(ends[1] - ends[0], j.axis), 0, atol=1e-9)
    np.testing.assert_allclose(scene["joints"][0]["ends"][0][:2], [0.6, 0.0], atol=1e-9)
    outward = np.array([link["away"] for link in scene["links"]])
    assert outward[2] @ [0, -1, 0] > 0.3
    assert not outward[0].any()


def test_sliders_have_the_joints_limits_and_fixed_joints_none(page):
    ranges = [i for i in page.all("input") if i["type"] == "range" and i["aria-label"] != "explode"]
    joints = [*cabinet().joints, *slanted().joints[:3]]
    assert [i["aria-label"] for i in ranges] == [j.name for j in joints]
    for found, j in zip(ranges, joints, strict=True):
        low, high = j.limits or (-np.pi, np.pi)
        assert (float(str(found["min"])), float(str(found["max"]))) == pytest.approx((low, high))
        assert float(str(found["value"])) == 0


def test_the_transcript_is_there_with_its_pictures_once(page):
    kept = json.loads(page.data["anymesh-pictures"])
    used = [i["data-picture"] for i in page.all("img") if i.get("data-picture")]
    assert len(used) == 1
    assert set(used) == set(kept)
    assert "Questions to the model: 1" in page.words["summary"]


def test_the_same_folder_gives_the_same_bytes(two, tmp_path):
    first = (two / "page.html").read_bytes()
    write_report(two, tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == first


def test_a_page_is_limited_and_says_so(two, tmp_path):
    told = write_report(two, tmp_path / "small.html", megabytes=1e-6)
    small = Page((tmp_path / "small.html").read_text(encoding="utf-8"))
    assert not any(k.startswith("glb") for k in small.data)
    assert len(told.notes) == 3
    assert all("limited" in note for note in told.notes)
    assert small.words["p"].count("limited") == 3
    assert json.loads(small.data["anymesh-pictures"]) == {}
    assert write_report(two, tmp_path / "all.html", megabytes=math.inf).notes == ()


def test_a_report_lies_beside_the_folder_and_cannot_be_written_nowhere(tmp_path):
    folder = folder_of(cabinet(), tmp_path / "cabinet")
    told = write_report(folder)
    assert told.path == tmp_path / "cabinet_report.html"
    assert (told.assets, told.unreadable, told.notes) == (1, (), ())
    assert told.size == told.path.stat().st_size
    assert "cabinet_report.html" not in [p.name for p in folder.iterdir()]
    with pytest.raises(OutputError):
        write_report(folder, tmp_path / "no" / "page.html")


def test_a_large_asset_is_decimated_for_display_and_keeps_its_colours_and_parts():
    asset = grid(60)
    light, notes = displayed(asset, faces=1500)
    assert notes == (f"Decimated for display: {len(light.mesh.faces):,} of 7,200 faces. The files are unchanged.",)
    assert len(light.mesh.faces) < 2000
    np.testing.assert_allclose(light.mesh.bounds, asset.mesh.bounds, atol=0.02)
    red = light.mesh.corner_color[:, :, 0].mean(1) > 128
    middle = light.mesh.triangles.mean(1)[:, 0]
    assert (red == (light.segmentation.face_part == 0))[abs(middle - 0.5) > 0.05].all()
    assert ((middle < 0.5) == (light.segmentation.face_part == 0))[abs(middle - 0.5) > 0.05].all()
    assert displayed(asset, faces=7200) == (asset, ())


def test_a_decimated_asset_goes_into_the_page(tmp_path):
    page = Page(html_report("grid", [asset_entry(grid(60), faces=1500)]))
    assert "Decimated for display" in page.words["p"]
    (tmp_path / "light.glb").write_bytes(page.glb(0))
    light = load_mesh(tmp_path / "light.glb").mesh.transformed(FROM_Y_UP)
    assert len(light.faces) < 2000
    assert {n.name for n in light.nodes} == {"base", "lid"}


def test_large_textures_shrink_for_display():
    asset = cabinet()
    small, notes = displayed(asset, pixels=4)
    assert "from up to 8 to 4 pixels" in notes[0]
    assert len(small.mesh.materials[1].textures["base_color"].data) > 0
    assert displayed(asset, pixels=8) == (asset, ())


def test_a_notebook_shows_an_asset_in_a_frame_of_its_own():
    html = asset_html(cabinet())
    frame = Page(html).all("iframe")
    assert len(frame) == 1
    assert frame[0]["sandbox"] == "allow-scripts"
    inner = Page(str(frame[0]["srcdoc"]))
    assert inner.open == []
    assert inner.scene(0)["joints"][0]["name"] == "hinge"
    assert cabinet()._repr_html_() == html


def test_show_makes_a_frame_in_a_notebook_and_a_page_for_the_browser_elsewhere(tmp_path, monkeypatch, capsys):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    folder = write_output(tmp_path / "box")
    shown = [show(str(folder)), show(anymesh.load(folder))]
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[3] for line in lines] == ["box", "cabinet"]
    for page, line in zip(shown, lines, strict=True):
        assert str(page.path) in line
        assert repr(page) == f"report in {page.path}"
        assert "hinge" in page.path.read_text(encoding="utf-8")
    assert opened == [] or sys.platform != "linux"
    monkeypatch.setenv("DISPLAY", ":0")
    path = show(cabinet()).path
    assert opened[-1] == path.as_uri()
    monkeypatch.setitem(sys.modules, "ipykernel", object())
    assert show(cabinet()).path is None
    assert show(cabinet())._repr_html_() == asset_html(cabinet())
    with pytest.raises(InputError):
        show(tmp_path / "nowhere")


def test_after_load_ext_a_shell_prints_one_line_per_joint():
    told = {}

    class Formatter:
        def for_type(self, kind, function):
            told[kind] = function

    shell = type("Shell", (), {"display_formatter": type("D", (), {"formatters": {"text/plain": Formatter()}})})
    anymesh.load_ipython_extension(shell)
    printed = []
    told[Asset](cabinet(), type("Printer", (), {"text": printed.append}), False)
    lines = printed[0].splitlines()
    assert lines[0].endswith(f"{len(cabinet().joints)} joints")
    assert [line.split(":")[0].strip() for line in lines[1:]] == [joint.name for joint in cabinet().joints]


@pytest.fixture(scope="module")
def app() -> typer.Typer:
    made = typer.Typer()
    made.command()(report)
    made.command("picture")(picture_command)
    return made


def called(app: typer.Typer, *arguments) -> str:
    result = CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def test_the_path_of_a_report_is_printed_as_text_or_json_or_not_at_all(app, tmp_path):
    folder = folder_of(cabinet(), tmp_path / "all" / "cabinet")
    (tmp_path / "all" / "odd\tname").mkdir()
    (tmp_path / "all" / "odd\tname" / "asset.json").write_text("[]")
    lines = called(app, "report", tmp_path / "all", "-o", tmp_path / "page.html").splitlines()
    assert lines[0] == "cannot be shown: odd?name"
    assert lines[1].startswith(f"wrote {tmp_path / 'page.html'}: 2 assets, ")
    told = json.loads(called(app, "report", folder, "--json"))
    assert told["path"] == str(tmp_path / "all" / "cabinet_report.html")
    assert (told["assets"], told["unreadable"], told["notes"]) == (1, [], [])
    assert called(app, "report", folder, "-q") == ""


def test_a_picture_is_written_where_it_is_said(app, tmp_path):
    folder = folder_of(cabinet(), tmp_path / "cabinet")
    assert called(app, "picture", folder, "-o", tmp_path / "sheet.png").strip() == f"wrote {tmp_path / 'sheet.png'}"
    assert called(app, "picture", folder, "-o", tmp_path / "a.gif", "--size", "32", "--rate", "1", "--turn", "0", "-q") == ""
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF89a")
