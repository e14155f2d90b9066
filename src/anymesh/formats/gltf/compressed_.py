"""Compressed data of glTF: Draco by its own library, and meshopt by the bitstream of EXT_ and KHR_meshopt_compression.

The counts that the data states are bounded before anything is decoded.
"""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from jaxtyping import Int

from anymesh.formats.advice import advise
from anymesh.formats.gltf.buffers import MAX_DECODED, DataError
from anymesh.loading.files import MAX_FACES

DRACO_METADATA = 0x8000  # flag of the header
EDGEBREAKER = 1
BITS = ((0, 2, 4, 8), (0, 1, 2, 4), (1, 2, 4, 8))  # per delta, by the two bits of a group: version 0; version 1, controls 0, 1
# Number of the deltas of a byte that are stored after the group, since all their bits are set
LATER = {
    bits: bytes(sum((b >> s) % (1 << bits) == (1 << bits) - 1 for s in range(0, 8, bits)) for b in range(256))
    for bits in (1, 2, 4)
}
GROUP = 16  # deltas


def draco_attributes(data: bytes, ids: dict[str, int]) -> tuple[dict[str, np.ndarray], Int[np.ndarray, " n"]]:
    """Return the attributes by name, and the indices of a Draco mesh. Raise DataError if it is not valid.

    ids: the unique id of each attribute in the data.
    """
    try:
        import DracoPy  # ty: ignore[import-not-found]
    except ImportError:  # no wheel for Macs with Intel processors
        raise DataError(advise("draco")) from None
    if max(counts := _draco_counts(data)) > 3 * MAX_FACES:
        raise DataError(f"its Draco data states {max(counts)} vertices or triangles; at most {3 * MAX_FACES} are read")
    try:
        mesh = DracoPy.decode(data)
        by_id = {a["unique_id"]: np.asarray(a["data"]).reshape(-1, a["num_components"]) for a in mesh.attributes}
        index = np.asarray(mesh.faces, np.int64).reshape(-1)
    except Exception as error:  # the library raises types of its own, and those of numpy
        raise DataError(f"its Draco data is broken or truncated ({type(error).__name__})") from None
    if missing := [key for key, number in ids.items() if number not in by_id]:
        raise DataError(f"its Draco data lacks {', '.join(missing)}")
    return {key: by_id[number] for key, number in ids.items()}, index


def _draco_counts(data: bytes) -> tuple[int, int]:
    """Return the numbers of vertices and triangles, in either order, that the header of a Draco mesh states."""
    try:
        magic, *version, kind, method, flags = struct.unpack_from("<5sBBBBH", data)
        if magic != b"DRACO" or kind != 1 or flags & DRACO_METADATA:
            raise DataError("its Draco data does not begin as that of a mesh")
        at = 11 + (method == EDGEBREAKER)
        if version < [2, 2]:
            return struct.unpack_from("<II", data, at)
        first, at = _varint(data, at)
        return first, _varint(data, at)[0]
    except (struct.error, IndexError):
        raise DataError("its Draco data is truncated") from None


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """Return an integer of 7 bits a byte, low ones first, and the place after it."""
    value = shift = 0
    while shift < 35:
        byte = data[at]
        value |= (byte & 127) << shift
        at, shift = at + 1, shift + 7
        if byte < 128:
            return value, at
    raise DataError("its compressed data has a number of more than 32 bits")


def meshopt(data: bytes, view: dict[str, Any]) -> bytes:
    """Return the bytes of a buffer view that is compressed by meshopt. Raise DataError if they are not valid."""
    count, stride, mode, filter_name = view["count"], view["byteStride"], view["mode"], view.get("filter", "NONE")
    valid = {"ATTRIBUTES": range(4, 257, 4), "TRIANGLES": (2, 4), "INDICES": (2, 4)}
    if type(count) is not int or mode not in valid or stride not in valid[mode] or not 0 <= count * stride <= MAX_DECODED:
        raise DataError(f"its meshopt data states {count} elements of {stride} bytes, mode {mode}; at most {MAX_DECODED} bytes")
    if count == 0:
        return b""
    try:
        if mode == "ATTRIBUTES":
            return FILTERS[filter_name](_vertices(data, count, stride)).tobytes()
        index = _triangles(data, count) if mode == "TRIANGLES" else _sequence(data, count)
        return np.array(index, np.int64).astype(np.uint32).astype("<u2" if stride == 2 else "<u4").tobytes()
    except (IndexError, KeyError, ValueError, OverflowError) as error:
        raise DataError(f"its meshopt data is broken or truncated ({type(error).__name__})") from None


def _vertices(data: bytes, count: int, stride: int) -> np.ndarray:
    """Return (count, stride) bytes: groups of 16 deltas of one byte of consecutive elements, in blocks."""
    version = data[0] - 0xA0
    if version not in (0, 1):
        raise ValueError("another codec")
    block = min(8192 // stride & ~15, 256)
    tail = stride + (stride // 4 if version else 0)
    deltas = np.zeros((stride, -(-count // GROUP) * GROUP), np.uint8)
    groups: dict[int, list[tuple[int, int]]] = {1: [], 2: [], 4: [], 8: []}  # by bits: place in deltas and in data
    at, end = 1, len(data) - max(tail, 24 if version else 32)
    for first in range(0, count, block):
        here = min(block, count - first)
        number = -(-here // GROUP)
        controls, at = at, at + (stride // 4 if version else 0)
        for byte in range(stride):
            start = byte * deltas.shape[1] + first
            control = data[controls + byte // 4] >> byte % 4 * 2 & 3 if version else -1
            if control == 3:
                deltas[byte, first : first + here] = np.frombuffer(data, np.uint8, here, at)
                at += here
            if control >= 2:
                continue
            heads, at = at, at + -(-number // 4)
            for group in range(number):
                bits = BITS[control + 1][data[heads + group // 4] >> group % 4 * 2 & 3]
                if bits:
                    groups[bits].append((start + group * GROUP, at))
                    size = 2 * bits
                    at += size if bits == 8 else size + sum(data[at : at + size].translate(LATER[bits]))
        if at > end:
            break
    if at != end:
        raise ValueError("another length")
    for bits, places in groups.items():
        if places:
            _unpack(deltas.reshape(-1), np.frombuffer(data, np.uint8), np.array(places), bits)
    base = np.frombuffer(data, np.uint8, stride, len(data) - tail)
    channels = data[len(data) - tail + stride :] if version else bytes(stride // 4)
    return _summed(deltas[:, :count], base, channels)


def _unpack(deltas: np.ndarray, data: np.ndarray, places: np.ndarray, bits: int) -> None:
    """Write the deltas of all groups that have the same number of bits."""
    to, at = places.T
    packed = data[at[:, None] + np.arange(2 * bits)]
    if bits < 8:
        shifts = np.arange(0, 8, bits, dtype=np.uint8)
        packed = (packed[:, :, None] >> (shifts if bits == 1 else shifts[::-1]) & ((1 << bits) - 1)).reshape(-1, GROUP)
        later = packed == (1 << bits) - 1
        follows = (at + 2 * bits)[:, None] + np.cumsum(later, 1) - 1
        packed = np.where(later, data[np.minimum(follows, len(data) - 1)], packed)
    deltas[to[:, None] + np.arange(GROUP)] = packed


def _summed(deltas: np.ndarray, base: np.ndarray, channels: bytes) -> np.ndarray:
    """Return the (count, stride) values of deltas (stride, count), by the kind of each channel of four bytes."""
    out = np.empty((deltas.shape[1], len(base)), np.uint8)
    for k, channel in enumerate(channels):
        kind = {0: "<u1", 1: "<u2", 2: "<u4"}[channel & 3]
        d = np.ascontiguousarray(deltas[4 * k : 4 * k + 4].T).view(kind)
        first = base[4 * k : 4 * k + 4].copy().view(kind)
        if channel & 3 == 2:
            turn = channel >> 4
            d = d >> np.uint32(turn) | (d << np.uint32(32 - turn) if turn else np.uint32(0))
            values = np.bitwise_xor.accumulate(d, 0) ^ first
        else:
            d = d >> 1 ^ (-(d & 1).astype(np.int64)).astype(d.dtype)
            values = np.cumsum(d, 0, dtype=d.dtype) + first
        out[:, 4 * k : 4 * k + 4] = values.astype(kind).view(np.uint8)
    return out


class _IndexCode:
    """What the codes of triangles refer to: the next new vertex, the last stored one, and recent ones, the newest last."""

    def __init__(self, data: bytes, count: int) -> None:
        self.data, self.at, self.table = data, 1 + count // 3, data[-16:]
        self.following = self.last = self.newest = 0
        self.recent = [0] * 16

    def new(self) -> int:
        """Return the next new vertex."""
        self.following += 1
        return self.following - 1

    def stored(self) -> int:
        """Return a vertex that is stored as the difference from the last one."""
        delta, self.at = _varint(self.data, self.at)
        self.last += delta >> 1 ^ -(delta & 1)
        return self.last

    def push(self, vertex: int) -> None:
        """Make a vertex the most recent one."""
        self.recent[self.newest & 15] = vertex
        self.newest += 1

    def separate(self, low: int) -> list[int]:
        """Return the corners of a triangle that shares no recent edge."""
        stored = low >= 14
        if stored:
            codes, self.at = self.data[self.at], self.at + 1
            self.following = 0 if codes == 0 else self.following
        else:
            codes = self.table[low]
        corners, fresh = [], []
        for code in (15 if low == 15 else 0, codes >> 4, codes & 15):
            if code == 0 or (code == 15 and stored):
                corners.append(self.stored() if code else self.new())
                fresh.append(corners[-1])
            else:
                corners.append(self.recent[self.newest - code & 15])
        for vertex in fresh:
            self.push(vertex)
        return corners


def _triangles(data: bytes, count: int) -> list[int]:
    """Return the indices of triangles, each coded by recent edges and vertices."""
    if data[0] != 0xE1 or count % 3:
        raise ValueError("another codec")
    code, edges, edge = _IndexCode(data, count), [(0, 0)] * 16, 0
    out: list[int] = []
    for byte in data[1 : 1 + count // 3]:
        high, low = byte >> 4, byte & 15
        if high < 15:
            a, b = edges[edge - 1 - high & 15]
            if 0 < low < 13:
                c = code.recent[code.newest - 1 - low & 15]
            else:
                code.last += 2 * low - 27 if 0 < low < 15 else 0
                c = code.new() if low == 0 else code.stored() if low == 15 else code.last
                code.push(c)
            pushed = ((c, b), (a, c))
        else:
            a, b, c = code.separate(low)
            pushed = ((b, a), (c, b), (a, c))
        for pair in pushed:
            edges[edge & 15] = pair
            edge += 1
        out += (a, b, c)
    if len(out) != count or code.at != len(data) - 16:
        raise ValueError("another length")
    return out


def _sequence(data: bytes, count: int) -> list[int]:
    """Return indices that are coded as differences from one of the two last ones."""
    if data[0] != 0xD1:
        raise ValueError("another codec")
    at, last, out = 1, [0, 0], []
    for _ in range(count):
        value, at = _varint(data, at)
        last[value & 1] += value >> 2 ^ -(value >> 1 & 1)
        out.append(last[value & 1])
    if at != len(data) - 4:
        raise ValueError("another length")
    return out


def _octahedral(values: np.ndarray) -> np.ndarray:
    v = values.view(f"<i{values.shape[1] // 4}").copy()
    full = float(np.iinfo(v.dtype).max)
    x, y = (v[:, :2] / np.maximum(v[:, 2:3], 1)).T
    z = 1 - abs(x) - abs(y)
    t = np.maximum(-z, 0)
    n = np.stack([x - np.where(x >= 0, t, -t), y - np.where(y >= 0, t, -t), z], 1)
    v[:, :3] = np.rint(n / np.linalg.norm(n, axis=1, keepdims=True) * full)
    return v


def _quaternion(values: np.ndarray) -> np.ndarray:
    v = values.view("<i2")
    greatest = v[:, 3] & 3
    xyz = v[:, :3] * (np.sqrt(0.5) / (v[:, 3:] | 3))
    w = np.sqrt(np.maximum(0, 1 - (xyz**2).sum(1, keepdims=True)))
    places = (greatest[:, None].astype(np.int64) + np.array([1, 2, 3, 0])) % 4
    out = np.empty(v.shape, "<i2")
    np.put_along_axis(out, places, np.rint(np.hstack([xyz, w]) * 32767).astype("<i2"), 1)
    return out


def _exponential(values: np.ndarray) -> np.ndarray:
    v = values.view("<i4")
    return np.ldexp(((v << 8) >> 8).astype(np.float64), v >> 24).astype("<f4")


def _color(values: np.ndarray) -> np.ndarray:
    size = values.shape[1] // 4
    v, signed = values.view(f"<u{size}").astype(np.int64), values.view(f"<i{size}").astype(np.int64)
    y, co, cg, alpha = v[:, 0], signed[:, 1], signed[:, 2], v[:, 3]
    full = (1 << np.frexp(alpha.astype(np.float64))[1]) - 1
    a = alpha & full >> 1
    rgba = np.stack([y + co - cg, y + cg, y - co - cg, a << 1 | a & 1], 1)
    most = (1 << 8 * size) - 1
    return np.clip(np.rint(rgba * (most / np.maximum(full, 1))[:, None]), 0, most).astype(f"<u{size}")


FILTERS = {
    "NONE": lambda values: values,
    "OCTAHEDRAL": _octahedral,
    "QUATERNION": _quaternion,
    "EXPONENTIAL": _exponential,
    "COLOR": _color,
}
