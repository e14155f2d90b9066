"""A server on the loopback address that speaks the wire format of Meshy's retexture service, and fails as asked."""

import base64
import json
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

PATH = "/openapi/v1/retexture"
KEY = "msy_marker7f3aQ2vXk9LmN4pR8sT1uW6yZ0bC5dE"
SIGNATURE = "Signature=marker-5d1e"  # of the address of a result: it must be found nowhere either
Fault = Callable[[BaseHTTPRequestHandler], None]


@dataclass
class MeshyServer:
    """Tasks run through `steps`. `texture` makes the result of the GLB that was sent. Faults are used up in their order, by
    what is asked: "create", "look", "list" or "file"."""

    steps: list[dict[str, Any]] = field(default_factory=lambda: [{"status": "PENDING"}, {"status": "IN_PROGRESS"}])
    last: dict[str, Any] = field(default_factory=lambda: {"status": "SUCCEEDED", "progress": 100, "consumed_credits": 10})
    texture: Callable[[bytes], bytes] = lambda glb: glb
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

    def create(self, body: dict[str, Any]) -> str:
        task = f"018a210d-8ba4-705c-b111-{len(self.tasks):012d}"
        head, _, data = body["model_url"].partition(",")
        assert head == "data:application/octet-stream;base64"
        self.tasks[task] = {**body, "glb": base64.b64decode(data, validate=True), "looked": 0}
        return task

    def task(self, task: str) -> dict[str, Any]:
        held = self.tasks[task]
        steps = [*self.steps, self.last]
        now = steps[min(held["looked"], len(steps) - 1)]
        held["looked"] += 1
        done = now["status"] == "SUCCEEDED"
        urls = {"glb": f"{self.url}/files/{task}.glb?Expires=1&{SIGNATURE}", "fbx": f"{self.url}/x.fbx"} if done else {}
        frame = {"id": task, "type": "retexture", "progress": 0, "created_at": 1692771650657, "task_error": {"message": ""}}
        return {**frame, "text_style_prompt": held["text_style_prompt"], "model_urls": urls, "texture_urls": [], **now}

    def start(self) -> ThreadingHTTPServer:
        server = ThreadingHTTPServer(("127.0.0.1", 0), _handler(self))
        server.daemon_threads, server.block_on_close = True, False
        self.url = f"http://127.0.0.1:{server.server_port}"
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        return server


def _handler(service: MeshyServer) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            self.content = self.rfile.read(int(self.headers["content-length"]))
            self._answer("create")

        def do_GET(self) -> None:
            path = self.path.partition("?")[0]
            self._answer("list" if path == PATH else "file" if path.startswith("/files/") else "look")

        def _answer(self, what: str) -> None:
            service.asked.append(what)
            service.keys.append(self.headers["authorization"])
            faults = service.faults.get(what)
            if faults:
                faults.pop(0)(self)
            elif what != "file" and self.headers["authorization"] != f"Bearer {KEY}":
                says(self, {"message": f"Invalid API key {self.headers['authorization']}"}, 401)
            elif what == "create":
                says(self, {"result": service.create(json.loads(self.content))}, 202)
            elif what == "list":
                rows = [{"id": t, "text_style_prompt": h["text_style_prompt"]} for t, h in service.tasks.items()]
                says(self, rows[::-1])
            else:
                self._of_task(what, self.path.partition("?")[0].rpartition("/")[2].removesuffix(".glb"))

        def _of_task(self, what: str, task: str) -> None:
            if task not in service.tasks:
                says(self, {"message": "Task not found"}, 404)
            elif what == "look":
                says(self, service.task(task))
            else:
                assert self.headers["authorization"] is None, "the key must not go to where results lie"
                says(self, service.texture(service.tasks[task]["glb"]), kind="model/gltf-binary")

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
