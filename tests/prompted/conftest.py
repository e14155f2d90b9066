"""A service on the loopback address, keys that can be found again, and no way out."""

import os
import ssl
from collections.abc import Callable, Iterator

import pytest
from dialects import DIALECTS, Dialect
from model_wire import SECRET, Service

from anymesh.prompted.models.vision import VisionModel


@pytest.fixture
def service(monkeypatch: pytest.MonkeyPatch, loopback_only: None) -> Iterator[Service]:
    """Every provider's client is redirected to it; each key is another one."""
    # No TLS here, and reading the certificates is most of what a client's start takes.
    monkeypatch.setattr(ssl.SSLContext, "load_verify_locations", lambda *_, **__: None)
    found = Service()
    server = found.start()
    for name in [
        n for n in os.environ if n.startswith(("OPENAI_", "ANTHROPIC_", "GOOGLE_", "GEMINI_")) or "PROXY" in n.upper()
    ]:
        monkeypatch.delenv(name)
    for provider, dialect in DIALECTS.items():
        monkeypatch.setenv(dialect.key, f"{SECRET}-{provider.removesuffix('-responses')}")
        if dialect.base:
            monkeypatch.setenv(dialect.base, found.url + ("/v1" if dialect.base == "OPENAI_BASE_URL" else ""))
    yield found
    found.over.set()
    server.shutdown()
    server.server_close()


@pytest.fixture(params=DIALECTS.values(), ids=DIALECTS)
def dialect(request: pytest.FixtureRequest) -> Dialect:
    return request.param


@pytest.fixture
def connected(service: Service) -> Callable[..., VisionModel]:
    """The model of a name or a dialect, redirected to the service."""
    pytest.importorskip("pydantic_ai")
    from anymesh.prompted.models.pydantic_ai_ import connect

    def make(name: str | Dialect, timeout: float = 4.0) -> VisionModel:
        return connect((name if isinstance(name, str) else name.name).replace("URL", service.url), timeout=timeout)

    return make
