"""The live page of the cabinet in a tab of a browser."""

import time

import numpy as np
import pytest
from browser import Tab
from correctable import write_output

from anymesh.viewer.scene import color_of

NOW = "2024-05-01T12:00:00+00:00"
PANEL = 880  # [px] where the panel begins


@pytest.fixture
def live(tmp_path, tab):
    """A page of the cabinet, open in a tab."""
    pytest.importorskip("viser", reason="needs the extra view")
    from anymesh.viewer.server_ import serve

    folder = write_output(tmp_path / "out")
    with serve(folder, port=8300, author="Ada", clock=lambda: NOW) as serving:
        show(tab, serving)
        yield serving, tab, folder


def show(tab: Tab, serving) -> None:
    tab.open(serving.url)
    tab.page.wait_for_selector("canvas")
    tab.page.get_by_text("parts,").first.wait_for()
    colored(serving)
    settle(tab)
    close = tab.page.locator(".mantine-Notification-closeButton")
    if close.count():
        close.first.click()


def colored(serving) -> None:
    """Show a colour per part, which tests tell apart, instead of the materials."""
    page = serving.page
    if page.session is not None and page.view.textured:
        page.play._textures.value = page.view.textured = False
        page.act(page.refresh)


def settle(tab: Tab, seconds: float = 40) -> np.ndarray:
    """The picture once it stands still."""
    end, before = time.monotonic() + seconds, tab.pixels()
    while time.monotonic() < end:
        time.sleep(0.7)
        now = tab.pixels()
        if (now[:, :PANEL] == before[:, :PANEL]).all() and len(np.unique(now[:, :PANEL].reshape(-1, 3), axis=0)) > 20:
            return now
        before = now
    raise AssertionError("the picture does not come to rest")


def eventually(what, seconds: float = 20):
    """Waits for what a click sets going."""
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.1)


def of_color(picture: np.ndarray, part: int) -> np.ndarray:
    """Where a picture has the hue of a part's colour."""
    r, g, b = (np.asarray(color_of(part), float) / max(color_of(part))).tolist()
    seen = picture[:, :PANEL].astype(float)
    scaled = seen / np.maximum(seen.max(2, keepdims=True), 1)
    return (np.abs(scaled - (r, g, b)).max(2) < 0.12) & (seen.max(2) > 60)


def fill(tab: Tab, label: str, value: str) -> None:
    """Types into the number of a control."""
    row = tab.page.locator(f"label:has-text('{label}')").locator("xpath=ancestor::*[descendant::input][1]")
    row.locator("input").last.fill(value)
    row.locator("input").last.press("Enter")


def frame_of(serving, part: str) -> np.ndarray:
    frame = serving.page.view._frames[part]
    w, x, y, z = frame.wxyz
    R = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    return np.block([[R, np.asarray(frame.position)[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]])


def tab_of(tab: Tab, name: str) -> None:
    tab.page.get_by_role("tab", name=name).click()
