"""The live page in a real browser: it loads, sliders move the right part, corrections reach the URDF, keys work.

    pytest -m slow tests/viewer/test_live.py

Needs the extra `view`, playwright and a Chromium (see browser.py); skipped where one is missing.
"""

import json
import time
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet
from browser import Tab
from correctable import write_output
from live_page import NOW, PANEL, eventually, fill, frame_of, of_color, settle, show, tab_of
from scipy.ndimage import minimum_filter

from anymesh.correcting import FlipSign, open_asset
from anymesh.geometry.kinematics import link_transforms
from anymesh.viewer.server_ import serve

pytest.importorskip("viser", reason="needs the extra view")


pytestmark = pytest.mark.slow


def test_the_page_loads_without_errors_and_warns_first(live):
    _, tab, _ = live
    text = tab.page.inner_text("body")
    assert text.index("low confidence") < text.index("Play all")
    picture = tab.pixels()
    for part in (1, 2, 3):
        assert of_color(picture, part).sum() > 100
    assert tab.errors == []


def test_a_slider_moves_its_part_and_no_other(live):
    serving, tab, _ = live
    before = settle(tab)
    fill(tab, "door °", "100")
    session = serving.page.session
    eventually(lambda: session.positions.get("hinge", 0) > 1)
    after = settle(tab)
    expected = link_transforms(session.asset, {"hinge": np.deg2rad(100)})
    for name in ("base", "door", "drawer", "knob"):
        np.testing.assert_allclose(frame_of(serving, name), expected[name], atol=2e-3)
    door = [np.argwhere(of_color(p, 1)).mean(0) for p in (before, after)]
    assert np.linalg.norm(door[1] - door[0]) > 30
    drawer = [of_color(p, 2) for p in (before, after)]
    assert (drawer[0] & drawer[1]).sum() > 0.9 * drawer[0].sum()
    fill(tab, "drawer cm", "20")
    eventually(lambda: session.positions.get("slide", 0) > 0.1)
    np.testing.assert_allclose(frame_of(serving, "knob")[:3, 3], (0, -0.2, 0), atol=2e-3)
    assert tab.errors == []


def test_a_click_selects_escape_lets_go_orbit_and_zoom_turn_the_view(live):
    serving, tab, _ = live
    session = serving.page.session
    y, x = np.argwhere(of_color(tab.pixels(), 1)).mean(0)
    tab.page.mouse.click(x, y)
    eventually(lambda: session.selected == "door")
    tab.page.keyboard.press("Escape")
    eventually(lambda: session.selected is None)
    (client,) = serving.page.server.get_clients().values()
    eye, off = np.array(client.camera.position), np.linalg.norm(client.camera.position - client.camera.look_at)
    tab.page.mouse.move(300, 300)
    tab.page.mouse.down()
    tab.page.mouse.move(420, 340, steps=5)
    tab.page.mouse.up()
    eventually(lambda: np.linalg.norm(client.camera.position - eye) > 0.1)
    assert np.linalg.norm(client.camera.position - client.camera.look_at) == pytest.approx(off, rel=0.02)
    assert session.selected is None  # a drag is no click
    tab.page.mouse.wheel(0, -400)
    eventually(lambda: np.linalg.norm(client.camera.position - client.camera.look_at) < 0.97 * off)


def test_names_of_a_file_do_no_harm(tmp_path, tab):
    bad = "<img src=x onerror=alert(1)>"
    asset = cabinet(names=(bad, "do/or**", "dräwer ", "knob"))
    asset = replace(asset, joints=tuple(replace(j, reason=f"</div><script>alert(2)</script>{bad}") for j in asset.joints))
    folder = write_output(tmp_path / "out", asset=asset)
    dialogs = []
    tab.page.on("dialog", lambda d: (dialogs.append(d.message), d.dismiss()))
    with serve(folder, port=8320, author=bad, clock=lambda: NOW) as serving:
        show(tab, serving)
        serving.page.act(lambda: serving.page.select(bad))
        tab_of(tab, "Correct")
        eventually(lambda: bad in tab.page.inner_text("body"))
        serving.page.act(lambda: serving.page.show_message(bad))
        settle(tab)
    assert dialogs == []
    assert [e for e in tab.errors if "WebSocket" not in e] == []


def test_two_tabs_see_the_same_and_two_servers_do_not_overwrite(live, chromium):
    serving, tab, folder = live
    context = chromium.new_context(viewport={"width": 1280, "height": 720})
    other = Tab(context.new_page())
    show(other, serving)
    fill(other, "door °", "60")
    eventually(lambda: serving.page.session.positions.get("hinge", 0) > 1)
    assert np.abs(settle(tab)[:, :PANEL].astype(int) - settle(other)[:, :PANEL]).mean() < 3
    context.close()
    with serve(folder, port=8340, author="Bob", clock=lambda: NOW) as second:
        for page in (second.page, serving.page):
            page.act(lambda page=page: page.select("door"))
            tab_of(tab, "Correct")
        second.page.act(lambda: second.page.correct(FlipSign("door")))
        second.page.act(second.page.save)
        tab.page.get_by_role("button", name="Flip direction").click()
        eventually(lambda: serving.page.session.unsaved)
        kept = (folder / "cabinet.urdf").read_bytes()
        tab.page.get_by_role("button", name="Save").click()
        tab.page.get_by_text("saved by someone else").first.wait_for()
        assert (folder / "cabinet.urdf").read_bytes() == kept
    assert [e.author for e in open_asset(folder).history.done] == ["Bob"]


def test_a_folder_is_reviewed_by_keys(tmp_path, tab):
    for name, low in (("first", 0.2), ("second", 0.5), ("third", 0.8)):
        asset = cabinet(name=name)
        joints = tuple(replace(j, confidence=low) for j in asset.joints)
        write_output(tmp_path / "many" / name, asset=replace(asset, joints=joints))
    (tmp_path / "many" / "in" / "mesh.glb").unlink()
    with serve(tmp_path / "many", port=8360, author="Ada", clock=lambda: NOW) as serving:
        show_moving(tab, serving)
        session = serving.page.session
        assert session.folder.name == "first"
        places = []
        eventually(lambda: places.append(frame_of(serving, "door")) or np.ptp([p[0, 0] for p in places]) > 0.1)
        for key, verdict, then in (("a", "accepted", "second"), ("r", "rejected", "third"), ("c", "to correct", "third")):
            at = serving.page.session.folder.name
            tab.page.keyboard.press(key)
            eventually(lambda at=at, verdict=verdict: said(tmp_path / "many").get(at) == verdict)
            eventually(lambda then=then: serving.page.session.folder.name == then)
        eventually(lambda: "3 of 3 decided" in tab.page.inner_text("body"))
        assert tab.errors == []


def show_moving(tab: Tab, serving) -> None:
    tab.open(serving.url)
    tab.page.wait_for_selector("canvas")
    tab.page.get_by_text("of 3 decided").first.wait_for()


def said(folder) -> dict[str, str]:
    path = folder / "review.json"
    return {k: d[-1]["verdict"] for k, d in json.loads(path.read_text())["decisions"].items()} if path.exists() else {}


GIZMO_BLUE = (54, 142, 226)


def urdf_joint(folder, name: str) -> ET.Element:
    return next(j for j in ET.parse(folder / "cabinet.urdf").getroot().iter("joint") if j.get("name") == name)


def test_corrections_undo_redo_and_reach_the_urdf(live):
    serving, tab, folder = live
    session = serving.page.session
    tab_of(tab, "Correct")
    y, x = np.argwhere(of_color(tab.pixels(), 1)).mean(0)
    tab.page.mouse.click(x, y)
    eventually(lambda: session.selected == "door")
    tab.page.get_by_role("button", name="Flip direction").click()
    eventually(lambda: session.asset.joints[0].axis[2] == -1)
    tab.page.mouse.click(700, 40)  # the background
    eventually(lambda: session.selected is None)
    tab.page.keyboard.press("Control+z")
    eventually(lambda: session.asset.joints[0].axis[2] == 1)
    tab.page.keyboard.press("Control+Shift+Z")
    eventually(lambda: session.asset.joints[0].axis[2] == -1)
    eventually(lambda: "1 correction not saved" in tab.page.inner_text("body"))
    tab.page.keyboard.press("Control+s")
    eventually(lambda: not session.unsaved, 60)
    assert urdf_joint(folder, "hinge").find("axis").get("xyz").split()[2] == "-1"
    assert json.loads((folder / "corrections.json").read_text())["corrections"][0]["author"] == "Ada"
    assert tab.errors == []


def test_motions_are_shown_with_arrow_keys_and_enter_takes_one(live):
    serving, tab, _ = live
    session = serving.page.session
    serving.page.act(lambda: serving.page.select("door"))
    tab.page.locator(".am .grid img").first.wait_for()
    tab.page.keyboard.press("ArrowRight")
    eventually(lambda: session.preview is not None)
    assert not session.unsaved
    places = []
    eventually(lambda: places.append(frame_of(serving, "door")) or np.ptp([p[0, 0] for p in places]) > 0.1)
    tab.page.keyboard.press("Escape")
    eventually(lambda: session.preview is None)
    tab.page.locator(".am .grid button").nth(1).click()
    eventually(lambda: session.preview is not None)
    first = session.preview
    tab.page.keyboard.press("ArrowRight")
    eventually(lambda: session.preview != first)
    wanted = session.preview
    tab.page.keyboard.press("Enter")
    eventually(lambda: session.unsaved)
    np.testing.assert_allclose(session.asset.joints[0].axis, wanted.axis)
    assert len(session.history.done) == 1
    assert tab.errors == []


def test_the_axis_snaps_to_an_edge_that_is_clicked(live):
    serving, tab, _ = live
    session = serving.page.session
    tab_of(tab, "Correct")
    serving.page.act(lambda: serving.page.select("door"))
    tab.page.get_by_text("Edge", exact=True).click()
    eventually(lambda: "Click near an edge" in tab.page.inner_text("body"))
    where = np.argwhere(of_color(settle(tab), 1))
    y, x = where[where[:, 1] < where[:, 1].min() + 8].mean(0)  # the door's left edge
    tab.page.mouse.click(x + 2, y)
    eventually(lambda: session.unsaved)
    hinge = session.asset.joints[0]
    np.testing.assert_allclose(np.abs(hinge.axis), (0, 0, 1), atol=1e-6)
    assert hinge.origin[0] == pytest.approx(0.005, abs=1e-6)


def test_faces_are_chosen_by_outline_and_click_and_made_a_part(live):
    serving, tab, _ = live
    session = serving.page.session
    y, x = np.argwhere(of_color(tab.pixels(), 1)).mean(0)
    tab.page.keyboard.press("l")
    tab.page.get_by_text("Draw around").wait_for()
    door = np.argwhere(of_color(settle(tab), 1))[:, ::-1]
    low, high = (door.min(0) - 9).tolist(), (door.max(0) + 9).tolist()
    tab.page.mouse.move(*low)
    tab.page.mouse.down()
    for corner in ((high[0], low[1]), high, (low[0], high[1]), low):
        tab.page.mouse.move(*corner, steps=6)
    tab.page.mouse.up()
    eventually(lambda: len(session.chosen) > 0)
    of, normals = session.asset.segmentation.face_part[session.chosen], session.asset.mesh.face_normals[session.chosen]
    assert 1 in of
    assert (normals[of == 1][:, 1] > 0.99).sum() == 0  # what is seen: not its back
    (client,) = serving.page.server.get_clients().values()
    assert np.linalg.norm(client.camera.position - client.camera.look_at) > 0  # a drag draws, it does not turn the view
    tab.page.keyboard.press("Escape")
    eventually(lambda: len(session.chosen) == 0)
    tab.page.get_by_text("Draw around").wait_for(state="hidden")
    tab.page.mouse.click(x, y)
    eventually(lambda: session.selected == "door")
    tab.page.get_by_role("button", name="Facet").click()
    eventually(lambda: len(session.chosen) == 2)
    tab.page.keyboard.down("Shift")
    tab.page.mouse.click(x, y)
    tab.page.keyboard.up("Shift")
    eventually(lambda: len(session.chosen) == 0)
    tab.page.keyboard.press("Backspace")
    eventually(lambda: len(session.chosen) == 2)
    tab.page.get_by_role("button", name="Make it a part").click()
    eventually(lambda: len(session.asset.segmentation.parts) == 5)
    assert tab.errors == []


def test_the_axis_is_dragged_and_limits_are_typed(live):
    serving, tab, _ = live
    session = serving.page.session
    tab_of(tab, "Correct")
    serving.page.act(lambda: serving.page.select("door"))
    fill(tab, "Upper °", "75")
    tab.page.get_by_role("button", name="Set limits").click()
    eventually(lambda: session.asset.joints[0].limits[1] == pytest.approx(np.deg2rad(75)))
    tab.page.get_by_label("Drag the axis").click()
    picture = settle(tab).astype(int)
    before = session.asset.joints[0].origin
    blue = np.abs(picture[:, :PANEL] - GIZMO_BLUE).max(2) < 12
    blue = minimum_filter(blue, 5)  # without thin lines
    y, x = np.argwhere(blue)[np.argwhere(blue)[:, 1].argmin()].astype(float)  # the tip of an arrow across the axis
    tab.page.mouse.move(x + 10, y + 2)
    time.sleep(1)
    tab.page.mouse.down()
    tab.page.mouse.move(x - 60, y - 15, steps=8)
    time.sleep(1)
    tab.page.mouse.up()
    eventually(lambda: len(session.history.done) == 2)
    assert np.linalg.norm(session.asset.joints[0].origin - before) > 0.02
    np.testing.assert_allclose(session.asset.joints[0].axis, (0, 0, 1), atol=1e-6)
    assert tab.errors == []
