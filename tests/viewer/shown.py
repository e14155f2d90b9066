"""Folders and pages for the tests of what people look at."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
from assets import cabinet

from anymesh.export import ExportOptions, Format, write_asset
from anymesh.types import Asset, Exchange
from anymesh.types.exchange import Picture

VOID = {"meta", "img", "input", "br"}


def folder_of(asset: Asset, place: Path) -> Path:
    """The asset as `anymesh articulate` leaves it, of the formats the GLB alone."""
    place.mkdir(parents=True)
    write_asset(asset, place, ExportOptions(formats=(Format.GLB,)))
    return place


def asked(png: bytes, *, text: str = "Which parts move?", verdict: str = "accepted") -> Exchange:
    return Exchange(
        "recognize", "0" * 64, "test:model", text, (Picture(png, "view 1"),), '{"a": 1}', verdict, 10, 5, 0.0, False, 0.1
    )


def hostile() -> Asset:
    """A cabinet whose words would be markup if they were not escaped; the names that are made legal on export aside."""
    bad = "</script><script>window.hacked = 1</script><img src=x onerror='window.hacked = 2'>"
    asset = cabinet(warnings=(f"warning {bad}", "right\u202eleft"))
    parts = tuple(replace(p, label=f"{p.label}{bad}", reason=f'reason"{bad}') for p in asset.segmentation.parts)
    joints = tuple(replace(j, reason=f"because{bad}") for j in asset.joints)
    return replace(asset, segmentation=replace(asset.segmentation, parts=parts), joints=joints)


class Page(HTMLParser):
    """What a browser would make of a page: elements, words, data; open elements left at the end are a fault."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.words: dict[str, str] = {}  # of the innermost element's tag
        self.data: dict[str, str] = {}  # id -> content of script elements
        self.scripts: list[str] = []
        self.open: list[str] = []
        self._script: str | None = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.elements.append((tag, found))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "script":
            self._script = found.get("id")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, f"{tag} closes something else"

    def handle_data(self, data):
        inside = self.open[-1] if self.open else ""
        if inside == "script":
            if self._script is None:
                self.scripts.append(data)
            else:
                self.data[self._script] = self.data.get(self._script, "") + data
        else:
            self.words[inside] = self.words.get(inside, "") + data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [found for name, found in self.elements if name == tag]

    def glb(self, number: int) -> bytes:
        return gzip.decompress(base64.b64decode(self.data[f"glb-{number}"]))

    def scene(self, number: int) -> dict:
        return json.loads(self.data[f"scene-{number}"])

    def policy(self) -> dict[str, list[str]]:
        told = next(m["content"] for m in self.all("meta") if m.get("http-equiv") == "Content-Security-Policy")
        return {rule.split()[0]: rule.split()[1:] for rule in str(told).split(";")}

    def addresses(self) -> list[str]:
        """Whatever an element would load or lead to."""
        names = ("src", "href", "srcset", "action", "data", "poster", "srcdoc")
        return [str(found[n]) for _, found in self.elements for n in names if found.get(n)]


def script_hash(script: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


def picture(color: tuple[int, int, int], size: int = 32) -> bytes:
    from anymesh.rendering.render import encode

    return encode(np.full((size, size, 3), color, np.uint8)).png


def styles(text: str) -> str:
    return "".join(re.findall(r"<style>(.*?)</style>", text, re.S))
