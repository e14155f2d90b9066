"""The live page (viser): one asset, shared by every tab, with its controls and the tab "Play"."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.correcting import Correction
from anymesh.errors import AnymeshError
from anymesh.formats.packed import zip_bytes
from anymesh.mechanisms.following import followers
from anymesh.pipeline.results import JointVerdict, verdict
from anymesh.types import Asset, Joint, JointType
from anymesh.viewer.correct_ import CorrectionTools, CorrectPanel
from anymesh.viewer.intake.bench_ import Workbench, WorkbenchFolders
from anymesh.viewer.intake.welcome import contents, title
from anymesh.viewer.looks import has_looks
from anymesh.viewer.panels import SMALL, Page, badge, head, joint_table, scale_of
from anymesh.viewer.parts.panel_ import PartPanel
from anymesh.viewer.review_ import ReviewPanel
from anymesh.viewer.scene import read_grippers, shown_range, swayed
from anymesh.viewer.scene_ import SceneView
from anymesh.viewer.session import Clock, Session

STEPS = 200  # steps of a slider from limit to limit
SECONDS = 4.0  # duration of a play, there and back
TICK = 0.05  # [s] between poses
MESSAGE_SECONDS = 6.0  # [s] for which a message is shown


class PlayPanel:
    """Controls for motion. Sliders are rebuilt only when joints change, so that a dragged slider persists."""

    def __init__(self, page: Page, tab: Any) -> None:
        self._page, gui = page, page.gui
        self._made: list[tuple[Any, ...]] | None = None
        self._sliders: dict[str, Any] = {}
        self._doubts: list[Any] = []
        self._chosen = False  # whether a person has chosen between materials and colours of parts
        with tab:
            self._all = gui.add_checkbox("Play all", False, hint="Space")
            self._all.on_update(_by_hand(lambda: page.act(lambda: page.play_joint("" if self._all.value else None))))
            self._rest = gui.add_button("All to rest", color="gray")
            self._rest.on_click(lambda _: page.act(self._to_rest))
            self._joints = gui.add_folder("Joints")
            with gui.add_folder("Shown"):  # no hint above or below a slider: it would cover it
                self._textures = gui.add_checkbox("Textures", False)
                self._axes = gui.add_checkbox("Axes and limits", True)
                self._grippers = gui.add_checkbox("Grasps", False, hint="Cyan: the best; green: handles")
                self._collision = gui.add_checkbox("Collision shapes", False)
                self._inertia = gui.add_checkbox("Inertia", False, hint="Boxes of even density with the mass and moments")
                self._explode = gui.add_slider("Exploded", 0.0, 1.0, 0.01, 0.0)
            self._explode.on_update(_by_hand(lambda: page.act(self._set_explode)))
            for box in (self._textures, self._axes, self._grippers, self._collision, self._inertia):
                box.on_update(_by_hand(lambda: page.act(self._set_shown)))
            with gui.add_folder("Why", expand_by_default=False):
                self._why = gui.add_html("")

    def refresh(self, session: Session) -> None:
        """Update the sliders for the joints of the displayed asset."""
        asset = session.shown
        leading = [j for j in asset.joints if j.type is not JointType.FIXED and j.name not in followers(asset)]
        made = [(j, verdict(asset.segmentation, j, asset.warnings)) for j in leading]
        if [(j.name, j.child, j.type, j.limits, j.confidence, v) for j, v in made] != self._made:
            self._made = [(j.name, j.child, j.type, j.limits, j.confidence, v) for j, v in made]
            for control in (*self._sliders.values(), *self._doubts):
                control.remove()
            with self._joints:
                self._doubts = []
                self._sliders = {j.name: self._row(session, j, v) for j, v in made}
        self._why.content = joint_table(asset)

    def choose_looks(self, asset: Asset) -> None:
        """Show an object with its materials if they tell more than one colour, until a person has chosen."""
        if not self._chosen:
            self._textures.value = self._page.view.textured = has_looks(asset.mesh)

    def tell_playing(self, playing: bool) -> None:
        """Update the checkbox after all joints were started or stopped elsewhere (by a key)."""
        if self._all.value != playing:
            self._all.value = playing

    def _row(self, session: Session, joint: Joint, outcome: JointVerdict) -> Any:
        """Add the slider of a joint, below a line on why it is not sure."""
        if outcome.word != "sure":
            line = f"{badge(joint.confidence, outcome.word)} {escape(outcome.word)}: {escape(outcome.why)}"
            self._doubts.append(self._page.gui.add_html(f"<div {SMALL}>{line}</div>"))
        return self._slider(session, joint)

    def _slider(self, session: Session, joint: Joint) -> Any:
        scale, unit = scale_of(joint)
        low, high = (scale * v for v in shown_range(session.shown, joint))
        at = float(np.clip(scale * session.positions.get(joint.name, 0.0), low, high))
        slider = self._page.gui.add_slider(
            f"{joint.child} {unit}", min=round(low, 2), max=round(high, 2), step=round((high - low) / STEPS, 4) or 1e-3,
            initial_value=round(at, 2),
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
        self._chosen = self._chosen or view.textured != self._textures.value
        view.textured, view.axes = self._textures.value, self._axes.value
        view.collision, view.inertia = self._collision.value, self._inertia.value
        self.read_grippers()
        self._page.refresh()

    def read_grippers(self) -> None:
        """Show the handles and grasps that the folder has now."""
        session = self._page.session
        shown = session is not None and self._grippers.value
        self._page.view.grippers = read_grippers(session.folder, session.asset) if shown else ()


def saved_line(unsaved: int, saved: str) -> str:
    """Return HTML that says whether corrections are saved. unsaved: their number; saved: what the last save wrote."""
    if unsaved:
        return f'<div {SMALL}><b style="color:#b35c00">{unsaved} correction{"s" * (unsaved != 1)} not saved</b> (Ctrl-S)</div>'
    return f'<div {SMALL}><span style="color:#2b8a3e">✓ {escape(saved)}</span></div>' if saved else ""


def _by_hand(what: Any) -> Any:
    """Wrap a callback to ignore changes made by the program."""
    return lambda event: what() if event.client is not None else None


class LivePage:
    """State and controls of one page. Callbacks of the server come from many threads; `act` serializes them.

    review: folder of outputs to review, None for a page of one asset; bench: settings of the workbench, for a page that accepts
    meshes.
    """

    def __init__(
        self, server: Any, *, author: str, clock: Clock, review: Path | None = None, bench: WorkbenchFolders | None = None
    ) -> None:
        self.server, self.gui = server, server.gui
        self._author, self._clock = author, clock
        self._lock, self._ended = threading.RLock(), threading.Event()
        self.view = SceneView(server)
        self.session: Session | None = None
        self.playing: str | None = None  # a joint's name, "" for all, None for a static pose
        self._began = 0.0
        self.gui.main_panel.dock_right()
        self.gui.main_panel.set_width(390)
        self._title = self.gui.add_html("")
        self._head = self.gui.add_html("")
        self.bench = None if bench is None else Workbench(self, bench)
        self._buttons = self.gui.add_button_group("Edits", ("Undo", "Redo", "Save"))
        self._buttons.on_click(
            lambda event: self.act({"Undo": self.undo, "Redo": self.redo, "Save": self.save}[event.target.value])
        )
        self._state = self.gui.add_html("")
        self._saved = ""  # what the last save wrote
        self.part = PartPanel(self)
        tabs = self.gui.add_tab_group()
        self._download = self.gui.add_button(
            "Download zip", color="gray", hint="The asset with all its files; saves corrections first"
        )
        self._download.on_click(lambda event: self.act(lambda: self.download(event.client)))
        # hidden while there is no asset
        self._of_asset = (self._buttons, self._state, self._download, self.part.html, tabs)
        first = None if review is None else tabs.add_tab("Review")
        self.play = PlayPanel(self, tabs.add_tab("Play"))
        correct = tabs.add_tab("Correct")
        self._panels: list[Any] = [self.part, self.play, CorrectPanel(self, correct)]
        self.tools = CorrectionTools(self, correct)
        self.part.use(self.tools)
        self._panels.append(self.tools)
        self._keys()
        if review is not None:
            self._panels.append(ReviewPanel(self, first, review, reviewer=author, clock=clock, open_=self.open))
        self.part.add_channel()
        self._show_controls()
        self._player = threading.Thread(target=self._run, daemon=True)
        self._player.start()

    def open(self, folder: Path) -> None:
        """Show the asset of an output folder. Raise OutputError if there is none."""
        with self._lock:
            self.session = Session(folder, self._author, self._clock)
            self.playing, self._saved = None, ""
            self.view.look_at(self.session.asset.mesh)
            self.play.choose_looks(self.session.asset)
            self.play.read_grippers()
            self.refresh()
            self._show_controls()

    def shut(self) -> None:
        """Remove the asset from the page."""
        with self._lock:
            self.session = self.playing = None
            self.view.clear()
            self._head.content = self._title.content = ""
            self._show_controls()

    def _show_controls(self) -> None:
        for control in self._of_asset:
            control.visible = self.bench is None or self.session is not None

    def download(self, client: Any) -> None:
        """Send the asset as a zip to a tab; corrections are saved first."""
        if self.session is None:
            return
        if self.session.unsaved:
            self.save()
        folder = self.session.folder
        client.send_file_download(f"{folder.name}.zip", zip_bytes(folder), save_immediately=True)

    def close(self) -> None:
        """Stop the play and the server."""
        if self.bench is not None:
            self.bench.close()
        self._ended.set()
        self.part.close()
        self._player.join()
        self.server.stop()

    @property
    def asset(self) -> Asset | None:
        """The displayed asset, with the previewed correction."""
        return None if self.session is None else self.session.shown

    def is_browsing(self) -> bool:
        """Return whether arrow keys go through the motions of a part."""
        return self.part.browsing

    def act(self, what: Callable[[], None]) -> None:
        """Run a person's action under the lock; errors are shown, and nothing changes then."""
        with self._lock:
            try:
                what()
            except AnymeshError as error:
                self.show_message(str(error), bad=True)

    def show_message(self, text: str, title: str = "Done", *, bad: bool = False) -> None:
        """Show a message in every tab."""
        for client in self.server.get_clients().values():
            client.add_notification(
                "Not done" if bad else title, text, auto_close_seconds=MESSAGE_SECONDS, color="red" if bad else "green"
            )

    def refresh(self) -> None:
        """Draw everything from the session."""
        if self.session is None:
            return
        shown = self.session.shown
        self.view.show(shown)
        self.view.pose(self.session.positions, self.session.explode)
        self.view.mark(self.session.selected, self.session.chosen)
        for panel in self._panels:
            panel.refresh(self.session)
        self.tell_head()

    def tell_head(self) -> None:
        """Update the head of the page."""
        if self.session is not None:
            asset = self.session.asset
            self._title.content = title(asset.name, asset.mesh, contents(asset))
            unsaved = max(len(self.session.history.done), 1) if self.session.unsaved else 0
            self._head.content = head(asset, unsaved=0, note=self.view.note(), tool=self.tools.hint)
            self._state.content = saved_line(unsaved, self._saved)

    def correct(self, *corrections: Correction, joined: bool = False) -> None:
        """Apply corrections to the displayed asset as one step, or joined to the step before."""
        if self.session is not None:
            self.session.correct(*corrections, joined=joined)
            self.playing = None
            self.refresh()

    def undo(self) -> None:
        if self.session is not None:
            self.session.undo()
            self.refresh()

    def redo(self) -> None:
        if self.session is not None:
            self.session.redo()
            self.refresh()

    def save(self) -> None:
        if self.session is not None:
            self.session.save()
            self.play.read_grippers()
            self._saved = f"Saved at {self._clock()[11:16]} to {self.session.folder}"
            self.refresh()
            self.show_message(f"All files are written to {self.session.folder}", "Saved")

    def escape(self) -> None:
        """Leave the current tool, preview and chosen faces; if there are none, clear the selection."""
        if self.session is None:
            return
        left = [self.tools.leave(), self.part.leave()]
        busy = any(left) or self.session.preview is not None or len(self.session.chosen) > 0
        self.session.preview, self.session.chosen = None, np.zeros(0, np.int64)
        self.playing = None if busy else self.playing
        if not busy:
            self.session.selected = None
        self.refresh()

    def select(self, name: str | None) -> None:
        """Select the part to correct."""
        if self.session is not None and name != self.session.selected:
            self.session.selected, self.session.preview = name, None
            self.refresh()

    def play_joint(self, joint: str | None) -> None:
        """Move a joint back and forth ("" for all, None to stop)."""
        self.playing, self._began = joint, time.monotonic()
        if joint is None and self.session is not None:
            self.session.moving = {}
            self.view.pose(self.session.positions, self.session.explode)
        self.play.tell_playing(joint == "")

    def _run(self) -> None:
        while not self._ended.wait(TICK):
            with self._lock:
                self.view.follow_shadow()
                session = self.session
                if session is None or self.playing is None:
                    continue
                phase = (time.monotonic() - self._began) / SECONDS % 1
                moved = {j.name: swayed(session.shown, j, phase) for j in session.shown.joints if self.playing in ("", j.name)}
                session.moving = moved
                self.view.pose({**session.positions, **moved}, session.explode)

    def _keys(self) -> None:
        for label, key, modifier, what in (
            ("Undo", "Z", "cmd/ctrl", self.undo),
            ("Redo", "Z", "cmd/ctrl+shift", self.redo),
            ("Save", "S", "cmd/ctrl", self.save),
            ("Leave the tool, the preview, the selection", "escape", None, self.escape),
            ("Play or stop", "space", None, lambda: self.play_joint(None if self.playing is not None else "")),
        ):
            self.key(label, key, what, modifier)

    def key(self, label: str, key: str, what: Callable[[], None], modifier: str | None = None) -> None:
        """Add a keyboard shortcut to the page, and to its list of commands (Ctrl-K)."""
        self.gui.add_command(label, hotkey=key, modifier=modifier).on_trigger(lambda _: self.act(what))
