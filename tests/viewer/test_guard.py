"""The live page answers browsers at its own address only, and nothing outside its own files."""

from __future__ import annotations

import http.client
from collections.abc import Iterator

import pytest

from anymesh.viewer.server_ import is_permitted


@pytest.mark.parametrize(
    ("host", "origin", "fine"),
    [
        ("127.0.0.1:8080", None, True), ("localhost:8080", "http://localhost:8080", True), ("[::1]:8080", None, True),
        ("127.0.0.1:8080", "http://127.0.0.1:8080", True), ("evil.example:8080", None, False), (None, None, False),
        ("evil.example", "http://evil.example", False), ("127.0.0.1:8080", "https://evil.example", False),
        ("127.0.0.1:8080", "null", False), ("127.0.0.1:8080", "http://127.0.0.1:9999", False), ("[bad", None, False),
        ("127.0.0.1.evil.example", None, False),
    ],
)  # fmt: skip
def test_who_may_speak_to_the_page(host, origin, fine) -> None:
    assert is_permitted(host, origin, bound="127.0.0.1") is fine


def test_a_page_that_is_bound_to_a_network_keeps_to_its_own_origin() -> None:
    assert is_permitted("box.lan:80", "http://box.lan:80", bound="0.0.0.0")
    assert not is_permitted("box.lan:80", "http://evil.example", bound="0.0.0.0")


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    pytest.importorskip("viser")
    from anymesh.viewer.server_ import start_server

    server = start_server("127.0.0.1", 18473, "test")
    yield server.get_port()
    server.stop()


def status(port: int, path: str = "/", **headers: str) -> int:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.request("GET", path, headers=headers)
    return connection.getresponse().status


def test_a_real_server_refuses_strangers_and_paths_that_lead_out(port) -> None:
    upgrade = {
        "Upgrade": "websocket",
        "Connection": "Upgrade",
        "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "a" * 22 + "==",
    }
    assert status(port) == 200
    assert status(port, Host="evil.example") == 403
    assert status(port, Origin="https://evil.example") == 403
    assert status(port, Origin="https://evil.example", **upgrade) == 403
    assert status(port, Origin=f"http://127.0.0.1:{port}", **upgrade) == 101
    for path in ("/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/..%5c..%5cetc/passwd"):
        assert status(port, path) == 404
