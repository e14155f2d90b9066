"""Licence and author of a mesh: what its file states, and what files beside it do. All of it is text of strangers.

Read are glTF (`asset.copyright`, `asset.extras` as Sketchfab writes it, KHR_xmp_json_ld, VRM), DAE (`contributor`), 3MF
(`metadata`) and USD (`credits` of the layer, as it is written here), `NAME.license` as REUSE (reuse.software) has it,
`license.txt` as stores give it, and the JSON that Objaverse and Sketchfab's API give for a model.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from anymesh.loading.files import Folder

KEYS = {  # of credits, in their order, with the names of fields that hold each
    "title": ("title", "name", "dc:title", "Title"),
    "author": ("author", "authors", "creator", "user", "dc:creator", "Designer"),
    "license": ("license", "licence", "licenseName", "licenseUrl", "xmpRights:UsageTerms", "dc:rights", "LicenseTerms"),
    "source": ("source", "viewerUrl", "url", "dc:source"),
    "copyright": ("copyright", "copyrightInformation", "Copyright"),
}
WHERE = "found"  # key of the files and fields that the others were found in; "credit" is a line of all for display
OBJAVERSE = {  # its codes of licences, by its dataset card
    "by": "CC-BY-4.0", "by-nc": "CC-BY-NC-4.0", "by-nc-sa": "CC-BY-NC-SA-4.0", "by-sa": "CC-BY-SA-4.0", "cc0": "CC0-1.0",
}  # fmt: skip
INNER = ("label", "displayName", "username", "name", "@value", "@list", "@set", "rdf:_1", "slug")  # of objects
NAMED = ("{stem}.license", "{name}.license", "{stem}.license.txt", "{stem}_license.txt", "{stem}.json")
COMMON = ("license.txt", "License.txt", "LICENSE.txt", "LICENSE", "LICENSE.md", "license.md", "metadata.json")
LINES = {  # of a text, the first that matches counts; a value may stand on the next line
    "title": r"(?:title|name)\s*[:=]",
    "author": r"(?:(?:author|creator|artist)s?\s*[:=]|(?:created|made|modelled|designed|distributed)(?:/\w+)? by:?)",
    "license": r"(?:SPDX-License-Identifier|license type|licen[cs]e)\s*[:=]",
    "source": r"(?:source|url)\s*[:=]",
    "copyright": r"(?:SPDX-FileCopyrightText:|(?=copyright\s|©|\(c\)\s))",
}
PATTERNS = {key: re.compile(rf"(?im)^[^\w©(\n]{{0,20}}{start}\s{{0,20}}(\S.*)$") for key, start in LINES.items()}
EDITION = re.compile(r"(?i)version|universal|international|\d\.\d")
MAX_TEXT, MAX_JSON = 1 << 16, 1 << 22  # [bytes] of a text that are read, and of a JSON, above which it is left out
MAX_VALUE, MAX_DEPTH = 500, 4  # characters of a value; objects within each other that a field is looked for in
JOINERS = "\u200c\u200d"  # format characters that spelling needs


def plain(value: object) -> str:
    """Return a value as one line of text without control characters, of at most MAX_VALUE characters."""
    text = str(value)[: 8 * MAX_VALUE]
    kept = "".join(c if unicodedata.category(c)[0] != "C" or c in JOINERS else " " for c in text)
    line = " ".join(kept.split())
    return line if len(line) <= MAX_VALUE else f"{line[: MAX_VALUE - 3]}..."


def gltf_credits(tree: Mapping[str, Any]) -> dict[str, str]:
    """Return what a glTF document states of its licence and author."""
    asset, extensions = _object(tree.get("asset")), _object(tree.get("extensions"))
    xmp, packets = "KHR_xmp_json_ld", _object(extensions.get("KHR_xmp_json_ld")).get("packets")
    number = _object(_object(asset.get("extensions")).get(xmp)).get("packet")
    known = isinstance(packets, list) and isinstance(number, int) and 0 <= number < len(packets)
    vrm = [_object(_object(extensions.get(name)).get("meta")) for name in ("VRMC_vrm", "VRM")]
    places = {
        "asset.copyright": {"copyright": asset.get("copyright")},
        "asset.extras": _object(asset.get("extras")),
        xmp: _object(packets[number]) if known else {},
        "VRM": vrm[0] or vrm[1],
    }
    return joined((place, fields(record)) for place, record in places.items())


def credits_in(place: str, record: Any) -> dict[str, str]:
    """Return the credits in the fields of an object of the file, which is called `place`."""
    return joined([(place, fields(_object(record)))])


def credits_of(folder: Folder) -> dict[str, str]:
    """Return the credits of a folder's mesh: those that its file states, then those of files beside it, nearest first.

    Licences that differ give a warning. Nothing outside the permitted root is read.
    """
    own, mesh = dict(folder.credits), folder.path
    names = dict.fromkeys(name.format(stem=mesh.stem, name=mesh.name) for name in NAMED)
    above = mesh.parent.resolve()
    places = [place for place in (above, *above.parents) if place.is_relative_to(folder.root)]
    paths = dict.fromkeys(place / name for place in places for name in (*names, *COMMON))
    beside = [(path.name, _read(path, folder)) for path in paths if path != mesh.resolve()]
    others = [(name, record["license"]) for name, record in beside if "license" in record]
    for name, licence in others:
        if own.get("license", others[0][1]) != licence:
            first = f"{own['license']!r} in the file" if "license" in own else f"{others[0][1]!r} in {others[0][0]}"
            folder.warn(f"the licence is {first}, and {licence!r} in {name}; the first is written")
    return joined([(own.pop(WHERE, ""), own), *beside])


def joined(places: Iterable[tuple[str, Mapping[str, str]]]) -> dict[str, str]:
    """Return credits of several places, each key of the first that has it, and which places those were."""
    result, where = dict[str, str](), []
    for place, record in places:
        fresh = {key: value for key, value in record.items() if key not in result and value}
        where += [place] if fresh else []
        result |= fresh
    line = result.get("copyright", "")
    for key in KEYS:
        line += f"{', ' if line else ''}{value}" if (value := result.get(key, "")) not in line else ""
    return {key: result[key] for key in KEYS if key in result} | (
        {"credit": plain(line), WHERE: plain(", ".join(where))} if where else {}
    )


def fields(record: Mapping[str, Any]) -> dict[str, str]:
    """Return the credits in the fields of an object; none if it names neither a licence nor an author."""
    texts = {}
    for key, names in KEYS.items():
        text = next((text for name in names if (text := _text(record.get(name)))), "")
        texts |= {key: OBJAVERSE.get(text, text) if key == "license" else text} if text else {}
    return texts if texts.keys() & {"license", "author", "copyright"} else {}


def _text(value: Any, depth: int = 0) -> str:
    """Return a field as text: of an object, the first of INNER and its address."""
    if isinstance(value, str):
        return plain(value)
    if depth > MAX_DEPTH or not isinstance(value, (list, dict)):
        return ""
    if isinstance(value, list):
        return plain(", ".join(text for v in value[:20] if (text := _text(v, depth + 1))))
    text = next((text for name in INNER if (text := _text(value.get(name), depth + 1))), "")
    address = _text(value.get("profileUrl") or value.get("url"), depth + 1)
    return plain(f"{text} ({address})" if text and address else text or address)


def _object(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _read(path: Path, folder: Folder) -> dict[str, str]:
    """Return the credits in a file beside the mesh; none if there is none, or if it leads out of the permitted root."""
    try:
        if not path.is_file() or not path.resolve().is_relative_to(folder.root):
            return {}
        with path.open("rb") as file:
            data = file.read(MAX_JSON + 1)
    except OSError:
        return {}
    if path.suffix != ".json":
        return of_text(data[:MAX_TEXT].decode("utf-8", "replace"))
    if len(data) > MAX_JSON:
        folder.warn(f"{path.name} has over {MAX_JSON >> 20} MB and is not read for a licence")
        return {}
    try:
        record = _object(json.loads(data))
    except (ValueError, RecursionError):
        return {}
    return fields(_object(record.get(folder.path.stem)) or record)


def of_text(text: str) -> dict[str, str]:
    """Return the credits in a text: its fields, else its first lines as the licence."""
    text = text.removeprefix("\ufeff").replace("\r", "\n")
    values = {key: plain(m[1].strip("\"' ")) for key, pattern in PATTERNS.items() if (m := pattern.search(text))}
    if "license" not in values:
        first, second = [*(line for line in map(plain, text[:MAX_VALUE].split("\n")) if line), "", ""][:2]
        values |= {"license": f"{first}, {second}" if second and EDITION.search(second) else first} if first else {}
    return {key: value for key, value in values.items() if value}
