"""Retexturing by Meshy: a paid task is created once, waited for, and resumed by a rerun."""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass

from anymesh.errors import ModelError, OptionError
from anymesh.finishing.meshy_api import RETEXTURE, read_key
from anymesh.finishing.meshy_paid import Order, PaidTasks

LONGEST_PROMPT = 600  # characters
LARGEST_MODEL = 100_000_000  # [bytes] of a model sent as a data URI


def check_prompt(prompt: str) -> str:
    """Return the prompt without surrounding spaces. Raise OptionError if the service does not accept it."""
    text = prompt.strip()
    if not 0 < len(text) <= LONGEST_PROMPT:
        raise OptionError(f"a texture prompt has 1 to {LONGEST_PROMPT} characters, found {len(text)}")
    return text


@dataclass
class Meshy(PaidTasks):
    """Client that retextures a GLB."""

    def retexture(self, glb: bytes, prompt: str) -> bytes:
        """Return the GLB with new textures, on its existing texture coordinates.

        Raise ModelError without a key or a result, BudgetError before a task beyond the limit, OptionError for a prompt that is
        not valid, OutputError if the task's id cannot be stored.
        """
        prompt = check_prompt(prompt)
        read_key()  # report a missing key before packing the data
        order = Order(RETEXTURE, self._body(glb, prompt), self.state, prompt)
        return self.fetch(order, self.run(order).task)

    def _body(self, glb: bytes, prompt: str) -> bytes:
        uri = "data:application/octet-stream;base64," + base64.b64encode(glb).decode("ascii")
        if len(uri) > LARGEST_MODEL:
            raise ModelError(f"meshy: the model takes {len(uri)} bytes to send, at most {LARGEST_MODEL} are accepted")
        asked = {"ai_model": self.model, "enable_original_uv": True, "enable_pbr": True}
        return json.dumps({"model_url": uri, "text_style_prompt": prompt, **asked}).encode()
