"""Interaction with the report page in a real browser. Slow; docs/report.md has the command."""

import numpy as np
import pytest
from assets import cabinet
from browser import Tab
from moved import agree, changed, frames, slide
from shown import folder_of

from anymesh.viewer.report import write_report

pytestmark = pytest.mark.slow
STAGE = "section[data-entry] .stage"


def test_sliders_obey_the_keyboard_and_stay_within_the_limits(opened: Tab) -> None:
    slider = opened.page.locator('input[aria-label="hinge"]')
    slider.focus()
    opened.page.keyboard.press("End")
    assert opened.value("anymesh.positions(0).hinge") == pytest.approx(1.9)
    opened.page.keyboard.press("ArrowRight")
    assert opened.value("anymesh.positions(0).hinge") == pytest.approx(1.9)
    opened.page.keyboard.press("Home")
    opened.page.keyboard.press("ArrowRight")
    assert 0 < opened.value("anymesh.positions(0).hinge") < 0.2
    assert "109°" not in opened.page.locator("li[data-joint='0'] output").inner_text()


def test_a_click_selects_the_part_and_escape_leaves(opened: Tab) -> None:
    opened.page.mouse.click(*opened.value("anymesh.onScreen(0, 'door')"))
    assert opened.value("anymesh.picked(0)") == "door"
    assert "hinge" in opened.page.locator("li.picked").inner_text()
    opened.page.keyboard.press("Escape")
    assert opened.value("anymesh.picked(0)") is None
    assert opened.page.locator("li.picked").count() == 0


def test_the_view_turns_zooms_explodes_and_comes_back(opened: Tab) -> None:
    canvas = opened.page.locator(".stage canvas")
    box = canvas.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    first = opened.pixels(".stage canvas")
    opened.page.mouse.move(x, y)
    opened.page.mouse.down()
    opened.page.mouse.move(x + 120, y + 30, steps=4)
    opened.page.mouse.up()
    opened.page.mouse.wheel(0, -300)
    opened.page.mouse.move(5, 5)
    opened.page.wait_for_timeout(200)
    assert changed(first, opened.pixels(".stage canvas")).mean() > 0.05
    opened.page.locator(".home").click()
    opened.page.keyboard.press("Escape")
    opened.page.mouse.move(5, 5)
    opened.page.wait_for_timeout(200)
    assert changed(first, opened.pixels(".stage canvas")).mean() < 0.002
    opened.page.locator(".apart").evaluate("(e) => { e.value = 1; e.dispatchEvent(new Event('input')) }")
    told = {name: np.array(T)[:3, 3] for name, T in opened.value("anymesh.transforms(0)").items()}
    rest = {name: T[:3, 3] for name, T in frames(cabinet(), {}).items()}
    assert (told["drawer"] - rest["drawer"]) @ [0, -1, 0] > 0.3
    assert not (told["base"] - rest["base"]).any()
    assert opened.errors == []


def test_many_views_are_made_when_looked_at_and_few_are_kept(tab: Tab, tmp_path) -> None:
    for k in range(7):
        folder_of(cabinet(name=f"cabinet{k}"), tmp_path / "many" / f"cabinet{k}")
    tab.open(write_report(tmp_path / "many").path)
    tab.page.wait_for_timeout(300)
    assert tab.value("[...Array(7).keys()].filter(anymesh.ready).length") <= 2
    slide(tab, "hinge", 1.0)
    for k in range(7):
        tab.page.locator(f"#a{k} .stage").scroll_into_view_if_needed()
        tab.until(f"anymesh.ready({k})")
    assert tab.value("[...Array(7).keys()].filter(anymesh.ready).length") <= 4
    assert not tab.value("anymesh.ready(0)")
    tab.page.locator("#a0 .stage").scroll_into_view_if_needed()
    tab.until("anymesh.ready(0)")
    agree(tab, 0, cabinet(), {"hinge": 1.0})
    assert tab.errors == []


def test_the_wheel_scrolls_a_page_of_many_until_a_view_was_clicked(tab: Tab, tmp_path) -> None:
    for k in range(2):
        folder_of(cabinet(name=f"cabinet{k}"), tmp_path / "many" / f"cabinet{k}")
    tab.open(write_report(tmp_path / "many").path)
    tab.until("anymesh.ready(0)")
    box = tab.page.locator(STAGE).first.bounding_box()
    assert box is not None
    tab.page.mouse.move(box["x"] + 20, box["y"] + 40)
    tab.page.mouse.wheel(0, 60)
    tab.page.wait_for_timeout(300)
    assert tab.value("window.scrollY") > 0
    box = tab.page.locator(STAGE).first.bounding_box()
    assert box is not None
    tab.page.mouse.click(box["x"] + 20, box["y"] + 40)
    before = tab.value("window.scrollY")
    tab.page.mouse.wheel(0, 60)
    tab.page.wait_for_timeout(300)
    assert tab.value("window.scrollY") == before


def test_a_small_screen_shows_it_all_without_scrolling_sideways(tab: Tab, cabinet_page) -> None:
    for width, height in ((1280, 720), (1024, 600), (420, 800)):
        tab.page.set_viewport_size({"width": width, "height": height})
        tab.open(cabinet_page)
        tab.until("anymesh.ready(0)")
        assert tab.value("document.documentElement.scrollWidth") <= width
    tab.page.set_viewport_size({"width": 1280, "height": 720})
    tab.page.wait_for_timeout(200)
    bottom = tab.value("document.querySelector('.panel').getBoundingClientRect().bottom")
    assert bottom <= 720, "the view and its sliders are on a laptop's first screen"
