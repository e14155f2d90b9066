"""Usual sizes of kinds of objects, as scale for files without a unit or with an implausible one.

The sizes are the longest side of the closed object [m]; a kind is a word of the category or of the file's name. The values are
estimates for common objects. Sweet Home 3D 7.0.2's catalogue states sizes for 26 of the kinds. Its medians are within a factor
of 1.5 of the values for 24, and of 2.5 for a box and a fridge. A size is accepted within a factor of 3.
"""

from __future__ import annotations

import re
from itertools import pairwise

LONGEST = {
    "airplane": 12.0, "bed": 2.1, "bench": 1.5, "bicycle": 1.75, "blender": 0.4, "bookcase": 1.8, "bookshelf": 1.8,
    "bottle": 0.25, "box": 0.4, "bucket": 0.32, "cabinet": 1.0, "camera": 0.14, "car": 4.4, "chair": 0.95, "chest": 0.9,
    "clock": 0.3, "coffee_machine": 0.4, "computer": 0.45, "cooker": 0.9, "crate": 0.5, "cupboard": 1.2, "desk": 1.4,
    "dishwasher": 0.85, "door": 2.05, "drawer": 0.6, "dresser": 1.2, "dryer": 0.85, "eyeglasses": 0.15, "fan": 0.5,
    "faucet": 0.3, "freezer": 1.6, "fridge": 1.75, "glasses": 0.15, "globe": 0.4, "guitar": 1.0, "hinge": 0.1,
    "kettle": 0.25, "keyboard": 0.45, "knife": 0.3, "lamp": 0.6, "laptop": 0.36, "lighter": 0.08, "lock": 0.08,
    "microwave": 0.5, "monitor": 0.6, "motorcycle": 2.1, "mouse": 0.12, "mug": 0.12, "microwave_oven": 0.5, "oven": 0.6,
    "pen": 0.14, "phone": 0.15, "piano": 1.5, "pliers": 0.2, "pot": 0.3, "printer": 0.5, "range": 0.9, "refrigerator": 1.75,
    "remote": 0.2, "safe": 0.5, "scissors": 0.2, "shelf": 1.2, "sideboard": 1.6, "sink": 0.8, "sofa": 2.0, "stapler": 0.15,
    "stool": 0.6, "stove": 0.9, "suitcase": 0.65, "switch": 0.08, "table": 1.2, "television": 1.1, "toaster": 0.32,
    "toilet": 0.75, "trash": 0.6, "truck": 7.0, "tv": 1.1, "usb": 0.06, "van": 5.0, "wardrobe": 2.1, "washer": 0.85,
    "washing_machine": 0.85, "wheelchair": 1.05, "window": 1.3,
}  # fmt: skip
SMALLER = {"toy", "model", "mini", "miniature", "dollhouse"}  # words that mean that the usual size does not apply
BELIEVED_FACTOR = 3.0  # a size is accepted within this factor of the usual one


def usual_size(words: str) -> tuple[str, float] | None:
    """Return the kind named by a category or a file's name, and its usual longest side [m]; None if no kind is known.

    The last word that is a kind counts, since a table lamp is a lamp.
    """
    tokens = [w.lower() for w in re.findall(r"[A-Za-z]+", re.sub(r"([a-z])([A-Z])", r"\1 \2", words))]
    if SMALLER & set(tokens):
        return None
    pairs = [f"{a}_{b}" for a, b in pairwise(tokens)]
    known = [k for k in (*tokens, *pairs) if k in LONGEST]
    return (known[-1], LONGEST[known[-1]]) if known else None


def is_near(longest: float, usual: float) -> bool:
    """Return whether a longest side is plausible for objects of a usual size."""
    return usual / BELIEVED_FACTOR <= longest <= usual * BELIEVED_FACTOR
