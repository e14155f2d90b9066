"""Names of vision-language models: the provider, the model, and the environment variables of the key."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from urllib.parse import urlsplit

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.models.servers import SERVERS

VALID = (
    "openai:MODEL, openai-responses:MODEL, anthropic:MODEL, google:MODEL, ollama:MODEL, lmstudio:MODEL, vllm:MODEL, "
    "openai-compatible:BASE_URL#MODEL, files:FOLDER or replay:FOLDER"
)
KEYS = {  # environment variables that may hold the key; the first one that is set is used
    "openai": ("OPENAI_API_KEY",),
    "openai-responses": ("OPENAI_API_KEY",),  # the same models through the newer of OpenAI's two interfaces
    "anthropic": ("ANTHROPIC_API_KEY",),
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "openai-compatible": ("ANYMESH_API_KEY",),  # never OpenAI's key: it must not be sent to another operator's server
    **{name: server.keys for name, server in SERVERS.items()},
}
BASES = {
    "openai": "OPENAI_BASE_URL",
    "openai-responses": "OPENAI_BASE_URL",
    "anthropic": "ANTHROPIC_BASE_URL",
    "google": "GOOGLE_GEMINI_BASE_URL",
}
NO_KEY = "no-key"  # placeholder sent to servers that need no key, since the client requires one


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
