"""No way out: a test that reaches beyond this machine fails."""

import socket

import pytest


def guard(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let connections and look-ups of names be to the loopback address only."""
    real_connect, real_lookup = socket.socket.connect, socket.getaddrinfo

    def connect(self: socket.socket, address: tuple) -> None:
        assert self.family == socket.AF_UNIX or address[0] in ("127.0.0.1", "::1"), f"a test reaches out to {address}"
        real_connect(self, address)

    def lookup(host: str | bytes | None, *args: object, **options: object) -> list:
        assert host in ("127.0.0.1", "localhost", b"127.0.0.1"), f"a test asks for the address of {host!r}"
        return real_lookup(host, *args, **options)

    monkeypatch.setattr(socket.socket, "connect", connect)
    monkeypatch.setattr(socket, "getaddrinfo", lookup)
