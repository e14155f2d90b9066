"""Test corrections on the live page in a real browser: preview, snapping, selection of faces, and dragging.

    pytest -m slow tests/viewer/test_view_live_corrections.py

Requirements as in test_view_live.py.
"""

import json
import time
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from live_page import PANEL, eventually, fill, frame_of, of_color, settle, tab_of
from scipy.ndimage import minimum_filter

pytest.importorskip("viser", reason="needs the extra view")


pytestmark = pytest.mark.slow
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


def test_motions_are_previewed_and_one_is_used(live):
    serving, tab, _ = live
    session = serving.page.session
    tab_of(tab, "Correct")
    serving.page.act(lambda: serving.page.select("door"))
    tab.page.get_by_role("button", name="Find other motions").click()
    eventually(lambda: session.preview is not None, 60)
    assert not session.unsaved
    places = []
    eventually(lambda: places.append(frame_of(serving, "door")) or np.ptp([p[0, 0] for p in places]) > 0.1)
    tab.page.keyboard.press("Escape")
    eventually(lambda: session.preview is None)
    tab.page.get_by_role("button", name="Find other motions").click()
    eventually(lambda: session.preview is not None, 60)
    wanted = session.preview
    tab.page.get_by_role("button", name="Use this motion").click()
    eventually(lambda: session.unsaved)
    np.testing.assert_allclose(session.asset.joints[0].axis, wanted.axis)


def test_the_axis_snaps_to_an_edge_that_is_clicked(live):
    serving, tab, _ = live
    session = serving.page.session
    tab_of(tab, "Correct")
    serving.page.act(lambda: serving.page.select("door"))
    tab.page.get_by_text("Axis", exact=True).click()
    tab.page.get_by_text("Edge", exact=True).click()
    eventually(lambda: "Click near an edge" in tab.page.inner_text("body"))
    where = np.argwhere(of_color(settle(tab), 1))
    y, x = where[where[:, 1] < where[:, 1].min() + 8].mean(0)  # the door's left edge
    tab.page.mouse.click(x + 2, y)
    eventually(lambda: session.unsaved)
    hinge = session.asset.joints[0]
    np.testing.assert_allclose(np.abs(hinge.axis), (0, 0, 1), atol=1e-6)
    assert hinge.origin[0] == pytest.approx(0.005, abs=1e-6)


def test_faces_are_chosen_by_brush_and_patch_and_made_a_part(live):
    serving, tab, _ = live
    session = serving.page.session
    tab_of(tab, "Correct")
    y, x = np.argwhere(of_color(tab.pixels(), 1)).mean(0)
    tab.page.mouse.click(x, y)
    eventually(lambda: session.selected == "door")
    tab.page.get_by_text("Faces", exact=True).click()
    tab.page.get_by_text("Brush", exact=True).click()
    eventually(lambda: "Hold Shift" in tab.page.inner_text("body"))
    tab.page.keyboard.down("Shift")
    tab.page.mouse.move(x - 40, y - 40)
    tab.page.mouse.down()
    tab.page.mouse.move(x + 40, y + 40, steps=6)
    tab.page.mouse.up()
    tab.page.keyboard.up("Shift")
    eventually(lambda: len(session.chosen) > 0)
    assert set(session.asset.segmentation.face_part[session.chosen]) == {1}
    assert (session.asset.mesh.face_normals[session.chosen][:, 1] < -0.99).all()  # what is seen: the front
    tab.page.keyboard.press("Escape")
    eventually(lambda: len(session.chosen) == 0)
    tab.page.get_by_text("Patch", exact=True).click()
    eventually(lambda: "Click patches" in tab.page.inner_text("body"))
    tab.page.mouse.click(x, y)
    eventually(lambda: len(session.chosen) == 2)
    tab.page.get_by_role("button", name="Make them a part").click()
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
    tab.page.get_by_text("Axis", exact=True).click()
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
