"""SAM weights as ONNX files: a registered name, a hub id with its commit, or a folder; checked by sha256.

Downloads use huggingface_hub; a commit in its cache needs no network.
"""

from __future__ import annotations

import hashlib
import importlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from anymesh.errors import MissingExtraError, ModelError, OptionError, pip_install

SUMS = "SHA256SUMS"  # digests in a folder, in the format of `sha256sum`
PICKLES = (".pth", ".pt", ".bin", ".pkl", ".ckpt")
HUB_ID = re.compile(r"[\w.-]+/[\w.-]+")
COMMIT = re.compile(r"[0-9a-f]{40}")
QUANTIZED = re.compile(r"_(fp16|bnb4|int8|uint8|q4f16|q4|q8|quantized)\.onnx$")


@dataclass(frozen=True)
class Published:
    """Weights on the hub.

    revision: a commit; files: path in the repository -> sha256.
    """

    hub_id: str
    revision: str
    files: Mapping[str, str]


# Commits and digests are those that at least two independent public records state; they were not verified by a download. A
# wrong one would refuse good weights, never accept bad ones.
REGISTRY: dict[str, Published] = {
    "mobile-sam": Published(
        "Acly/MobileSAM",
        "0d3b403339b4674a82493d5e97964dd78089ddc8",
        {
            "mobile_sam_image_encoder.onnx": "580f5fb648ea1062c0aabc26217aed56921985f03f0cbbd852bba81d760cc749",
            "sam_mask_decoder_multi.onnx": "8976b90a87ba50a6a72217a5ff994f7d25ce16f2229fcc1ed259e1294c622ffe",
        },
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
class Hub:
    """A Hugging Face hub. endpoint, cache: None for huggingface_hub's own (HF_ENDPOINT, HF_HOME)."""

    endpoint: str | None = None
    cache: Path | None = None

    def fetch(self, hub_id: str, commit: str, names: Iterable[str]) -> list[Path]:
        """Return local paths of files of a repository at a commit. Raise ModelError if one cannot be fetched."""
        hub = _library()
        try:
            return [
                Path(hub.hf_hub_download(hub_id, name, revision=commit, endpoint=self.endpoint, cache_dir=self.cache))
                for name in names
            ]
        except Exception as error:  # errors of the library, of HTTP and of the disk are reported alike
            raise ModelError(_error_message(hub_id, commit, error)) from None

    def names(self, hub_id: str, commit: str) -> list[str]:
        """List all file names of a repository at a commit. Raise ModelError if the hub cannot be reached."""
        hub = _library()
        try:
            return hub.HfApi(endpoint=self.endpoint).list_repo_files(hub_id, revision=commit)
        except Exception as error:
            raise ModelError(_error_message(hub_id, commit, error)) from None


@dataclass(frozen=True)
class Weights:
    """Checked local files of an encoder and a decoder.

    name: identifies the weights in results: a short name or hub id with its commit, or the path of a folder.
    """

    name: str
    encoder: Path
    decoder: Path


def resolve(spec: str, *, hub: Hub | None = None) -> Weights:
    """Resolve `sam:NAME`, `sam:FOLDER` or `sam:HUB_ID@COMMIT` to local files, downloading them if needed.

    Raise OptionError for a spec that is invalid or not pinned, ModelError for files that are missing, pickles, or do not match
    the digests of the registry or of the folder's SHA256SUMS, MissingExtraError if the download needs an extra.
    """
    place = spec.removeprefix("sam:")
    if place in REGISTRY:
        source = REGISTRY[place]
        files = (hub or Hub()).fetch(source.hub_id, source.revision, source.files)
        return _checked(f"{place}@{source.revision}", files, {Path(name).name: d for name, d in source.files.items()})
    folder = Path(place).expanduser()
    if place and folder.is_dir():
        names = choose(
            [p.relative_to(folder).as_posix() for p in (*folder.glob("*"), *folder.glob("onnx/*")) if p.is_file()], place
        )
        return _checked(place, [folder / name for name in names], _sums(folder))
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
    return _checked(place, hub.fetch(hub_id, commit, names), {})


def choose(names: Iterable[str], place: str) -> tuple[str, ...]:
    """Select the files of a model: the encoder, the decoder, then others. Raise ModelError if there are none."""
    names = sorted(names)
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
        f"{place}: found {shown}{refused}; valid is exactly one encoder and one decoder *.onnx, identified by `enc` and `dec` "
        "in their names"
    )


def _checked(name: str, files: list[Path], digests: Mapping[str, str]) -> Weights:
    for path in files:
        expected = digests.get(path.name)
        if expected and (digest := _sha256(path)) != expected.lower():
            raise ModelError(f"{name}: {path.name} has sha256 {digest}, not {expected}; these are not the pinned weights")
    encoder, decoder = [path for path in files if path.suffix == ".onnx"][:2]
    return Weights(name, encoder, decoder)


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _sums(folder: Path) -> dict[str, str]:
    path = folder / SUMS
    lines = path.read_text().splitlines() if path.is_file() else []
    return {Path(words[1].lstrip("*")).name: words[0] for line in lines if len(words := line.split(maxsplit=1)) == 2}


def _library() -> ModuleType:
    try:  # imported by name, because type checks also run without the library
        return importlib.import_module("huggingface_hub")
    except ImportError as error:
        raise MissingExtraError(
            f"huggingface_hub is not installed; install it with {pip_install('sam')}; "
            "or give a folder that holds the weights: sam:FOLDER"
        ) from error


def _error_message(hub_id: str, commit: str, error: Exception) -> str:
    reason = " ".join(str(error).split())[:200]
    return f"{hub_id}@{commit}: the weights cannot be fetched ({type(error).__name__}: {reason})"
