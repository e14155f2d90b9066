"""Opens the live page on whatever a person points at: an output, a mesh, or a folder of outputs."""

from __future__ import annotations

import contextlib
import io
import shutil
import tempfile
from collections.abc import Generator
from dataclasses import dataclass
from pathlib import Path

from anymesh import pipeline
from anymesh.progress import Progress, silent
from anymesh.storage.outputs import CORRECTIONS, written_files
from anymesh.viewer.live import Clock
from anymesh.viewer.live_ import LivePage, start_server


@dataclass(frozen=True)
class Serving:
    """A page that is there. url: to open; told: what a person should know, in sentences."""

    page: LivePage
    url: str
    told: tuple[str, ...]


@contextlib.contextmanager
def serve(
    target: str | Path,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    author: str,
    clock: Clock,
    root: str | Path | None = None,
    progress: Progress = silent,
) -> Generator[Serving]:
    """The live page of a target, for as long as the `with` block lasts.

    A mesh is articulated first, into a temporary folder that stays when corrections were saved in it. A port that is taken
    moves on to the next. root: as for `articulate`. Raises InputError, OutputError, MissingExtraError.
    """
    target = Path(target)
    with contextlib.ExitStack() as stack:
        told: tuple[str, ...] = ()
        if not target.is_dir():
            folder, told = stack.enter_context(_articulated(target, root, progress))
        else:
            folder = target.resolve()
        one = written_files(folder) is not None
        with contextlib.redirect_stdout(io.StringIO()):  # of the library's own banner
            server = start_server(host, port, f"anymesh: {target.name}")
        try:
            page = LivePage(server, author=author, clock=clock, review=None if one else folder)
        except BaseException:
            server.stop()
            raise
        stack.callback(page.close)
        if one:
            page.open(folder)
        yield Serving(page, f"http://{server.get_host()}:{server.get_port()}", told)


@contextlib.contextmanager
def _articulated(mesh: Path, root: str | Path | None, progress: Progress) -> Generator[tuple[Path, tuple[str, ...]]]:
    """A mesh as an output in a temporary folder."""
    temporary = Path(tempfile.mkdtemp(prefix="anymesh-view-"))
    folder = temporary / "asset"
    try:
        pipeline.articulate(mesh, folder, root=root, progress=progress)
        yield folder, (f"The mesh was articulated into {folder}, which is removed at the end unless corrections are saved.",)
    finally:
        if not (folder / CORRECTIONS).exists():
            shutil.rmtree(temporary, ignore_errors=True)
