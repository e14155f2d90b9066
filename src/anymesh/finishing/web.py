"""One HTTP call with the standard library, with a deadline, a size limit, and errors without secrets."""

from __future__ import annotations

import http.client
import logging
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar
from urllib.error import HTTPError, URLError
from urllib.parse import urlsplit
from urllib.request import (
    BaseHandler,
    HTTPDefaultErrorHandler,
    HTTPErrorProcessor,
    HTTPHandler,
    HTTPRedirectHandler,
    HTTPSHandler,
    OpenerDirector,
    ProxyHandler,
    Request,
)

from anymesh.errors import ModelError
from anymesh.prompted.models.retry import TransientError
from anymesh.types import Brief

log = logging.getLogger("anymesh")
T = TypeVar("T")
LOCAL = ("localhost", "127.0.0.1", "::1")
CHUNK = 1 << 16  # [bytes]


class LostError(TransientError):
    """The request was sent and no complete answer was received: it may have been carried out."""


@dataclass(frozen=True)
class Call(Brief):
    """An HTTP call.

    name: replaces the address in messages, since addresses may be signed; timeout: [s] for the whole call; max_bytes: of the
    answer;
    redirects: whether redirects are followed, but never with a key; plain: allow http also to other machines.
    """

    name: str
    method: str
    url: str
    headers: Mapping[str, str] = field(default_factory=dict, repr=False)
    body: bytes | None = field(default=None, repr=False)
    timeout: float = 60.0
    max_bytes: int = 1 << 24
    redirects: bool = False
    plain: bool = False


@dataclass(frozen=True)
class Answer(Brief):
    """Response with any status. headers: names in lower case."""

    status: int
    headers: Mapping[str, str]
    body: bytes

    @property
    def retry_after(self) -> float | None:
        """Wait requested by the server [s]; None if there is none, or if it is a date."""
        wait = self.headers.get("retry-after", "").strip()
        return float(wait) if wait.isdecimal() else None


def is_web(url: str, *, plain: bool = False) -> bool:
    """Return whether an address is https, or http on this machine; with `plain`, http on any machine."""
    try:
        parts = urlsplit(url)
        host = parts.hostname
    except ValueError:
        return False
    return bool(host) and (parts.scheme == "https" or (parts.scheme == "http" and (plain or host in LOCAL)))


def exchange(call: Call) -> Answer:
    """Make the call and return the answer.

    Raise TransientError if the request was not delivered, LostError if its answer was not received, ModelError for an address
    that is neither https nor local, or an answer that is too large.
    """
    if not is_web(call.url, plain=call.plain):
        raise ModelError(f"{call.name}: the address must be https, or http on this machine")
    answer = _exchange(call)
    if isinstance(answer, ModelError):  # raised here, outside the handler, since the library's error may hold the request
        raise answer
    return answer


def _exchange(call: Call) -> Answer | ModelError:
    end = time.monotonic() + call.timeout
    try:
        request = Request(call.url, data=call.body, headers=dict(call.headers), method=call.method)
        with _opener(call).open(request, timeout=call.timeout) as response:
            headers = {name.lower(): value for name, value in response.headers.items()}
            return _read(call, response, headers, end)
    except HTTPError as error:
        return Answer(error.code, {}, b"")
    except URLError:
        return TransientError(f"{call.name}: the connection could not be made")
    except TimeoutError:
        return LostError(f"{call.name}: no answer within {call.timeout:g} s")
    except (OSError, http.client.HTTPException):
        return LostError(f"{call.name}: the connection broke off")
    except ValueError:  # a header with a line break, or an invalid host
        return ModelError(f"{call.name}: the address or a header is not valid")


def _read(call: Call, response: http.client.HTTPResponse, headers: Mapping[str, str], end: float) -> Answer | ModelError:
    chunks, size = [], 0
    while chunk := response.read1(CHUNK):  # read what is available, so that a slow answer cannot outlast the deadline
        chunks.append(chunk)
        size += len(chunk)
        if size > call.max_bytes:
            return ModelError(f"{call.name}: the answer is larger than {call.max_bytes} bytes, the maximum")
        if time.monotonic() > end:
            return LostError(f"{call.name}: the answer was not complete within {call.timeout:g} s")
    length = headers.get("content-length", "")
    if length.isdecimal() and size < int(length):
        return LostError(f"{call.name}: the answer broke off after {size} of {length} bytes")
    return Answer(response.status, headers, b"".join(chunks))


def _opener(call: Call) -> OpenerDirector:
    """Return an opener for http and https only: an address given by a server must not open a file."""
    opener = OpenerDirector()
    handlers: list[BaseHandler] = [ProxyHandler(), HTTPHandler(), HTTPSHandler()]
    if call.redirects and "authorization" not in {name.lower() for name in call.headers}:
        handlers += [HTTPErrorProcessor(), HTTPRedirectHandler(), HTTPDefaultErrorHandler()]
    for handler in handlers:
        opener.add_handler(handler)
    return opener
