"""Local model servers: their addresses and their models."""

from __future__ import annotations

import http.client
import json
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from anymesh.errors import OptionError

LOOPBACK = ("localhost", "127.0.0.1", "::1")
LONGEST = 4_000_000  # [bytes] maximum size of a list of models


@dataclass(frozen=True)
class Server:
    """A kind of server.

    port: its default; variables: environment variables that may hold its address; keys: those that may hold its key;
    details: path that lists which models accept pictures, "" if there is none.
    """

    name: str
    port: int
    variables: tuple[str, ...]
    keys: tuple[str, ...]
    details: str = ""

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
        Server("ollama", 11434, ("OLLAMA_BASE_URL", "OLLAMA_HOST"), ("OLLAMA_API_KEY",), "/api/show"),
        Server("lmstudio", 1234, ("LM_STUDIO_BASE_URL", "LM_STUDIO_API_BASE"), ("LM_STUDIO_API_KEY",), "/api/v0/models"),
        Server("vllm", 8000, ("VLLM_BASE_URL", "HOSTED_VLLM_API_BASE"), ("VLLM_API_KEY",)),
    )
}


@dataclass(frozen=True)
class LocalModel:
    """A model of a server. name: as for --answerer; takes_pictures: whether it accepts pictures, None if unknown."""

    name: str
    takes_pictures: bool | None


@dataclass(frozen=True)
class ServerProbe:
    """Result of asking a server for its models. models: None if it did not answer, with the reason in `note`."""

    server: str
    url: str
    models: tuple[LocalModel, ...] | None
    note: str = ""

    @property
    def is_local(self) -> bool:
        """Whether the server runs on this machine."""
        return urlsplit(self.url).hostname in LOOPBACK


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
        listed = _fetch(server, f"{url}/models", timeout)["data"]
        names = [str(m["id"]) for m in listed]
    except (OSError, http.client.HTTPException):
        return ServerProbe(server.name, url, None, "no answer")
    except (ValueError, LookupError, TypeError):
        return ServerProbe(server.name, url, None, "something answers there, but lists no models")
    seeing = _vision_models(server, url.removesuffix("/v1"), names, timeout)
    return ServerProbe(server.name, url, tuple(LocalModel(f"{server.name}:{name}", seeing.get(name)) for name in names))


def _vision_models(server: Server, root: str, names: list[str], timeout: float) -> dict[str, bool]:
    """Return which models accept pictures, as far as the server states it."""
    try:
        if server.name == "ollama":
            shown = {n: _fetch(server, root + server.details, timeout, {"model": n}).get("capabilities") for n in names[:32]}
            return {name: "vision" in capabilities for name, capabilities in shown.items() if isinstance(capabilities, list)}
        if server.details:
            listed = _fetch(server, root + server.details, timeout)["data"]
            return {str(m["id"]): m.get("type") == "vlm" for m in listed}
    except (OSError, http.client.HTTPException, ValueError, LookupError, TypeError, AttributeError):
        pass  # older servers do not state it
    return {}


def _fetch(server: Server, url: str, timeout: float, body: dict[str, Any] | None = None) -> dict[str, Any]:
    """Fetch a JSON object. Raise OSError, HTTPException or ValueError on failure."""
    parts = urlsplit(url)
    kind = http.client.HTTPSConnection if parts.scheme == "https" else http.client.HTTPConnection
    connection = kind(parts.hostname or "", parts.port, timeout=timeout)  # no proxy, since these are local machines
    headers = {"content-type": "application/json"}
    if key := next((value for name in server.keys if (value := os.environ.get(name, "").strip())), ""):
        headers["authorization"] = f"Bearer {key}"
    try:
        content = None if body is None else json.dumps(body)
        connection.request("GET" if body is None else "POST", parts.path, content, headers)
        response = connection.getresponse()
        answer = json.loads(response.read(LONGEST)) if response.status == 200 else None
    finally:
        connection.close()
    if not isinstance(answer, dict):
        raise ValueError("no JSON object")
    return answer


def first_vision_model(probes: list[ServerProbe]) -> LocalModel | None:
    """Return the first model on this machine that is known to accept pictures; None if there is none."""
    return next((m for f in probes if f.is_local for m in f.models or () if m.takes_pictures), None)
