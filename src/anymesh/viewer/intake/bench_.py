"""Workbench of the live page: articulates an uploaded mesh in the background, and shows the resulting asset."""

from __future__ import annotations

import hashlib
import itertools
import logging
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from anymesh.correcting import CorrectionError
from anymesh.errors import AnymeshError
from anymesh.isolation.pool import ChildPool
from anymesh.pipeline.answering import object_name
from anymesh.pipeline.options import FILES
from anymesh.viewer.intake.uploads import plain_name, receive
from anymesh.viewer.intake.welcome import examples, script, small_zone, title, welcome
from anymesh.viewer.intake.work import ArticulationWork, StageState, warm_pool
from anymesh.viewer.panels import SMALL, Page
from anymesh.viewer.questions.desk_ import AskDesk

log = logging.getLogger("anymesh")
TICK, LOOK = 0.05, 0.25  # [s] between poses, and between checks of the work
ALONE, MYSELF, EACH = "are left to geometry", "are put to me", "are put to me, about each joint"
UPS = ("auto", "x", "y", "z")
EMPTY, ANOTHER, BACK = "Mesh", "Another mesh", "← Back to the last question"
FAINT = "color:#868e96"
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


@dataclass(frozen=True)
class MeshJob:
    """A mesh to work on. root: folder with the files that it refers to; questions: folder of the questions about it."""

    mesh: Path
    root: str | Path | None
    questions: Path


class Workbench:
    """Articulates one mesh at a time. Callbacks hold the page's lock; a separate thread follows the work."""

    def __init__(self, page: Page, bench: WorkbenchFolders) -> None:
        self._page, self._bench, gui = page, bench, page.gui
        self._numbers = itertools.count(1)
        self._pool: ChildPool | None = warm_pool()
        self._work: ArticulationWork | None = None
        self._job: MeshJob | None = None  # the last one
        self._message = ("", False)
        self._shows: str | None = None
        gui.add_html(script())
        self._over = gui.add_html("")
        self._words = gui.add_html("")
        self._bar = gui.add_progress_bar(0.0, visible=False, animated=True)
        self._again = gui.add_button("Start again", color="green", visible=False, hint="Your answers are filled in")
        self._again.on_click(lambda _: page.act(self.start_again))
        self._outer = gui.add_folder(None)
        self._inner: Any = None
        self._who, self._up = MYSELF if bench.ask else ALONE, UPS[0]
        self._desk = AskDesk(page)
        self._back = gui.add_button(BACK, color="gray", visible=False, hint="Change your last answer")
        self._back.on_click(lambda _: page.act(self.go_back))
        self._cancel = gui.add_button("Cancel", color="red", visible=False, hint="The mesh and your answers stay")
        self._cancel.on_click(lambda _: page.act(self.cancel))
        self.refresh()
        self._ended = threading.Event()
        self._follower = threading.Thread(target=self._run, daemon=True)
        self._follower.start()

    @property
    def _name(self) -> str:
        return "" if self._job is None else self._job.mesh.name

    def start(self, mesh: Path, root: str | Path | None) -> None:
        """Start the work on a mesh. Raise CorrectionError if another is in progress, or if corrections would be lost."""
        self._check_free()
        self._page.shut()
        self._job = MeshJob(mesh, root, self._questions(mesh))
        self._desk.begin(self._job.questions)
        self._begin(self._job)

    def start_again(self) -> None:
        """Start the work on the last mesh again, with the answers that were given filled in. Raise as `start`."""
        if self._job is None:
            return
        self._check_free()
        self._page.shut()
        self._desk.restart()
        self._begin(self._job)

    def go_back(self) -> None:
        """Ask the last question that was answered again; the work starts again, with the answers before it."""
        if self._job is None or self._work is None or not self._desk.can_go_back:
            return
        self._work.cancel()
        self._desk.go_back()
        self._begin(self._job)

    def _check_free(self) -> None:
        if self._work is not None:
            raise CorrectionError(BUSY)
        if self._page.session is not None and self._page.session.unsaved:
            raise CorrectionError("save the corrections of this one first (Ctrl-S), or undo them (Ctrl-Z)")

    def _begin(self, job: MeshJob) -> None:
        options: dict[str, Any] = {"root": job.root, "up": self._up}
        if self._who != ALONE:
            options |= {"answerer": f"{FILES}{job.questions}", "wait": True, "suggest": True}
        if self._who == EACH:
            options["ask"] = "all"
        pool, self._pool = self._pool, None
        self._message = ("", False)
        self._work = ArticulationWork(job.mesh, self._place(plain_name(job.mesh.stem)), pool=pool, **options)
        self.refresh()

    def cancel(self) -> None:
        """Cancel the work on a mesh; the mesh stays, and the answers that were given."""
        if self._work is not None:
            self._work.cancel()
            self._finish(f"The work on {self._name} was cancelled. The mesh and your answers are kept.")

    def close(self) -> None:
        """Stop the work and the thread."""
        self._ended.set()
        self._follower.join()
        if self._work is not None:
            self._work.cancel()
        if self._pool is not None:
            self._pool.close()

    def refresh(self) -> None:
        """Show the upload controls, or the progress of the work."""
        work, session = self._work, self._page.session
        if work is None or work.begun:  # before that, the browser may not have finished its upload
            empty = session is None and self._desk.mesh is None
            self._show_intake(None if work is not None else EMPTY if empty else ANOTHER)
        self._bar.visible = work is not None and not self._desk.busy
        self._cancel.visible = work is not None
        self._back.visible = work is not None and self._desk.can_go_back
        self._again.visible = work is None and session is None and self._desk.mesh is not None
        text, bad = self._message
        line = f'<div role="status" style="color:{"#c92a2a" if bad else "inherit"}">{escape(text)}</div>' if text else ""
        if work is not None:
            self._bar.value = round(100 * work.share, 1)
            line = stage_list(self._name, work.stages, asked=self._desk.busy)
        _put(self._words, f"<div {SMALL}>{line}</div>" if line else "")
        drawn = self._desk.mesh
        _put(self._over, title(Path(self._name).stem, drawn) if drawn is not None else self._welcome())

    def _welcome(self) -> str:
        return welcome(examples()) if self._page.session is None and self._work is None else ""

    def _show_intake(self, shows: str | None) -> None:
        """Show the upload controls: EMPTY, ANOTHER (collapsed, above an object), or None to hide them."""
        if self._shows == shows and (self._inner is not None) == (shows is not None):
            return
        if self._inner is not None:
            self._inner.remove()
            self._inner = None
        self._shows, gui = shows, self._page.gui
        if shows is None:
            return
        with self._outer:
            self._inner = gui.add_folder(shows, expand_by_default=shows == EMPTY)
        with self._inner:
            if shows == ANOTHER:
                gui.add_html(small_zone())
            upload = gui.add_upload_button("Choose a mesh, its files, or a zip", mime_type="*/*")
            who = gui.add_dropdown("Questions", (ALONE, MYSELF, EACH), initial_value=self._who)
            up = gui.add_dropdown("Up axis", UPS, initial_value=self._up, hint="Of the file; auto goes by its format and shape")
            tried = gui.add_button_group("Examples", tuple(e.name for e in examples()))
            if shows == ANOTHER and self._job is not None and self._page.session is not None:
                again = gui.add_button("Run this mesh again", color="gray", hint="Your answers are filled in")
                again.on_click(lambda _: self._page.act(self.start_again))

        def set_options() -> None:
            self._who, self._up = who.value, up.value

        upload.on_upload(lambda event: self._page.act(lambda: self._uploaded(event.target.value)))
        who.on_update(lambda _: self._page.act(set_options))
        up.on_update(lambda _: self._page.act(set_options))
        tried.on_click(lambda event: self._page.act(lambda: self._try(event.target.value)))

    def _try(self, name: str) -> None:
        """Start with an example."""
        self.start(next(e.path for e in examples() if e.name == name), None)

    def _place(self, name: str) -> Path:
        """Return a new folder for an asset."""
        if self._bench.out is None:
            return self._bench.folder / f"asset-{next(self._numbers)}" / name
        names = itertools.chain([name], (f"{name}-{k}" for k in itertools.count(2)))
        return next(path for path in (self._bench.out / n for n in names) if not path.exists())

    def _questions(self, mesh: Path) -> Path:
        """Return the folder of the questions about a mesh; with `out`, later runs on the same mesh use the same folder."""
        if self._bench.out is None:
            return self._bench.folder / f"questions-{next(self._numbers)}"
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
        if self._pool is None and work.begun:
            self._pool = warm_pool()
        if work.done:
            self._work, self._message = None, ("", False)
            self._desk.end()
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
        """Remove the work and its question from the page; the mesh stays."""
        self._work, self._message = None, (text, bad)
        self._desk.stop()
        self.refresh()


def stage_list(name: str, stages: Sequence[StageState], *, asked: bool) -> str:
    """Return the stages of the work on a mesh as HTML: what is done, what runs, how long. asked: waits for an answer."""
    rows = [f"<div><b>{escape(name)}</b></div>"]
    running = next((s for s in stages if s.seconds is not None and not s.over), None)
    for stage in stages:
        seconds = "" if stage.seconds is None else f"{stage.seconds:.1f} s" if stage.over else f"{stage.seconds:.0f} s"
        mark, style = ("✓", "color:#2b8a3e") if stage.over else ("▸", "font-weight:600") if stage is running else ("○", FAINT)
        words = "your answer is needed" if asked and stage is running else stage.words
        rows.append(
            f'<div style="display:flex;gap:0.4em;{style}"><span style="width:1em">{mark}</span>'
            f'<span style="flex:1">{escape(words)}</span><span>{seconds}</span></div>'
        )
    if running is None and not any(stage.over for stage in stages):
        rows.insert(1, "<div>starting</div>")
    return "".join(rows)


def _put(html: Any, content: str) -> None:
    """Set the content of an element, only if it changes."""
    if html.content != content:
        html.content = content
