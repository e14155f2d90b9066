"""The tab "Play" of the live page: a slider per joint, and display options."""

from __future__ import annotations

from typing import Any

import numpy as np

from anymesh.types import Joint, JointType
from anymesh.viewer.live import Session
from anymesh.viewer.panels import joint_table, scale_of
from anymesh.viewer.panels_page import Page

STEPS = 200  # steps of a slider from limit to limit


class PlayPanel:
    """Controls for motion. Sliders are rebuilt only when joints change, so that a dragged slider persists."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        self._made: list[tuple[Any, ...]] | None = None
        self._sliders: dict[str, Any] = {}
        with tab:
            self._all = gui.add_checkbox("Play all", False, hint="Space")
            self._all.on_update(_by_hand(lambda: page.act(lambda: page.play_joint("" if self._all.value else None))))
            self._rest = gui.add_button("All to rest", color="gray")
            self._rest.on_click(lambda _: page.act(self._to_rest))
            self._joints = gui.add_folder("Joints")
            with gui.add_folder("Shown"):
                self._explode = gui.add_slider("Exploded", 0.0, 1.0, 0.01, 0.0)
                self._textures = gui.add_checkbox("Textures", False)
                self._axes = gui.add_checkbox("Axes and limits", True)
                self._collision = gui.add_checkbox("Collision shapes", False)
                self._inertia = gui.add_checkbox("Inertia", False, hint="Boxes of even density with the mass and moments")
            self._explode.on_update(_by_hand(lambda: page.act(self._set_explode)))
            for box in (self._textures, self._axes, self._collision, self._inertia):
                box.on_update(_by_hand(lambda: page.act(self._set_shown)))
            with gui.add_folder("Why"):
                self._why = gui.add_html("")

    def refresh(self, session: Session) -> None:
        """Update the sliders for the joints of the displayed asset."""
        asset = session.shown
        made = [(j.name, j.child, j.type, j.limits) for j in asset.joints]
        if made != self._made:
            self._made = made
            for slider in self._sliders.values():
                slider.remove()
            with self._joints:
                self._sliders = {j.name: self._slider(session, j) for j in asset.joints if j.type is not JointType.FIXED}
        self._why.content = joint_table(asset)

    def tell_playing(self, playing: bool) -> None:
        """Update the checkbox after all joints were started or stopped elsewhere (by a key)."""
        if self._all.value != playing:
            self._all.value = playing

    def _slider(self, session: Session, joint: Joint) -> Any:
        scale, unit = scale_of(joint)
        low, high = (scale * v for v in (joint.limits or (-np.pi, np.pi)))
        at = float(np.clip(scale * session.positions.get(joint.name, 0.0), low, high))
        slider = self._page.gui.add_slider(
            f"{joint.child} {unit}", min=round(low, 2), max=round(high, 2), step=round((high - low) / STEPS, 4) or 1e-3,
            initial_value=round(at, 2), hint=f"{joint.name}, confidence {joint.confidence:.2f}: {joint.reason}",
        )  # fmt: skip

        def moved() -> None:
            session.positions[joint.name] = float(np.clip(slider.value, low, high)) / scale
            self._page.play_joint(None)

        slider.on_update(_by_hand(lambda: self._page.act(moved)))
        return slider

    def _to_rest(self) -> None:
        session = self._page.session
        if session is not None:
            session.positions = {}
            for slider in self._sliders.values():
                slider.value = 0.0
            self._page.play_joint(None)

    def _set_explode(self) -> None:
        session = self._page.session
        if session is not None:
            session.explode = self._explode.value
            self._page.view.pose(session.positions, session.explode)

    def _set_shown(self) -> None:
        view = self._page.view
        view.textured, view.axes = self._textures.value, self._axes.value
        view.collision, view.inertia = self._collision.value, self._inertia.value
        self._page.refresh()


def _by_hand(what: Any) -> Any:
    """Wrap a callback to ignore changes made by the program."""
    return lambda event: what() if event.client is not None else None
