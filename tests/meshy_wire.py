"""A server on the loopback address that speaks the wire format of Meshy (retexture, text to 3D, image to 3D), and fails as
asked."""

import base64
import json
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest

PATH, TEXT, IMAGE = "/openapi/v1/retexture", "/openapi/v2/text-to-3d", "/openapi/v1/image-to-3d"
SHAPE = {"should_remesh", "topology", "target_polycount", "target_formats", "ai_model", "auto_size", "origin_at"}
FIELDS = {  # that the service's pages list, as far as they are used
    "preview": {"mode", "prompt", *SHAPE},
    "refine": {"mode", "preview_task_id", "enable_pbr", "texture_prompt", "target_formats", "auto_size", "origin_at"},
    "image": {"image_url", "should_texture", "enable_pbr", "texture_prompt", *SHAPE},
}
PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
KEY = "msy_marker7f3aQ2vXk9LmN4pR8sT1uW6yZ0bC5dE"
SIGNATURE = "Signature=marker-5d1e"  # of the address of a result: it must be found nowhere either
Fault = Callable[[BaseHTTPRequestHandler], None]


class RefusedError(Exception):
    """A request that the service answers with a status and a message."""


@dataclass
class MeshyServer:
    """Tasks run through `steps`. `texture` makes the result of the GLB that was sent; `model` is what is generated; `ends` says
    how tasks of a type end instead. Faults are used up in their order, by what is asked: "create", "look" or "file"."""

    steps: list[dict[str, Any]] = field(default_factory=lambda: [{"status": "PENDING"}, {"status": "IN_PROGRESS"}])
    last: dict[str, Any] = field(default_factory=lambda: {"status": "SUCCEEDED", "progress": 100, "consumed_credits": 10})
    texture: Callable[[bytes], bytes] = lambda glb: glb
    model: bytes = b""
    ends: dict[str, dict[str, Any]] = field(default_factory=dict)
    tasks: dict[str, dict[str, Any]] = field(default_factory=dict)
    faults: dict[str, list[Fault]] = field(default_factory=dict)
    asked: list[str] = field(default_factory=list)
    keys: list[str | None] = field(default_factory=list)
    over: threading.Event = field(default_factory=threading.Event)
    url: str = ""

    def fails(self, what: str, *faults: Fault) -> None:
        self.faults.setdefault(what, []).extend(faults)

    def count(self, what: str) -> int:
        return self.asked.count(what)

    def create(self, body: dict[str, Any], path: str = PATH) -> str:
        task = f"018a210d-8ba4-705c-b111-{len(self.tasks):012d}"
        made = {PATH: self._retexture, TEXT: self._text, IMAGE: self._image}[path](body)
        self.tasks[task] = {**body, **made, "path": path, "looked": 0}
        return task

    def _retexture(self, body: dict[str, Any]) -> dict[str, Any]:
        head, _, data = body["model_url"].partition(",")
        assert head == "data:application/octet-stream;base64"
        return {"glb": base64.b64decode(data, validate=True), "type": "retexture"}

    def _text(self, body: dict[str, Any]) -> dict[str, Any]:
        assert set(body) <= FIELDS[body["mode"]], set(body) - FIELDS[body["mode"]]
        if body["mode"] == "preview":
            assert 0 < len(body["prompt"]) <= 800
            self._check_shape(body)
            return {"type": "text-to-3d-preview", "seed": 7 + len(self.tasks), "credits": 20}
        preview = self.tasks.get(body["preview_task_id"])
        if preview is None or preview["type"] != "text-to-3d-preview" or self.status(preview) != "SUCCEEDED":
            raise RefusedError(400, "preview_task_id: no preview that has succeeded")
        return {"type": "text-to-3d-refine", "prompt": preview["prompt"], "seed": preview["seed"], "credits": 10}

    def _image(self, body: dict[str, Any]) -> dict[str, Any]:
        assert set(body) <= FIELDS["image"], set(body) - FIELDS["image"]
        self._check_shape(body)
        head, _, data = body["image_url"].partition(",")
        sent = base64.b64decode(data, validate=True)
        assert (head, sent[:3]) in (("data:image/png;base64", PNG[:3]), ("data:image/jpeg;base64", JPEG)), head
        return {"type": "image-to-3d", "prompt": "", "sent": sent, "credits": 30 if body["should_texture"] else 20}

    def _check_shape(self, body: dict[str, Any]) -> None:
        assert body["should_remesh"] is True
        assert 100 <= body["target_polycount"] <= 300_000
        assert body["target_formats"] == ["glb"]

    def _steps(self, held: dict[str, Any]) -> list[dict[str, Any]]:
        return [*self.steps, self.ends.get(held["type"], self.last)]

    def status(self, held: dict[str, Any]) -> str:
        steps = self._steps(held)
        return steps[min(max(held["looked"] - 1, 0), len(steps) - 1)]["status"]

    def task(self, task: str) -> dict[str, Any]:
        held = self.tasks[task]
        steps = self._steps(held)
        now = steps[min(held["looked"], len(steps) - 1)]
        held["looked"] += 1
        done = now["status"] == "SUCCEEDED"
        urls = {"glb": f"{self.url}/files/{task}.glb?Expires=1&{SIGNATURE}", "fbx": f"{self.url}/x.fbx"} if done else {}
        spent = {"consumed_credits": held["credits"]} if done and "credits" in held else {}
        told = {k: held[k] for k in ("type", "prompt", "text_style_prompt", "seed") if k in held}
        return {"id": task, **told, "progress": 0, "task_error": {"message": ""}, "model_urls": urls, **now, **spent}

    def start(self) -> ThreadingHTTPServer:
        server = ThreadingHTTPServer(("127.0.0.1", 0), _handler(self))
        server.daemon_threads, server.block_on_close = True, False
        self.url = f"http://127.0.0.1:{server.server_port}"
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        return server


@contextmanager
def serving(server: MeshyServer, monkeypatch: pytest.MonkeyPatch) -> Iterator[MeshyServer]:
    """Run a server, and direct the client to it by its environment variables."""
    running = server.start()
    for name in [n for n in os.environ if "PROXY" in n.upper()]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("MESHY_API_KEY", KEY)
    monkeypatch.setenv("MESHY_BASE_URL", server.url)
    yield server
    server.over.set()
    running.shutdown()
    running.server_close()


def _handler(service: MeshyServer) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            self.content = self.rfile.read(int(self.headers["content-length"]))
            self._answer("create")

        def do_GET(self) -> None:
            self._answer("file" if self.path.startswith("/files/") else "look")

        def _answer(self, what: str) -> None:
            service.asked.append(what)
            service.keys.append(self.headers["authorization"])
            faults = service.faults.get(what)
            if faults:
                faults.pop(0)(self)
            elif what != "file" and self.headers["authorization"] != f"Bearer {KEY}":
                says(self, {"message": f"Invalid API key {self.headers['authorization']}"}, 401)
            elif what == "create":
                self._create()
            else:
                self._of_task(what, self.path.partition("?")[0].rpartition("/")[2].removesuffix(".glb"))

        def _create(self) -> None:
            try:
                says(self, {"result": service.create(json.loads(self.content), self.path)}, 202)
            except RefusedError as error:
                says(self, {"message": error.args[1]}, error.args[0])

        def _of_task(self, what: str, task: str) -> None:
            held = service.tasks.get(task)
            if held is None or (what == "look" and not self.path.startswith(f"{held['path']}/")):
                says(self, {"message": "Task not found"}, 404)
            elif what == "look":
                says(self, service.task(task))
            else:
                assert self.headers["authorization"] is None, "the key must not go to where results lie"
                says(self, service.texture(held["glb"]) if "glb" in held else service.model, kind="model/gltf-binary")

        def log_message(self, *args: object) -> None:
            pass

    return Handler


def says(handler: BaseHTTPRequestHandler, body: Any, status: int = 200, kind: str = "application/json", **more: str) -> None:
    content = body if isinstance(body, bytes) else json.dumps(body).encode()
    handler.send_response(status)
    for name, value in {"content-type": kind, "content-length": str(len(content)), **more}.items():
        handler.send_header(name.replace("_", "-"), value)
    handler.end_headers()
    handler.wfile.write(content)


def refuses(status: int, message: str = "", **headers: str) -> Fault:
    return lambda handler: says(handler, {"message": message}, status, **headers)


def cuts(handler: BaseHTTPRequestHandler) -> None:
    """Promises more than it sends, and hangs up."""
    handler.close_connection = True
    handler.wfile.write(b"HTTP/1.1 200 OK\r\ncontent-type: application/octet-stream\r\ncontent-length: 5000\r\n\r\nglTF")
