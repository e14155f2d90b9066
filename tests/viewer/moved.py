"""Moving the joints of a page in a browser, and where the parts should be then."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from browser import Tab
from shown import folder_of

from anymesh.geometry.kinematics import link_transforms
from anymesh.viewer.report import write_report


@pytest.fixture(scope="session")
def cabinet_page(tmp_path_factory) -> Path:
    """The report of the cabinet."""
    return write_report(folder_of(cabinet(), tmp_path_factory.mktemp("results") / "cabinet")).path


@pytest.fixture
def opened(tab: Tab, cabinet_page: Path) -> Iterator[Tab]:
    """A tab that shows it in 3D."""
    tab.open(cabinet_page)
    tab.until("anymesh.ready(0)")
    yield tab
    assert tab.errors == []


def slide(tab: Tab, joint: str, amount: float) -> None:
    """Moves a slider as a person's drag does, by its event."""
    tab.page.locator(f'input[aria-label="{joint}"]').first.evaluate(
        "(e, v) => { e.value = v; e.dispatchEvent(new Event('input', { bubbles: true })) }", amount
    )


def frames(asset, positions) -> dict[str, np.ndarray]:
    """Where the link frames should be: moved as the parts are, from their joints' origins."""
    origin = {j.child: j.origin for j in asset.joints}
    found = {}
    for name, T in link_transforms(asset, positions).items():
        rest = np.eye(4)
        rest[:3, 3] = origin.get(name, np.zeros(3))
        found[name] = T @ rest
    return found


def agree(tab: Tab, number: int, asset, positions) -> None:
    told, true = tab.value(f"anymesh.transforms({number})"), frames(asset, positions)
    assert set(told) == set(true)
    for name, T in true.items():
        np.testing.assert_allclose(told[name], T, atol=1e-5, err_msg=name)


def changed(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    return np.abs(before.astype(int) - after).max(-1) > 24
