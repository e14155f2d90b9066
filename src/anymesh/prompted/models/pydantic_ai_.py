"""Vision-language models over HTTP: OpenAI, Anthropic, Google, and every server with OpenAI's format.

Keys and library errors, which may hold headers and whole requests, do not leave the thread that makes the call. It returns a
reply or a ModelError with its own message.
"""

from __future__ import annotations

import asyncio
import importlib
import logging
import os
import time
from collections.abc import Callable, Coroutine, Iterable
from concurrent.futures import Future
from dataclasses import dataclass, field
from threading import Thread
from typing import TYPE_CHECKING, Any, TypeVar

from anymesh.errors import MAX_QUOTE, SECRET, MissingExtraError, ModelError, OptionError, pip_install
from anymesh.prompted.models.pydantic_ai_wire_ import (
    fit,
    the_message,
    the_model,
    the_parameters,
    the_settings,
    the_text,
    unfenced,
)
from anymesh.prompted.models.retry import TransientError
from anymesh.prompted.models.servers import KEYS, Address, parse_address
from anymesh.prompted.models.vision import Reply, Request
from anymesh.runtime import CALL_SECONDS
from anymesh.types.exchange import Picture

if TYPE_CHECKING:
    from pydantic_ai.exceptions import ModelHTTPError
    from pydantic_ai.messages import ModelResponse

log = logging.getLogger("anymesh")
T = TypeVar("T")
RUN = 24  # number of characters in common with the request from which a text counts as a quote
TALKATIVE = ("openai", "anthropic", "google_genai", "httpx", "httpx2", "httpcore", "httpcore2", "pydantic_ai")


def connect(name: str, *, timeout: float = CALL_SECONDS) -> Client:
    """Create the client of a model; `timeout` [s] applies to a whole call.

    Raise OptionError for an invalid name, MissingExtraError without the libraries, ModelError without a key.
    """
    if not timeout > 0:
        raise OptionError(f"--timeout must be more than 0 s, found {timeout:g}")
    address = parse_address(name)
    try:
        importlib.import_module(f"pydantic_ai.models.{address.provider.partition('-')[0]}")
    except ImportError:
        raise MissingExtraError(
            f"the client of {address.provider} is not installed; install it with {pip_install('vlm')}"
        ) from None
    address.key()  # fail now rather than after the rendering
    return Client(name, address, timeout)


@dataclass(frozen=True)
class _Failure:
    """A failed call, returned as a value: an exception raised while handling the library's error would carry it as context."""

    error: ModelError
    status: int | None = None  # HTTP status


@dataclass
class Client:
    """Client over HTTP: one request, one attempt. It stores no key."""

    name: str
    address: Address
    timeout: float  # [s]
    takes_schema: bool = field(default=True, init=False)  # until the server refuses it

    def ask(self, request: Request) -> Reply:
        """Ask the model once.

        Raise TransientError if another attempt may succeed, another ModelError otherwise. A truncated, refused or empty answer
        is a reply: its text is the part received, the refusal's words, or "".
        """
        pictures = fit(request, self.address.provider)
        reply = self._attempt(request, pictures, schema=self.takes_schema)
        if isinstance(reply, _Failure) and reply.status in (400, 422) and self._may_lack_schemas():
            log.info("%s: refused (HTTP %d), so it is asked without a JSON schema, with that in words", self.name, reply.status)
            reply = self._attempt(request, pictures, schema=False)
            self.takes_schema = isinstance(reply, _Failure)  # refused again: the schema was not the cause
        if isinstance(reply, _Failure):
            raise reply.error
        return reply

    def _may_lack_schemas(self) -> bool:
        return self.takes_schema and self.address.provider == "openai-compatible"

    def _attempt(self, request: Request, pictures: tuple[Picture, ...], *, schema: bool) -> Reply | _Failure:
        start = time.monotonic()

        async def attempt() -> ModelResponse | _Failure:
            try:
                # The libraries' own limit applies between two bytes, and an answer may arrive slowly forever.
                return await asyncio.wait_for(self._exchange(request, pictures, schema=schema), self.timeout)
            except Exception as error:
                return self._failure(error, request)

        response = _in_thread(attempt)
        if isinstance(response, _Failure):
            return response
        if response.finish_reason == "length":
            log.warning("%s: the answer to %r was cut off at %d tokens", self.name, request.kind, request.max_tokens)
        text, usage = the_text(response), response.usage
        return Reply(
            text=_without_keys(unfenced(text) if self.address.provider == "openai-compatible" else text),
            model=self.name,
            input_tokens=usage.input_tokens,
            output_tokens=usage.output_tokens,
            seconds=time.monotonic() - start,
        )

    async def _exchange(self, request: Request, pictures: tuple[Picture, ...], *, schema: bool) -> ModelResponse:
        import httpx2
        from pydantic_ai.direct import model_request

        for name in TALKATIVE:  # their debug messages contain headers and whole requests
            if logging.getLogger(name).getEffectiveLevel() < logging.INFO:
                logging.getLogger(name).setLevel(logging.INFO)
        async with httpx2.AsyncClient(timeout=self.timeout) as http:
            model = the_model(self.address, http)
            return await model_request(
                model,
                [the_message(self.address, request, pictures, schema=schema)],
                model_settings=the_settings(self.address, model, request.max_tokens, self.timeout),
                model_request_parameters=the_parameters(self.address, model, request, schema=schema),
                instrument=False,
            )

    def _failure(self, error: Exception, request: Request) -> _Failure:
        from httpx2 import TransportError
        from pydantic_ai import exceptions as theirs

        if isinstance(error, ModelError):
            return _Failure(error)
        if isinstance(error, theirs.ModelRequestTimeout | theirs.ModelTimeoutError | TimeoutError):
            return _Failure(TransientError(f"{self.name}: no answer within {self.timeout:g} s"))
        if isinstance(error, theirs.ModelConnectionError | TransportError | OSError):
            return _Failure(TransientError(f"{self.name}: the connection could not be made, or broke off"))
        if isinstance(error, theirs.ModelHTTPError):
            return self._http_failure(error, request)
        if isinstance(error, theirs.ModelAPIError | theirs.UnexpectedModelBehavior):
            return _Failure(TransientError(f"{self.name}: the reply could not be read ({type(error).__name__})"))
        if isinstance(error, AttributeError | LookupError | TypeError | ValueError):
            return _Failure(TransientError(f"{self.name}: the reply could not be read ({type(error).__name__})"))
        return _Failure(ModelError(f"{self.name}: the request failed ({type(error).__name__})"))

    def _http_failure(self, error: ModelHTTPError, request: Request) -> _Failure:
        from pydantic_ai.exceptions import ModelQuotaExceededError

        status, names = error.status_code, self.address.keys
        message = f"{self.name}: HTTP {status}"
        if status in (401, 403):  # its message is about the key, and often contains parts of it
            message += f", the key in {' or '.join(names)} is missing or refused"
            return _Failure(ModelError(message), status)
        if words := _redacted(_words(error.body), request, _keys()):
            message += f", it says: {words}"
        passing = status in (408, 425, 429) or status >= 500
        if passing and not isinstance(error, ModelQuotaExceededError):
            return _Failure(TransientError(message, error.retry_after), status)
        return _Failure(ModelError(message), status)


def _keys() -> list[str]:
    """Return all keys in the environment."""
    return [value for group in KEYS.values() for n in group if (value := os.environ.get(n, "").strip())]


def _without_keys(text: str) -> str:
    """Remove keys from an answer before it is stored, since a server may repeat the key that it received."""
    for key in (k for k in _keys() if len(k) >= 8):  # shorter values are not keys, and may be words
        text = text.replace(key, "[removed]")
    return text


def _in_thread(work: Callable[[], Coroutine[Any, Any, T]]) -> T:
    """Run a coroutine in its own event loop, since the caller may be in a running one, as in a notebook.

    The thread is a daemon, so that Ctrl-C ends the program without waiting for the service.
    """
    result: Future[T] = Future()

    def run() -> None:
        try:
            result.set_result(asyncio.run(work()))
        except BaseException as error:
            result.set_exception(error)

    Thread(target=run, name="anymesh-model", daemon=True).start()
    return result.result()


def _words(body: object) -> str:
    """Return the message in an error's body; services put it in different places."""
    if isinstance(body, list):
        body = body[0] if body else None
    if isinstance(body, dict):
        inner = body.get("error", body)
        body = inner.get("message", "") if isinstance(inner, dict) else inner
    return body if isinstance(body, str) else ""


def _redacted(words: str, request: Request, secrets: Iterable[str]) -> str:
    """Return the message as one short line, or "" if it quotes the request.

    Given secrets, and everything that looks like a key or like data, are replaced.
    """
    line = " ".join(words.split())
    for secret in secrets:
        line = line.replace(secret, "[removed]")
    line = SECRET.sub("[removed]", line)[:MAX_QUOTE]
    sent = [" ".join(text.split()) for text in request.texts]
    quotes = any(line[k : k + RUN] in text for k in range(max(0, len(line) - RUN + 1)) for text in sent)
    return "" if quotes else line
