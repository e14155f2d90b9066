"""The report in a real browser, from a file URL. Slow: a fresh machine has no browser; docs/report.md has the command."""

import json
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet, slanted
from browser import Tab
from mechanical import doors, jar, linkage, stick
from moved import agree, changed, frames, slide
from shown import asked, folder_of, hostile, picture

from anymesh.mechanisms.following import together
from anymesh.viewer.report import asset_html, write_report

pytestmark = pytest.mark.slow


def test_it_opens_from_a_file_without_errors_and_shows_the_object(opened: Tab) -> None:
    assert opened.page.url.startswith("file:")
    drawn = opened.pixels(".stage canvas")
    assert changed(drawn, np.broadcast_to(drawn[2, 2], drawn.shape)).mean() > 0.1
    reds = (drawn[..., 0] > 150) & (drawn[..., 1] < 90) & (drawn[..., 2] < 90)
    blues = (drawn[..., 2] > 110) & (drawn[..., 0] < 90)
    assert min(reds.sum(), blues.sum()) > 300, "the texture of the door is red and blue"
    assert opened.errors == []


def test_sliders_move_the_right_part_to_the_right_place(opened: Tab) -> None:
    asset = cabinet()
    agree(opened, 0, asset, {})
    for positions in ({"hinge": 1.9}, {"slide": 0.25}, {"turn": -1.0}, {"hinge": 0.4, "slide": 0.3, "turn": 2.0}):
        for joint in asset.joints:
            slide(opened, joint.name, positions.get(joint.name, 0.0))
        agree(opened, 0, asset, positions)
        assert opened.value("anymesh.positions(0)") == pytest.approx({j.name: positions.get(j.name, 0.0) for j in asset.joints})
    assert opened.errors == []


@pytest.mark.parametrize(
    ("make", "moved"),
    [
        (linkage, {"crank_joint": -0.5}),
        (doors, {"hinge": 1.2, "first": 0.1}),
        (jar, {"thread": 9.0}),
        (stick, {"socket": -0.4}),
    ],
)
def test_one_slider_moves_what_follows_and_screws_and_balls_move(tab: Tab, tmp_path, make, moved) -> None:
    asset = make()
    tab.open(write_report(folder_of(asset, tmp_path / "asset")).path)
    tab.until("anymesh.ready(0)")
    assert tab.page.locator("input[aria-label]:not([aria-label=explode])").count() == len(moved)
    for name, amount in moved.items():
        slide(tab, name, amount)
    agree(tab, 0, asset, together(asset, moved))
    assert tab.errors == []


def test_pixels_change_where_the_part_is_and_not_elsewhere(opened: Tab) -> None:
    opened.page.locator(".axes").uncheck()
    at = {name: opened.value(f"anymesh.onScreen(0, '{name}')") for name in ("door", "drawer", "base")}
    box = opened.page.locator(".stage canvas").bounding_box()
    rest = opened.pixels(".stage canvas")
    slide(opened, "slide", 0.3)
    opened.page.wait_for_timeout(150)
    moved = changed(rest, opened.pixels(".stage canvas"))
    column, row = (round(v - box[k]) for v, k in zip(at["drawer"], ("x", "y"), strict=True))
    assert moved.mean() > 0.01
    middle = np.argwhere(moved).mean(0)
    door = np.array([at["door"][1] - box["y"], at["door"][0] - box["x"]])
    assert np.linalg.norm(middle - (row, column)) < np.linalg.norm(middle - door)
    slide(opened, "slide", 0.0)
    opened.page.wait_for_timeout(150)
    assert not changed(rest, opened.pixels(".stage canvas")).any()


def test_all_play_and_one_plays_within_their_limits(opened: Tab) -> None:
    opened.page.locator(".all").click()
    seen = []
    for _ in range(12):
        opened.page.wait_for_timeout(120)
        seen.append(opened.value("anymesh.positions(0)"))
    opened.page.locator(".all").click()
    for joint in cabinet().joints:
        low, high = joint.limits or (-np.pi, np.pi)
        values = [s[joint.name] for s in seen]
        assert min(values) >= low - 1e-9
        assert max(values) <= high + 1e-9
        assert np.ptp(values) > 0.2 * (high - low)
    still = opened.value("anymesh.positions(0)")
    opened.page.wait_for_timeout(200)
    assert opened.value("anymesh.positions(0)") == still
    opened.page.locator(".rest").click()
    agree(opened, 0, cabinet(), {})
    opened.page.locator("li[data-joint='1'] .play").click()
    opened.page.wait_for_timeout(400)
    at = opened.value("anymesh.positions(0)")
    assert at["slide"] > 0
    assert at["hinge"] == at["turn"] == 0


def test_slanted_axes_three_levels_deep(tab: Tab, tmp_path) -> None:
    asset = slanted()
    tab.open(write_report(folder_of(asset, tmp_path / "slanted")).path)
    tab.until("anymesh.ready(0)")
    positions = {"a": 2.1, "b": -0.35, "c": -2.4}
    for name, amount in positions.items():
        slide(tab, name, amount)
    agree(tab, 0, asset, positions)
    assert tab.errors == []


def test_a_part_of_several_materials_is_one_link(tab: Tab, tmp_path) -> None:
    asset = cabinet()
    material = asset.mesh.face_material.copy()
    material[np.flatnonzero(asset.segmentation.face_part == 2)[::2]] = 2
    asset = replace(asset, mesh=replace(asset.mesh, face_material=material))
    tab.open(write_report(folder_of(asset, tmp_path / "cabinet")).path)
    tab.until("anymesh.ready(0)")
    slide(tab, "slide", 0.2)
    slide(tab, "turn", 1.0)
    agree(tab, 0, asset, {"slide": 0.2, "turn": 1.0})
    tab.page.mouse.click(*tab.value("anymesh.onScreen(0, 'knob')"))
    assert tab.value("anymesh.picked(0)") in ("knob", "drawer")
    assert tab.errors == []


def test_markup_in_names_does_no_harm(tab: Tab, tmp_path) -> None:
    folder = folder_of(
        replace(hostile(), exchanges=(asked(picture((9, 9, 200)), text="<img src=x>"),)), tmp_path / "<img src=x>"
    )
    record = (folder / "asset.json").read_text()
    renamed = json.loads(record)
    renamed["joints"][0]["name"] = "<script>window.hacked = 4</script>"
    (folder / "asset.json").write_text(json.dumps(renamed))
    tab.open(write_report(folder, tmp_path / "page.html").path)
    tab.until("anymesh.ready(0)")
    slide(tab, "slide", 0.2)
    tab.page.locator("details.asked summary").click()
    tab.until("[...document.querySelectorAll('details.asked img')].every((i) => i.naturalWidth > 0)")
    assert tab.value("window.hacked") is None
    assert "<script>window.hacked = 4</script>" in tab.page.locator("li[data-joint='0']").inner_text()
    assert tab.value("document.querySelectorAll('img:not([data-picture]):not(.preview)').length") == 0
    assert tab.errors == []


def test_a_notebook_frame_works_in_its_sandbox(tab: Tab, tmp_path) -> None:
    (tmp_path / "notebook.html").write_text(f"<!DOCTYPE html><body>{asset_html(cabinet())}</body>", encoding="utf-8")
    tab.open(tmp_path / "notebook.html")
    inner = tab.page.frames[1]
    for _ in range(200):
        if inner.evaluate("Boolean(window.anymesh && anymesh.ready(0))"):
            break
        tab.page.wait_for_timeout(50)
    inner.locator('input[aria-label="hinge"]').evaluate("(e) => { e.value = 1; e.dispatchEvent(new Event('input')) }")
    np.testing.assert_allclose(
        inner.evaluate("anymesh.transforms(0)")["door"], frames(cabinet(), {"hinge": 1.0})["door"], atol=1e-5
    )
    assert tab.errors == []
