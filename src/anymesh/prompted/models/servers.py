"""Names of models: the provider, the model, the environment variables of the key, and servers on one's own machine."""

from __future__ import annotations

import http.client
import json
import os
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from anymesh.errors import ModelError, OptionError

LONGEST = 4_000_000  # [bytes] maximum size of a list of models
VALID = (
    "openai:MODEL, openai-responses:MODEL, anthropic:MODEL, google:MODEL, ollama:MODEL, lmstudio:MODEL, vllm:MODEL, "
    "openai-compatible:BASE_URL#MODEL, files:FOLDER or replay:FOLDER"
)
BASES = {
    "openai": "OPENAI_BASE_URL",
    "openai-responses": "OPENAI_BASE_URL",
    "anthropic": "ANTHROPIC_BASE_URL",
    "google": "GOOGLE_GEMINI_BASE_URL",
}
NO_KEY = "no-key"  # placeholder sent to servers that need no key, since the client requires one


@dataclass(frozen=True)
class Server:
    """A kind of server.

    port: its default; variables: environment variables that may hold its address; keys: those that may hold its key.
    """

    name: str
    port: int
    variables: tuple[str, ...]
    keys: tuple[str, ...]

    def base_url(self) -> str:
        """Return the address of its OpenAI-compatible interface. Raise OptionError if a variable holds no valid address."""
        given = ((v, value) for v in self.variables if (value := os.environ.get(v, "").strip()))
        variable, value = next(given, ("", f"http://127.0.0.1:{self.port}"))
        url = value if "://" in value else f"http://{value}"
        try:
            parts = urlsplit(url)
            host, port = parts.hostname, parts.port
        except ValueError:
            host, port, parts = None, None, urlsplit("")
        if not host or parts.scheme not in ("http", "https") or "@" in value or parts.query:
            raise OptionError(f"{variable} must hold an address such as http://127.0.0.1:{self.port}, without user or password")
        # a server that listens on all interfaces also listens on the loopback
        host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
        shown = f"[{host}]" if ":" in host else host
        port = port or (self.port if parts.scheme == "http" else 443)
        path = parts.path.rstrip("/")
        return f"{parts.scheme}://{shown}:{port}{path if path.endswith('/v1') else f'{path}/v1'}"


SERVERS = {
    server.name: server
    for server in (
        Server("ollama", 11434, ("OLLAMA_BASE_URL", "OLLAMA_HOST"), ("OLLAMA_API_KEY",)),
        Server("lmstudio", 1234, ("LM_STUDIO_BASE_URL", "LM_STUDIO_API_BASE"), ("LM_STUDIO_API_KEY",)),
        Server("vllm", 8000, ("VLLM_BASE_URL", "HOSTED_VLLM_API_BASE"), ("VLLM_API_KEY",)),
    )
}


@dataclass(frozen=True)
class ServerProbe:
    """Result of asking a server for its models.

    models: names as for --answerer; None if it did not answer, with the reason in `note`.
    """

    server: str
    url: str
    models: tuple[str, ...] | None
    note: str = ""


def probe_servers(timeout: float = 1.0) -> list[ServerProbe]:
    """Ask all servers concurrently for their models, each with a time-out of `timeout` [s] per call."""
    with ThreadPoolExecutor(len(SERVERS)) as pool:
        return list(pool.map(lambda server: _probe(server, timeout), SERVERS.values()))


def _probe(server: Server, timeout: float) -> ServerProbe:
    try:
        url = server.base_url()
    except OptionError as error:
        return ServerProbe(server.name, "", None, str(error))
    try:
        names = tuple(f"{server.name}:{m['id']}" for m in _fetch(server, f"{url}/models", timeout)["data"])
    except (OSError, http.client.HTTPException):
        return ServerProbe(server.name, url, None, "no answer")
    except (ValueError, LookupError, TypeError):
        return ServerProbe(server.name, url, None, "something answers there, but lists no models")
    return ServerProbe(server.name, url, names)


def _fetch(server: Server, url: str, timeout: float) -> dict[str, Any]:
    """Fetch a JSON object. Raise OSError, HTTPException or ValueError on failure."""
    parts = urlsplit(url)
    kind = http.client.HTTPSConnection if parts.scheme == "https" else http.client.HTTPConnection
    connection = kind(parts.hostname or "", parts.port, timeout=timeout)  # no proxy, since these are local machines
    headers = {"content-type": "application/json"}
    if key := next((value for name in server.keys if (value := os.environ.get(name, "").strip())), ""):
        headers["authorization"] = f"Bearer {key}"
    try:
        connection.request("GET", parts.path, headers=headers)
        response = connection.getresponse()
        answer = json.loads(response.read(LONGEST)) if response.status == 200 else None
    finally:
        connection.close()
    if not isinstance(answer, dict):
        raise ValueError("no JSON object")
    return answer


KEYS = {  # environment variables that may hold the key; the first one that is set is used
    "openai": ("OPENAI_API_KEY",),
    "openai-responses": ("OPENAI_API_KEY",),  # the same models through the newer of OpenAI's two interfaces
    "anthropic": ("ANTHROPIC_API_KEY",),
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "openai-compatible": ("ANYMESH_API_KEY",),  # never OpenAI's key: it must not be sent to another operator's server
    **{name: server.keys for name, server in SERVERS.items()},
}


@dataclass(frozen=True)
class Address:
    """A model at a provider.

    provider: whose client is used; base_url: None for the provider's own; service: whose key is sent, a name of KEYS.
    """

    provider: str
    model: str
    base_url: str | None = None
    service: str | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """Environment variables that may hold the key."""
        return KEYS[self.service or self.provider]

    def key(self) -> str:
        """Read the key from the environment, at each call. Raise ModelError if there is none."""
        names = self.keys
        key = next((value for name in names if (value := os.environ.get(name, "").strip())), "")
        if not key and self.provider != "openai-compatible":
            raise ModelError(f"no key for {self.provider}: set the environment variable {' or '.join(names)}")
        return key or NO_KEY

    def url(self) -> str | None:
        """Return the base URL of requests; None for the default of the provider's client."""
        return self.base_url or os.environ.get(BASES[self.provider], "").strip() or None


def parse_address(name: str) -> Address:
    """Parse the name of a model. Raise OptionError if it is not valid."""
    provider, _, rest = name.partition(":")
    if provider not in KEYS:
        raise OptionError(f"--answerer: found {name!r}; valid are geometry, {VALID}")
    if provider in SERVERS:
        if not rest.strip():
            raise OptionError(f"{name!r} names no model; `anymesh models` lists those available")
        return Address("openai-compatible", rest.strip(), SERVERS[provider].base_url(), provider)
    if provider != "openai-compatible":
        if not re.fullmatch(r"[\w.:/@-]+", rest):
            raise OptionError(f"{name!r} names no model; valid are {VALID}")
        return Address(provider, rest)
    base, _, model = rest.partition("#")
    try:
        url = urlsplit(base)
        host, _ = url.hostname, url.port
    except ValueError:  # a port that is not a number
        host, url = None, urlsplit("")
    if "@" in base or url.query:  # The URL is not repeated in the message, since it may hold a password.
        raise OptionError("a base URL must hold no user, password or query; a key is taken from ANYMESH_API_KEY")
    if url.scheme not in ("http", "https") or not host or not model.strip():
        raise OptionError(f"{name!r} must look like openai-compatible:http://localhost:8000/v1#MODEL")
    return Address(provider, model.strip(), base)
