"""One HTTP call with the standard library: a deadline, a limit of size, errors without secrets; and calling again."""

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
from anymesh.models.retry import TransientError

log = logging.getLogger("anymesh")
T = TypeVar("T")
LOCAL = ("localhost", "127.0.0.1", "::1")
CHUNK = 1 << 16  # [bytes]


class LostError(TransientError):
    """The request went out and no whole answer came back: it may have been carried out."""


@dataclass(frozen=True)
class Call:
    """What to send. `name` stands for the address in messages, since addresses may be signed; timeout [s] is for all of
    it; most [bytes]; redirects are followed only where asked, and never with a key; plain: http to other machines too."""

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
class Answer:
    """What came back, whatever its status. headers: names in lower case."""

    status: int
    headers: Mapping[str, str]
    body: bytes

    @property
    def retry_after(self) -> float | None:
        """How long the server asks to wait [s]; None when it says nothing, or a date."""
        told = self.headers.get("retry-after", "").strip()
        return float(told) if told.isdecimal() else None


def is_web(url: str, *, plain: bool = False) -> bool:
    """Whether an address is https, or http of this machine; with `plain`, http of any."""
    try:
        parts = urlsplit(url)
        host = parts.hostname
    except ValueError:
        return False
    return bool(host) and (parts.scheme == "https" or (parts.scheme == "http" and (plain or host in LOCAL)))


def exchange(call: Call) -> Answer:
    """Raises TransientError where the request did not get through, LostError where its answer did not, ModelError for an
    address that is neither https nor local, or an answer that is too large."""
    if not is_web(call.url, plain=call.plain):
        raise ModelError(f"{call.name}: the address must be https, or http on this machine")
    found = _exchange(call)
    if isinstance(found, ModelError):  # raised here, where the library's error, which may hold the request, is gone
        raise found
    return found


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
    except ValueError:  # a header with a line break, a host that is none
        return ModelError(f"{call.name}: the address or a header is not valid")


def _read(call: Call, response: http.client.HTTPResponse, headers: Mapping[str, str], end: float) -> Answer | ModelError:
    chunks, size = [], 0
    while chunk := response.read1(CHUNK):  # what there is, so that a trickle does not outlast the deadline
        chunks.append(chunk)
        size += len(chunk)
        if size > call.max_bytes:
            return ModelError(f"{call.name}: the answer is larger than {call.max_bytes} bytes, which is the most that is read")
        if time.monotonic() > end:
            return LostError(f"{call.name}: the answer was not whole within {call.timeout:g} s")
    told = headers.get("content-length", "")
    if told.isdecimal() and size < int(told):
        return LostError(f"{call.name}: the answer broke off after {size} of {told} bytes")
    return Answer(response.status, headers, b"".join(chunks))


def _opener(call: Call) -> OpenerDirector:
    """Of http and https alone: an address that a server names must not open a file."""
    opener = OpenerDirector()
    handlers: list[BaseHandler] = [ProxyHandler(), HTTPHandler(), HTTPSHandler()]
    if call.redirects and "authorization" not in {name.lower() for name in call.headers}:
        handlers += [HTTPErrorProcessor(), HTTPRedirectHandler(), HTTPDefaultErrorHandler()]
    for handler in handlers:
        opener.add_handler(handler)
    return opener
