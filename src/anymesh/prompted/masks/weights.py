"""Weights of mask proposers: a registered name, a hub id with its commit, or a folder; checked by sha256."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.masks.sam_hub_ import Hub

SUMS = "SHA256SUMS"  # digests in a folder, in the format of `sha256sum`
PICKLES = (".pth", ".pt", ".bin", ".pkl", ".ckpt")
HUB_ID = re.compile(r"[\w.-]+/[\w.-]+")
COMMIT = re.compile(r"[0-9a-f]{40}")
QUANTIZED = re.compile(r"_(fp16|bnb4|int8|uint8|q4f16|q4|q8|quantized)\.onnx$")


@dataclass(frozen=True)
class Published:
    """Weights on the hub.

    revision: a commit; files: path in the repository -> sha256, None if pinned by the commit only.
    """

    hub_id: str
    revision: str
    files: Mapping[str, str | None]


# Commits and digests are those that at least two independent public records state; they were not verified by a download. A
# wrong one would refuse good weights, never accept bad ones.
REGISTRY: dict[str, Published] = {
    "sam-vit-h": Published(
        "facebook/sam-vit-huge",
        "87aecf0df4ce6b30cd7de76e87673c49644bdf67",
        {"config.json": None, "model.safetensors": "edfb0462392541fca9af44ff039bfb32dbd0c939997f3abb77a26e23af7afd7c"},
    ),
    "sam-vit-l": Published(
        "facebook/sam-vit-large",
        "6851e0441005b0fb96f2cc4dfac472f3d1b14af1",
        {"config.json": None, "model.safetensors": "a57e1b13cd1545938dfcbc9fb26df7f60de6650237a9383382a874a623564b81"},
    ),
    "sam-vit-b": Published(
        "facebook/sam-vit-base",
        "70c1a07f894ebb5b307fd9eaaee97b9dfc16068f",
        {"config.json": None, "model.safetensors": "892c410e496344e527255ccdcb2cb7244a609acb5389c7c4fdba1288f861c579"},
    ),
    "mobile-sam": Published(
        "Acly/MobileSAM",
        "0d3b403339b4674a82493d5e97964dd78089ddc8",
        {
            "mobile_sam_image_encoder.onnx": "580f5fb648ea1062c0aabc26217aed56921985f03f0cbbd852bba81d760cc749",
            "sam_mask_decoder_multi.onnx": "8976b90a87ba50a6a72217a5ff994f7d25ce16f2229fcc1ed259e1294c622ffe",
        },
    ),
    "sam2.1-hiera-tiny": Published(
        "facebook/sam2.1-hiera-tiny",
        "de431c4043854a71d8101e17995dfe596bf101a5",
        {
            "config.json": "860aff9751b139d83a4ad7df1e5535416fded533e0ead02625edbefcb9953cce",
            "model.safetensors": "48c14467e5cf9e51870511feb72c89688e82dd74523142c0538b663e193ac2a7",
        },
    ),
    "sam2.1-hiera-large": Published(
        "facebook/sam2.1-hiera-large",
        "665f8e2ad61cf5f53d65644ff27c8ee525124610",
        {"config.json": None, "model.safetensors": "dc407dce21301fd94abb395c5099b4f2c455fdc8a8f261ac3d0ea6d4cd197230"},
    ),
    "sam2.1-hiera-tiny-onnx": Published(
        "onnx-community/sam2.1-hiera-tiny-ONNX",
        "814a066640debee5a91e70aa401fb8e17e030503",
        {
            "onnx/vision_encoder.onnx": "4f30aacd3aaefbca81a0b7fe4c1fc96345570ea0a6f80ced599493d1b3be2e8c",
            "onnx/vision_encoder.onnx_data": "e83df9866a5afe68ea7f0f721f18f65137fc3acbf0da1c74e946d363e09c69cc",
            "onnx/prompt_encoder_mask_decoder.onnx": "874414704c5d686db7d206a35f6e15d26563d50c8c4468fccc6739bd7e491dcf",
            "onnx/prompt_encoder_mask_decoder.onnx_data": "e9874d900dd4134ed60eab1e97910327c2419e0b2954485d8fd6e7f1a1470f47",
        },
    ),
}


@dataclass(frozen=True)
class Weights:
    """Checked local files. onnx: (encoder, decoder), or None if `folder` holds config.json and safetensors.

    name: identifies the weights in results: a short name or hub id with its commit, or the path of a folder.
    """

    name: str
    folder: Path
    onnx: tuple[Path, Path] | None


def resolve(spec: str, *, sha256: Mapping[str, str] | None = None, hub: Hub | None = None) -> Weights:
    """Resolve `sam:NAME`, `sam:FOLDER` or `sam:HUB_ID@COMMIT` to local files, downloading them if needed.

    sha256: file name -> required digest, in addition to those of the registry and of a folder's SHA256SUMS.
    Raise OptionError for a spec that is invalid or not pinned, ModelError for files that are missing, pickles, or do not match
    their digests, MissingExtraError if the download needs an extra.
    """
    place = spec.removeprefix("sam:")
    given = dict(sha256 or {})
    if place in REGISTRY:
        source = REGISTRY[place]
        files = (hub or Hub()).fetch(source.hub_id, source.revision, source.files)
        pinned = {Path(name).name: digest for name, digest in source.files.items() if digest}
        return _checked(f"{place}@{source.revision}", files, pinned | given)
    folder = Path(place).expanduser()
    if place and folder.is_dir():
        names = choose(
            [p.relative_to(folder).as_posix() for p in (*folder.glob("*"), *folder.glob("onnx/*")) if p.is_file()], place
        )
        return _checked(place, [folder / name for name in names], _sums(folder) | given)
    hub_id, _, commit = place.partition("@")
    if not HUB_ID.fullmatch(hub_id):
        raise OptionError(
            f"--proposer sam: found {place!r}; valid are {', '.join(sorted(REGISTRY))}, a folder that exists, or HUB_ID@COMMIT"
        )
    if not COMMIT.fullmatch(commit):
        raise OptionError(
            f"--proposer sam: found {place!r}; no such folder exists, and as a hub id it pins no weights: its owner may "
            f"change them at any time; valid is {hub_id}@ and the 40 hexadecimal digits of a commit"
        )
    hub = hub or Hub()
    names = choose(hub.names(hub_id, commit), place)
    return _checked(place, hub.fetch(hub_id, commit, names), given)


def choose(names: Iterable[str], place: str) -> tuple[str, ...]:
    """Select the files that make up a model; the first of an ONNX pair is the encoder. Raise ModelError if there are none."""
    names = sorted(names)
    if {"config.json", "model.safetensors"} <= set(names):
        return ("config.json", "model.safetensors")
    graphs = [n for n in names if n.endswith(".onnx")]
    graphs = [n for n in graphs if not QUANTIZED.search(n)] or graphs
    decoders = [n for n in graphs if "dec" in Path(n).name.lower()]
    encoders = [n for n in graphs if "enc" in Path(n).name.lower() and n not in decoders]
    if len(encoders) == len(decoders) == 1:
        pair = (encoders[0], decoders[0])
        # Weights above 2 GB, or stored separately by choice, are in files beside the graph, which refers to them by name.
        beside = [n for n in names if n not in pair and (n.startswith(pair) or n.endswith((".data", "_data.bin", ".weights")))]
        return (*pair, *beside)
    pickles = [n for n in names if n.endswith(PICKLES)]
    refused = f" (pickles run code when they are read and are refused: {', '.join(pickles[:4])})" if pickles else ""
    shown = ", ".join(n for n in names if n not in pickles)[:300] or "nothing else"
    raise ModelError(
        f"{place}: found {shown}{refused}; valid is config.json with model.safetensors, or exactly one encoder and one "
        "decoder *.onnx, identified by `enc` and `dec` in their names"
    )


def _checked(name: str, files: list[Path], digests: Mapping[str, str]) -> Weights:
    for path in files:
        expected = digests.get(path.name)
        if expected and (digest := _sha256(path)) != expected.lower():
            raise ModelError(f"{name}: {path.name} has sha256 {digest}, not {expected}; these are not the pinned weights")
    unknown = set(digests) - {path.name for path in files}
    if unknown:
        raise OptionError(f"{name}: a sha256 is given for {', '.join(sorted(unknown))}; used are {[p.name for p in files]}")
    graphs = [path for path in files if path.suffix == ".onnx"]
    return Weights(name, files[0].parent, (graphs[0], graphs[1]) if graphs else None)


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _sums(folder: Path) -> dict[str, str]:
    path = folder / SUMS
    lines = path.read_text().splitlines() if path.is_file() else []
    return {Path(words[1].lstrip("*")).name: words[0] for line in lines if len(words := line.split(maxsplit=1)) == 2}
