"""Opening of the live page for an output, a mesh, or a folder of outputs. Only browsers at its own address are served.

Another web page that a person visits may send requests to the loopback address, which is detected by their Origin. A host name
that points to the loopback address (DNS rebinding) is detected by a different Host.
"""

from __future__ import annotations

import contextlib
import http
import io
import ipaddress
import shutil
import tempfile
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from anymesh import pipeline
from anymesh.errors import MissingExtraError, OptionError, pip_install
from anymesh.pipeline.atomic_folder import CORRECTIONS, written_files
from anymesh.runtime import Progress, silent
from anymesh.viewer.intake.bench_ import WorkbenchFolders
from anymesh.viewer.live_ import LivePage
from anymesh.viewer.session import Clock

REFUSAL = b"this page answers at its own address only\n"


def is_permitted(host: str | None, origin: str | None, *, bound: str) -> bool:
    """Return whether a request with these headers may be served. bound: the address that the server listens at.

    At a loopback address, Host must be a loopback address. Origin, if sent, must always be that of the page.
    """
    if not host or (_is_loopback(bound) and not _is_loopback(_name(f"//{host}"))):
        return False
    return origin is None or urlsplit(origin).netloc.lower() == host.lower()


def _name(address: str) -> str:
    try:
        return urlsplit(address).hostname or ""
    except ValueError:
        return ""


def _is_loopback(name: str) -> bool:
    if name == "localhost":
        return True
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return False


@contextmanager
def guarded_server(bound: str) -> Generator[None]:
    """Make a server that is started in this context reject unpermitted requests before its own handlers."""
    import websockets.asyncio.server as library
    from websockets.datastructures import Headers, MultipleValuesError
    from websockets.http11 import Response

    serve = library.serve

    def started(*values: Any, process_request: Callable[..., Any] | None = None, **options: Any) -> Any:
        def check(connection: Any, request: Any) -> Any:
            try:
                fine = is_permitted(request.headers.get("Host"), request.headers.get("Origin"), bound=bound)
            except MultipleValuesError:
                fine = False
            if not fine:
                return Response(http.HTTPStatus.FORBIDDEN, "Forbidden", Headers(), REFUSAL)
            return None if process_request is None else process_request(connection, request)

        return serve(*values, process_request=check, **options)

    library.serve = started  # ty: ignore[invalid-assignment]
    try:
        yield
    finally:
        library.serve = serve


def start_server(host: str, port: int, label: str) -> Any:
    """Start a viser server that answers at its own address only. Raise MissingExtraError without the package."""
    try:
        import viser
    except ImportError:
        raise MissingExtraError(f"the viewer needs the extra `view`: {pip_install('view')}") from None
    with guarded_server(host):
        return viser.ViserServer(host=host, port=port, label=label, verbose=False)


@dataclass(frozen=True)
class Serving:
    """A running page. url: its address; notes: information for the person, in sentences."""

    page: LivePage
    url: str
    notes: tuple[str, ...]


@contextlib.contextmanager
def serve(
    target: str | Path | None,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    author: str,
    clock: Clock,
    root: str | Path | None = None,
    ask: bool = False,
    out: str | Path | None = None,
    progress: Progress = silent,
) -> Generator[Serving]:
    """Serve the live page of a target within the `with` block.

    A mesh is articulated first, into a temporary folder that is kept if corrections were saved in it. None: a page that accepts
    meshes. ask: the page articulates this mesh and puts its questions to the person. out: folder in which a page that accepts
    meshes stores assets, and answers for later runs. If the port is taken, the next one is used. root: as for `articulate`.
    Raise InputError, OptionError, OutputError or MissingExtraError.
    """
    place = None if target is None else Path(target)
    if ask and (place is None or not place.is_file()):
        raise OptionError(f"--ask needs a mesh file; found {'none' if place is None else place}")
    if out is not None and place is not None and not ask:
        raise OptionError("--out is for a page that takes meshes: without a target, or with --ask")
    with contextlib.ExitStack() as stack:
        notes: tuple[str, ...] = ()
        folder = bench = None
        if place is None or ask:
            bench, notes = stack.enter_context(_bench(out, ask))
        elif place.is_dir():
            folder = place.resolve()
        else:
            folder, notes = stack.enter_context(_articulated(place, root, progress))
        one = folder is not None and written_files(folder) is not None
        with contextlib.redirect_stdout(io.StringIO()):  # the library's own banner
            server = start_server(host, port, "Articulate AnyMesh")
        try:
            page = LivePage(server, author=author, clock=clock, review=None if one else folder, bench=bench)
        except BaseException:
            server.stop()
            raise
        stack.callback(page.close)
        if folder is not None and one:
            page.open(folder)
        if page.bench is not None and place is not None:
            page.bench.start(place, root)
        yield Serving(page, f"http://{server.get_host()}:{server.get_port()}", notes)


@contextlib.contextmanager
def _bench(out: str | Path | None, ask: bool) -> Generator[tuple[WorkbenchFolders, tuple[str, ...]]]:
    """Provide the folders of a page that accepts meshes; its temporary folder is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="anymesh-view-", ignore_cleanup_errors=True) as temporary:
        kept = None if out is None else Path(out).resolve()
        lost = "Assets are removed at the end: download them from the page, or give --out DIR."
        yield WorkbenchFolders(Path(temporary).resolve(), kept, ask), (lost if kept is None else f"Assets are kept in {kept}.",)


@contextlib.contextmanager
def _articulated(mesh: Path, root: str | Path | None, progress: Progress) -> Generator[tuple[Path, tuple[str, ...]]]:
    """Articulate a mesh into a temporary folder."""
    temporary = Path(tempfile.mkdtemp(prefix="anymesh-view-"))
    folder = temporary / "asset"
    try:
        pipeline.articulate(mesh, folder, root=root, progress=progress)
        yield folder, (f"The mesh was articulated into {folder}, which is removed at the end unless corrections are saved.",)
    finally:
        if not (folder / CORRECTIONS).exists():
            shutil.rmtree(temporary, ignore_errors=True)
