"""A real HTTP server on the loopback address that speaks each provider's wire format."""

import io
import json
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from PIL import Image

from anymesh.prompted.models.vision import Reply, Request, VisionModel, request_key
from anymesh.types import Exchange, Picture

Connect = Callable[..., VisionModel]
SCHEMA = {
    "type": "object",
    "properties": {"hinge": {"type": "integer"}, "why": {"type": "string"}},
    "required": ["hinge", "why"],
    "additionalProperties": False,
}
SECRET = "sk-marker-7f3a"  # in front of every key: it must be found in no message, log line, file or repr
ANSWER = '{"hinge": 3, "why": "it is the longest edge"}'


def png(width: int = 6, height: int = 4, colour: str = "red") -> bytes:
    buffer = io.BytesIO()
    Image.new("RGB", (width, height), colour).save(buffer, "PNG")
    return buffer.getvalue()


def a_request(**changes: Any) -> Request:
    parts: dict[str, Any] = {
        "kind": "hinge",
        "system": "You look at furniture.",
        "text": "Which of the numbered edges is the hinge of the door?",
        "pictures": (Picture(png(), "view 1, from the front"), Picture(png(5, 7, "blue"), "view 2, from the left")),
        "schema": SCHEMA,
        "max_tokens": 321,
    }
    return Request(**(parts | changes))


def exchange(request: Request, reply: Reply, verdict: str = "accepted", **changes: Any) -> Exchange:
    parts: dict[str, Any] = {
        "kind": request.kind,
        "key": request_key(reply.model, request),
        "model": reply.model,
        "text": request.text,
        "pictures": request.pictures,
        "answer": reply.text,
        "verdict": verdict,
        "input_tokens": reply.input_tokens,
        "output_tokens": reply.output_tokens,
        "cost": reply.cost,
        "cached": reply.cached,
        "seconds": reply.seconds,
    }
    return Exchange(**(parts | changes))


@dataclass
class Seen:
    """One request as it arrived."""

    path: str
    headers: dict[str, str]
    body: dict[str, Any]


@dataclass
class Service:
    """Answers in turn with `(status, headers, body)`, or by a function that is handed the open connection."""

    turns: list[Any] = field(default_factory=list)
    seen: list[Seen] = field(default_factory=list)
    over: threading.Event = field(default_factory=threading.Event)
    url: str = ""

    def says(self, body: Any, status: int = 200, **headers: str) -> None:
        content = body if isinstance(body, bytes) else json.dumps(body).encode()
        self.turns.append((status, {k.replace("_", "-"): v for k, v in headers.items()}, content))

    def does(self, act: Callable[[BaseHTTPRequestHandler], None]) -> None:
        self.turns.append(act)

    def handler(service) -> type[BaseHTTPRequestHandler]:  # noqa: N805
        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self) -> None:
                content = self.rfile.read(int(self.headers["content-length"]))
                headers = {k.lower(): v for k, v in self.headers.items()}
                service.seen.append(Seen(self.path, headers, json.loads(content)))
                turn = service.turns.pop(0) if service.turns else (599, {}, b"nothing left to say")
                if callable(turn):
                    self.close_connection = True
                    turn(self)
                    return
                status, more, body = turn
                self.send_response(status)
                for name, value in {"content-type": "application/json", "content-length": str(len(body)), **more}.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, *args: object) -> None:
                pass

        return Handler

    def start(self) -> ThreadingHTTPServer:
        server = ThreadingHTTPServer(("127.0.0.1", 0), self.handler())
        server.daemon_threads, server.block_on_close = True, False
        self.url = f"http://127.0.0.1:{server.server_port}"
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        return server

    def sleeps(self, handler: BaseHTTPRequestHandler) -> None:
        """Says nothing for as long as the test lasts."""
        self.over.wait(10)

    @staticmethod
    def cuts(handler: BaseHTTPRequestHandler) -> None:
        """Promises 500 bytes and hangs up after a few."""
        handler.wfile.write(b'HTTP/1.1 200 OK\r\ncontent-type: application/json\r\ncontent-length: 500\r\n\r\n{"id": ')
