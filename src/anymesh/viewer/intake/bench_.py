"""Workbench of the live page: articulates an uploaded mesh in the background, and shows the resulting asset."""

from __future__ import annotations

import hashlib
import itertools
import logging
import threading
import time
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from anymesh.correcting import CorrectionError
from anymesh.errors import AnymeshError
from anymesh.pipeline.answering import object_name
from anymesh.pipeline.options import FILES
from anymesh.viewer.intake.uploads import drop_zone, plain_name, receive
from anymesh.viewer.intake.work import ArticulationWork
from anymesh.viewer.panels import SMALL, Page
from anymesh.viewer.questions.desk_ import AskDesk

log = logging.getLogger("anymesh")
TICK, LOOK = 0.05, 0.25  # [s] between poses, and between checks of the work
ALONE, MYSELF = "are left to geometry", "are put to me"
UPS = ("auto", "x", "y", "z")
BUSY = "one mesh at a time; cancel the current one first"


@dataclass(frozen=True)
class WorkbenchFolders:
    """Folders of a workbench.

    folder: temporary; out: where assets and answers are stored, None for the temporary folder; ask: put questions to the person
    by default.
    """

    folder: Path
    out: Path | None = None
    ask: bool = False


class Workbench:
    """Articulates one mesh at a time. Callbacks hold the page's lock; a separate thread follows the work."""

    def __init__(self, page: Page, bench: WorkbenchFolders) -> None:
        self._page, self._bench, gui = page, bench, page.gui
        self._numbers = itertools.count(1)
        self._work: ArticulationWork | None = None
        self._name = ""
        self._message = ("", False)
        self._shows: bool | None = None
        self._words = gui.add_html("")
        self._bar = gui.add_progress_bar(0.0, visible=False, animated=True)
        self._outer = gui.add_folder(None)
        self._inner: Any = None
        self._who, self._up = MYSELF if bench.ask else ALONE, UPS[0]
        self._desk = AskDesk(page)
        self._cancel = gui.add_button("Cancel", color="red", visible=False)
        self._cancel.on_click(lambda _: page.act(self.cancel))
        self.refresh()
        self._ended = threading.Event()
        self._follower = threading.Thread(target=self._run, daemon=True)
        self._follower.start()

    def start(self, mesh: Path, root: str | Path | None) -> None:
        """Start the work on a mesh. Raise CorrectionError if another is in progress, or if corrections would be lost."""
        if self._work is not None:
            raise CorrectionError(BUSY)
        if self._page.session is not None and self._page.session.unsaved:
            raise CorrectionError("save the corrections of this one first (Ctrl-S), or undo them (Ctrl-Z)")
        out = self._place(plain_name(mesh.stem))
        questions = self._questions(mesh, out)
        options: dict[str, Any] = {"root": root, "up": self._up}
        if self._who == MYSELF:
            options |= {"answerer": f"{FILES}{questions}", "wait": True, "suggest": True}
        self._name, self._message = mesh.name, ("", False)
        self._page.shut()
        self._desk.begin(questions)
        self._work = ArticulationWork(mesh, out, **options)
        self.refresh()

    def cancel(self) -> None:
        """Cancel the work on a mesh; the page then accepts the next one."""
        if self._work is not None:
            self._work.cancel()
            self._finish(f"The work on {self._name} was cancelled.")

    def close(self) -> None:
        """Stop the work and the thread."""
        self._ended.set()
        self._follower.join()
        if self._work is not None:
            self._work.cancel()

    def refresh(self) -> None:
        """Show the upload controls, or the progress of the work."""
        work = self._work
        if work is None or work.begun:  # before that, the browser may not have finished its upload
            self._show_intake(None if work is not None else self._page.session is not None)
        self._bar.visible = work is not None and not self._desk.busy
        self._cancel.visible = work is not None
        text, bad = self._message
        if work is not None:
            state = "your answer is needed" if self._desk.busy else work.words
            text, self._bar.value = f"{self._name}: {state}", round(100 * work.share, 1)
        line = f'<div role="status" style="color:{"#c92a2a" if bad else "inherit"}">{escape(text)}</div>'
        _put(self._words, f"<div {SMALL}>{line}</div>" if text else "")

    def _show_intake(self, again: bool | None) -> None:
        """Show the upload controls; again: collapsed, above the displayed asset; None: hide them."""
        if self._shows == again and (self._inner is not None) == (again is not None):
            return
        if self._inner is not None:
            self._inner.remove()
            self._inner = None
        self._shows, gui = again, self._page.gui
        if again is None:
            return
        with self._outer:
            self._inner = gui.add_folder("Another mesh" if again else "Mesh", expand_by_default=not again)
        with self._inner:
            gui.add_html(drop_zone(small=again))
            upload = gui.add_upload_button("Choose a mesh or a zip", mime_type="*/*")
            who = gui.add_dropdown("Questions", (ALONE, MYSELF), initial_value=self._who)
            up = gui.add_dropdown("Up axis", UPS, initial_value=self._up, hint="Of the file; auto goes by its format and shape")

        def set_options() -> None:
            self._who, self._up = who.value, up.value

        upload.on_upload(lambda event: self._page.act(lambda: self._uploaded(event.target.value)))
        who.on_update(lambda _: self._page.act(set_options))
        up.on_update(lambda _: self._page.act(set_options))

    def _place(self, name: str) -> Path:
        """Return a new folder for an asset."""
        if self._bench.out is None:
            return self._bench.folder / f"asset-{next(self._numbers)}" / name
        names = itertools.chain([name], (f"{name}-{k}" for k in itertools.count(2)))
        return next(path for path in (self._bench.out / n for n in names) if not path.exists())

    def _questions(self, mesh: Path, out: Path) -> Path:
        """Return the folder of the questions about a mesh; with `out`, later runs on the same mesh use the same folder."""
        if self._bench.out is None:
            return out.with_name("questions")
        content = mesh.read_bytes() if mesh.is_file() else b""
        digest = hashlib.sha256(object_name(mesh).encode() + content).hexdigest()[:8]
        return self._bench.out / "questions" / f"{plain_name(mesh.stem)}-{digest}"

    def _uploaded(self, file: Any) -> None:
        if self._work is not None:
            raise CorrectionError(BUSY)
        try:
            got = receive(file.name, file.content, self._bench.folder / f"upload-{next(self._numbers)}" / "upload")
        except AnymeshError as error:
            self._message = (str(error), True)
            self.refresh()
            return
        self.start(got.mesh, got.root)

    def _run(self) -> None:
        looked = 0.0
        while not self._ended.wait(TICK):
            try:
                if self._desk.busy:
                    self._page.act(self._desk.tick)
                if self._work is not None and time.monotonic() - looked > LOOK:
                    self._page.act(self._look)
                    looked = time.monotonic()
            except Exception as error:  # a bug must not leave an unresponsive page
                log.exception("the work on %s could not be followed", self._name)
                message = f"The work on {self._name} failed with an internal defect, {type(error).__name__}: {error}"
                self._page.act(lambda message=message: self._give_up(message))

    def _look(self) -> None:
        """Follow the work: its stage, mesh, questions and end."""
        work = self._work
        if work is None:
            return
        if work.done:
            self._finish("")
            self._page.open(work.out)
        elif work.over:
            self._finish(f"{self._name} was not articulated: {work.error}", bad=True)
        elif work.mesh is not None:
            if self._desk.show_mesh(work.mesh):
                self._page.view.look_at(work.mesh)
            self._desk.look()
        self.refresh()

    def _give_up(self, text: str) -> None:
        if self._work is not None:
            self._work.cancel()
        self._finish(text, bad=True)

    def _finish(self, text: str, *, bad: bool = False) -> None:
        """Remove the work, its question and its drawing from the page."""
        self._work, self._message = None, (text, bad)
        self._desk.end()
        self.refresh()


def _put(html: Any, content: str) -> None:
    """Set the content of an element, only if it changes."""
    if html.content != content:
        html.content = content
