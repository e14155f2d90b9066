"""The elements of a PLY file as columns of numbers, from ASCII and from binary of both byte orders."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.checks import check_count

TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"), **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"), **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"), **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"), **dict.fromkeys(("double", "float64"), "f8"),
}  # fmt: skip


@dataclass
class Element:
    """One element of the header.

    properties: name, type, and the type of the count if it is a list.
    """

    name: str
    count: int
    properties: list[tuple[str, str, str | None]] = field(default_factory=list)


Ragged = tuple[np.ndarray, np.ndarray]  # all numbers of a list property one after another, and the count of each row
Columns = dict[str, np.ndarray | Ragged]


def parse_header(name: str, data: bytes) -> tuple[list[Element], str, list[str], bytes]:
    """Return the elements, the format, the comments, and the bytes after the header.

    Raise InputError if the header is not valid.
    """
    end = data.find(b"end_header")
    newline = data.find(b"\n", end)
    if end < 0 or newline < 0:
        raise InputError(f"{name} is truncated: found no end_header, with which a PLY header ends")
    elements: list[Element] = []
    comments, style = [], ""
    for line in data[:end].decode("utf-8", "replace").splitlines()[1:]:
        match line.split():
            case ["format", kind, *_]:
                style = kind
            case ["comment" | "obj_info", *_]:
                comments.append(line.split(None, 1)[-1])
            case ["element", label, count] if count.isdecimal():
                elements.append(Element(label, int(count)))
            case ["property", "list", count, kind, label] if elements and count in TYPES and kind in TYPES:
                elements[-1].properties.append((label, TYPES[kind], TYPES[count]))
            case ["property", kind, label] if elements and kind in TYPES:
                elements[-1].properties.append((label, TYPES[kind], None))
            case []:
                pass
            case _:
                raise InputError(f"{name}: found {line[:80]!r} in the header; valid are format, comment, element and property")
    if style not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise InputError(f"{name}: found the format {style!r}; valid are ascii, binary_little_endian, binary_big_endian")
    return elements, style, comments, data[newline + 1 :]


def read_elements(name: str, elements: list[Element], style: str, body: bytes) -> dict[str, Columns]:
    """Return the columns of every element.

    Raise InputError if the body is shorter than the header states.
    """
    if style == "ascii":  # converted to binary with one wide type
        body = np.array(body.split(), np.float64).tobytes()
        for e in elements:
            e.properties = [(label, "f8", count and "f8") for label, _, count in e.properties]
    order = ">" if style == "binary_big_endian" else "<"
    columns, at = {}, 0
    for element in elements:
        least = sum(np.dtype(count or kind).itemsize for _, kind, count in element.properties)
        if element.properties:
            check_count(name, f"elements {element.name!r}", element.count, (len(body) - at) // least)
            columns[element.name], at = _element(name, element, order, body, at)
    return columns


def _element(name: str, element: Element, order: str, body: bytes, at: int) -> tuple[Columns, int]:
    """Return the columns of one element whose bytes start at `at`, and their end."""
    lengths = _lengths(element, order, body, at)
    row = np.dtype(_fields(element, order, lengths))
    if element.count and at + row.itemsize * element.count <= len(body):
        table: Any = np.frombuffer(body, row, element.count, at)
        lists = [label for label, _, count in element.properties if count]
        if all((table[f"{label} count"] == lengths[label]).all() for label in lists):
            columns: Columns = {label: table[label] for label, _, _ in element.properties}
            for label in lists:
                columns[label] = (table[label].reshape(-1), np.full(element.count, lengths[label], np.int64))
            return columns, at + row.itemsize * element.count
    return _rows(name, element, order, body, at)


def _lengths(element: Element, order: str, body: bytes, at: int) -> dict[str, int]:
    """Return the lengths of the lists of the first row."""
    lengths = {}
    for label, kind, count in element.properties:
        if count is not None:
            width = np.dtype(count).itemsize
            stated = np.frombuffer(body[at : at + width], order + count) if at + width <= len(body) else [0]
            lengths[label] = int(stated[0]) if len(stated) and 0 <= stated[0] < 1 << 24 else 0
            at += width + lengths[label] * np.dtype(kind).itemsize
        else:
            at += np.dtype(kind).itemsize
    return lengths


def _fields(element: Element, order: str, lengths: dict[str, int]) -> list[tuple]:
    fields: list[tuple] = []
    for label, kind, count in element.properties:
        if count is not None:
            fields.append((f"{label} count", order + count))
            fields.append((label, order + kind, (lengths[label],)))
        else:
            fields.append((label, order + kind))
    return fields


def _rows(name: str, element: Element, order: str, body: bytes, at: int) -> tuple[Columns, int]:
    """Read row by row, for lists of different lengths."""
    plain: list[tuple[str, np.dtype, np.dtype | None]]
    plain = [
        (label, np.dtype(order + kind), np.dtype(order + count) if count else None) for label, kind, count in element.properties
    ]
    chunks: dict[str, list[bytes]] = {label: [] for label, _, _ in plain}
    counts: dict[str, list[int]] = {label: [] for label, _, _ in plain}
    for row in range(element.count):
        for label, kind, count in plain:
            length = 1.0
            if count is not None:
                length = (
                    float(np.frombuffer(body[at : at + count.itemsize], count)[0]) if at + count.itemsize <= len(body) else -1
                )
                at += count.itemsize
            if not 0 <= length * kind.itemsize <= len(body) - at:  # also false for NaN
                raise InputError(f"{name} is truncated: {element.name!r} {row + 1} of {element.count} is incomplete")
            end = at + int(length) * kind.itemsize
            chunks[label].append(body[at:end])
            counts[label].append(int(length))
            at = end
    columns: Columns = {}
    for label, kind, count in plain:
        values = np.frombuffer(b"".join(chunks[label]), kind)
        columns[label] = values if count is None else (values, np.array(counts[label], np.int64))
    return columns, at
