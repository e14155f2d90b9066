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

LONGEST = 4_000_000  # [bytes] maximum size of a list of models


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
