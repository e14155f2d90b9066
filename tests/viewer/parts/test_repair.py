"""Drawer fronts that were found wrong are mended on the page in a real browser, in at most five clicks.

pytest -m slow tests/viewer/parts/test_repair.py
"""

from dataclasses import dataclass

import numpy as np
import pytest
from browser import Tab
from chest import TOP, chest
from correctable import write_output
from live_page import NOW, eventually

from anymesh.correcting import open_asset
from anymesh.types import JointType

pytest.importorskip("viser", reason="needs the extra view")
from anymesh.viewer.server_ import serve

pytestmark = pytest.mark.slow
MOST_CLICKS = 5


@dataclass
class Hand:
    """A person at the page, whose clicks and keys are counted."""

    tab: Tab
    clicks: int = 0

    def on(self, x: float, y: float) -> None:
        self.clicks += 1
        self.tab.page.mouse.click(x, y)

    def button(self, name: str) -> None:
        self.tab.page.get_by_role("button", name=name).wait_for()
        self.clicks += 1
        self.tab.page.get_by_role("button", name=name).click()

    def key(self, key: str) -> None:
        self.clicks += 1
        self.tab.page.keyboard.press(key)


@pytest.fixture
def opened(request, tmp_path, tab):
    """The page of a chest, and a hand at it."""
    folder = write_output(tmp_path / "out", asset=request.param)
    with serve(folder, port=8380, author="Ada", clock=lambda: NOW) as serving:
        tab.page.set_default_timeout(90_000)  # [ms] drawing in software is slow
        tab.open(serving.url)
        tab.page.get_by_text("New part:").wait_for()
        first = serving.page.server.initial_camera.position
        eventually(
            lambda: [np.allclose(c.camera.position, first) for c in serving.page.server.get_clients().values()] == [True]
        )
        yield serving, Hand(tab), folder
        assert tab.errors == []


def top_front(serving, tab: Tab) -> tuple[float, float]:
    """Where the window shows the front of the top drawer, beside its handle."""
    from anymesh.viewer.scene_ import camera_of

    (client,) = serving.page.server.get_clients().values()
    camera = camera_of(client.camera)
    (pixel,), _ = camera.project(np.array([[0.22, -0.26, 0.68]]))
    box = tab.page.locator("canvas").first.bounding_box()
    return box["x"] + pixel[0] / camera.width * box["width"], box["y"] + pixel[1] / camera.height * box["height"]


def slides_out(joint) -> bool:
    return joint.type is JointType.PRISMATIC and joint.axis[1] < -0.99


@pytest.mark.parametrize("opened", [chest(TOP, sideways=True)], indirect=True)
def test_a_front_that_slides_sideways_is_mended(opened):
    serving, hand, folder = opened
    session = serving.page.session
    hand.on(*top_front(serving, hand.tab))
    eventually(lambda: session.selected == "drawer")
    hand.tab.page.locator(".am .grid img").first.wait_for()
    hand.button("slides out, to the front")
    eventually(lambda: session.preview is not None)
    hand.key("Enter")
    eventually(lambda: session.unsaved)
    hand.key("Control+s")
    hand.tab.page.get_by_text("Saved at").wait_for()
    assert hand.clicks <= MOST_CLICKS
    asset = open_asset(folder).history.asset
    assert [slides_out(j) for j in asset.joints] == [True]


@pytest.mark.parametrize("opened", [chest()], indirect=True)
def test_fronts_that_are_no_parts_are_made_parts_with_their_motions(opened):
    serving, hand, folder = opened
    session = serving.page.session
    hand.on(*top_front(serving, hand.tab))
    eventually(lambda: session.selected == "base")
    hand.button("Piece")
    eventually(lambda: len(session.chosen) == 24)  # with its handle
    hand.button("Make it a part")
    eventually(lambda: len(session.asset.joints) == 1 and slides_out(session.asset.joints[0]), 60)
    hand.button("The same for its 2 copies")
    eventually(lambda: len(session.asset.joints) == 3)
    hand.button("Save")
    hand.tab.page.get_by_text("Saved at").wait_for()
    assert hand.clicks <= MOST_CLICKS
    asset = open_asset(folder).history.asset
    assert [slides_out(j) for j in asset.joints] == [True] * 3
    assert [len(asset.segmentation.faces(k)) for k in range(4)] == [12, 24, 24, 24]


@pytest.mark.parametrize("opened", [chest(TOP)], indirect=True)
def test_a_joint_is_confirmed_and_a_part_is_none(opened):
    serving, hand, _ = opened
    session = serving.page.session
    hand.on(*top_front(serving, hand.tab))
    hand.button("This joint is right")
    eventually(lambda: session.asset.joints[0].confidence == 1)
    hand.tab.page.get_by_text("confirmed by hand").first.wait_for()
    hand.button("Not a part")
    eventually(lambda: len(session.asset.joints) == 0)
    hand.key("Control+z")
    eventually(lambda: len(session.asset.joints) == 1)
