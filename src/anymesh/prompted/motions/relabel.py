"""Labels of given parts, from the recognized labels by name or by an answer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from anymesh.types import Segmentation
from anymesh.vocabulary import words_of


def labels_by_name(segmentation: Segmentation, labels: Sequence[str]) -> Segmentation:
    """Give each part with an unrecognized label the recognized label that its name ends with ("rudder_left": rudder).

    Names are only compared here and never shown to an answerer. Of several labels, the one whose last word comes last in the
    name is used.
    """
    new_label = {}
    for number, part in enumerate(segmentation.parts[1:], start=1):
        if part.label not in labels:
            name = words_of(part.name)
            places = {label: _last_place(name, words_of(label)) for label in labels}
            best = max(places, key=lambda label: (places[label], len(label)), default=None)
            if best is not None and places[best] >= 0:
                new_label[number] = best
    return relabelled(segmentation, new_label, labels)


def relabelled(segmentation: Segmentation, answered: Mapping[int, str], labels: Sequence[str]) -> Segmentation:
    """Give parts, by number, the answered label if their own was not recognized.

    Return the same object if no label changes.
    """
    if not any(segmentation.parts[k].label not in labels for k in answered):
        return segmentation
    parts = [
        replace(part, label=answered[k]) if k in answered and part.label not in labels else part
        for k, part in enumerate(segmentation.parts)
    ]
    return replace(segmentation, parts=tuple(parts))


def unlabelled(segmentation: Segmentation, labels: Sequence[str]) -> bool:
    """Return whether labels were recognized and some part has none of them."""
    return bool(labels) and any(part.label not in labels for part in segmentation.parts[1:])


def _last_place(name: Sequence[str], label: Sequence[str]) -> int:
    """Return the index in a name of the last word of a label, -1 if not all of its words occur."""
    if not label or not set(label) <= set(name):
        return -1
    return len(name) - 1 - list(reversed(name)).index(label[-1])
