"""The live page in a real browser: it loads, sliders move the right part, corrections reach the URDF, keys work.

    pytest -m slow tests/viewer/test_view_live.py

Needs the extra `view`, playwright and a Chromium (see browser.py); skipped where one is missing.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from assets import cabinet
from browser import Tab
from correctable import write_output
from live_page import NOW, PANEL, eventually, fill, frame_of, of_color, settle, show, tab_of

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
