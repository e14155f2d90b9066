"""Whether a page in a browser is in order, and its pictures at two widths, for people to look at.

The pictures are written to $ANYMESH_SCREENSHOTS, by default out/pages.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from browser import Tab

WINDOWS = ((1280, 720), (1920, 1080))
FOLDER = Path(os.environ.get("ANYMESH_SCREENSHOTS", Path(__file__).parents[2] / "out" / "pages"))
# Returns what is wrong, in words: what is cut at a side, what is wider than its box, controls that overlap, covered sliders.
FAULTS = """() => {
  const faults = [], said = (e) => (e.innerText || e.getAttribute('aria-label') || e.value || e.tagName).trim().slice(0, 40);
  const shown = (e) => { const r = e.getBoundingClientRect(), s = getComputedStyle(e);
    return r.width > 1 && r.height > 1 && s.visibility !== 'hidden' && s.display !== 'none'; };
  const all = (q) => [...document.querySelectorAll(q)].filter(shown);
  const box = (e) => e.getBoundingClientRect();
  if (document.documentElement.scrollWidth > innerWidth) faults.push('the page scrolls sideways');
  const controls = all('button, input, label, select, textarea, [role=status], [role=tab], .mantine-Slider-root, '
    + '.anymesh-title > div, .anymesh-drop, .anymesh-welcome > div').filter((e) => !e.closest('[role=alert]'));
  for (const e of controls) {
    const r = box(e);
    if (r.left < -1 || r.right > innerWidth + 1) faults.push(`cut at the side: ${said(e)}`);
    if (e.matches('button, label, [role=tab]') && e.scrollWidth > e.clientWidth + 1 && e.clientWidth)
      faults.push(`wider than its box: ${said(e)}`);
  }
  for (const e of all('.anymesh-welcome > div, .anymesh-title'))
    if (box(e).top < 0 || box(e).bottom > innerHeight + 1) faults.push(`cut above or below: ${said(e)}`);
  const apart = all('button, input:not([type=range]), .mantine-Slider-root, .anymesh-drop, .anymesh-title > div')
    .filter((e) => !e.closest('[role=alert]') && !e.closest('.mantine-Notifications-root'));
  for (let i = 0; i < apart.length; i++) for (let k = i + 1; k < apart.length; k++) {
    const a = apart[i], b = apart[k], p = box(a), q = box(b);
    const field = a.closest('.mantine-Input-wrapper');  // a number and its arrows
    if (a.contains(b) || b.contains(a) || (field && field === b.closest('.mantine-Input-wrapper'))) continue;
    const x = Math.min(p.right, q.right) - Math.max(p.left, q.left), y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (x > 2 && y > 2) faults.push(`${said(a)} overlaps ${said(b)}`);
  }
  for (const e of all('.mantine-Slider-root, input[type=range]')) {
    const r = box(e), x = r.left + r.width / 2, y = r.top + r.height / 2;
    if (y < 0 || y > innerHeight) continue;
    const top = document.elementFromPoint(x, y);
    if (!top || !(e.contains(top) || top.contains(e))) faults.push(`a slider is covered by ${top ? said(top) : 'nothing'}`);
  }
  return faults;
}"""
DRAWN = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200))))"


def look(tab: Tab, name: str, *, colors: int = 50) -> None:
    """Write pictures of a page at both widths, and assert that it is in order. colors: minimum number left of the panel."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for width, height in WINDOWS:
        tab.page.set_viewport_size({"width": width, "height": height})
        tab.page.evaluate(DRAWN)
        picture = tab.pixels(path=FOLDER / f"{name}_{width}.png")
        scene = picture[:, : width - 400].reshape(-1, 3)
        assert len(np.unique(scene, axis=0)) > colors, f"{name} is blank at {width} pixels"
        assert tab.page.evaluate(FAULTS) == [], f"{name} at {width} pixels, see {FOLDER}"
    assert tab.errors == []


def close_notices(tab: Tab) -> None:
    """Close the notices of the library in the corner, such as that about drawing without a GPU."""
    for button in tab.page.locator(".mantine-Notification-closeButton").all():
        button.click()
