"""Access control of the live page: only browsers at its own address are served.

Another web page that a person visits may send requests to the loopback address, which is detected by their Origin. A host name
that points to the loopback address (DNS rebinding) is detected by a different Host.
"""

from __future__ import annotations

import http
import ipaddress
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

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
