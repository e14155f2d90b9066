"""Weights: named, pinned, checked; downloads against a hub on the loopback address."""

import hashlib
import http.server
import json
import re
import sys
import threading

import pytest

from anymesh.errors import MissingExtraError, ModelError, OptionError
from anymesh.prompted.grounding.sam_weights_ import REGISTRY, Hub, Published, choose, resolve

COMMIT = "0123456789abcdef0123456789abcdef01234567"
ENCODER, DECODER = b"the encoder", b"the decoder"


def digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "my_encoder.onnx").write_bytes(ENCODER)
    (tmp_path / "my_decoder.onnx").write_bytes(DECODER)
    return tmp_path


def test_the_registry_pins_every_entry():
    for name, source in REGISTRY.items():
        assert re.fullmatch(r"[0-9a-f]{40}", source.revision), name
        assert all(re.fullmatch(r"[0-9a-f]{64}", d) for d in source.files.values()), name
        graphs = [f for f in choose(source.files, name) if f.endswith(".onnx")]
        assert graphs == [f for f in source.files if f.endswith(".onnx")], name
        assert set(choose(source.files, name)) == set(source.files), name


def test_a_folder_of_onnx_files(folder):
    found = resolve(f"sam:{folder}")
    assert (found.encoder, found.decoder) == (folder / "my_encoder.onnx", folder / "my_decoder.onnx")
    assert found == resolve(str(folder))


def test_a_folders_own_sums_are_checked(folder):
    (folder / "SHA256SUMS").write_text(f"{digest(ENCODER)}  my_encoder.onnx\n{digest(DECODER)} *my_decoder.onnx\n")
    resolve(f"sam:{folder}")
    (folder / "my_decoder.onnx").write_bytes(b"another")
    with pytest.raises(ModelError, match=rf"my_decoder.onnx has sha256 .*, not {digest(DECODER)}; .*not the pinned weights"):
        resolve(f"sam:{folder}")


@pytest.mark.parametrize("spec", ["sam:sam-vit-x", "sam:", "sam:/no/such/folder", "sam:a/b/c"])
def test_names_that_are_nothing_list_what_is_valid(spec):
    with pytest.raises(OptionError, match=r"mobile-sam.*HUB_ID@COMMIT"):
        resolve(spec)


@pytest.mark.parametrize("spec", ["sam:facebook/sam-vit-base", "sam:facebook/sam-vit-base@main", "sam:a/b@0d3b403"])
def test_a_hub_id_without_a_commit_is_refused(spec):
    with pytest.raises(OptionError, match="pins no weights"):
        resolve(spec)


def test_pickles_are_refused(tmp_path):
    (tmp_path / "sam_vit_b_01ec64.pth").write_bytes(b"")
    with pytest.raises(ModelError, match=r"pickles run code.*sam_vit_b_01ec64.pth"):
        resolve(f"sam:{tmp_path}")


def test_files_are_chosen_by_their_names():
    names = ["onnx/vision_encoder.onnx", "onnx/vision_encoder.onnx_data", "onnx/vision_encoder_q4.onnx", "README.md"]
    names += ["onnx/prompt_encoder_mask_decoder.onnx", "onnx/prompt_encoder_mask_decoder_fp16.onnx", "config.json"]
    assert choose(names, "x") == (
        "onnx/vision_encoder.onnx",
        "onnx/prompt_encoder_mask_decoder.onnx",
        "onnx/vision_encoder.onnx_data",
    )
    with pytest.raises(ModelError, match="exactly one encoder and one decoder"):
        choose(["a_encoder.onnx", "single_decoder.onnx", "multi_decoder.onnx"], "x")
    with pytest.raises(ModelError, match="nothing else"):
        choose([], "x")


@pytest.fixture
def hub(tmp_path):
    pytest.importorskip("huggingface_hub")
    files = {"my_encoder.onnx": ENCODER, "my_decoder.onnx": DECODER}
    asked = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            match = re.fullmatch(rf"/own/sam/resolve/{COMMIT}/(.+)", self.path)
            listed = [{"type": "file", "path": n, "rfilename": n, "size": len(d), "oid": "0" * 40} for n, d in files.items()]
            if match and match[1] in files:
                self.reply(200, files[match[1]])
            elif self.path.startswith(f"/api/models/own/sam/tree/{COMMIT}"):
                self.reply(200, json.dumps(listed).encode(), "application/json")
            elif self.path.startswith(f"/api/models/own/sam/revision/{COMMIT}"):
                found = {"id": "own/sam", "sha": COMMIT, "siblings": listed}
                self.reply(200, json.dumps(found).encode(), "application/json")
            else:
                self.reply(404, b"")

        do_HEAD = do_GET  # noqa: N815

        def reply(self, status, data, kind="application/octet-stream"):
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(data)))
            self.send_header("ETag", f'"{digest(data)}"')
            self.send_header("X-Repo-Commit", COMMIT)
            self.end_headers()
            if self.command == "GET":
                self.wfile.write(data)

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield Hub(f"http://127.0.0.1:{server.server_port}", tmp_path / "cache"), asked
    server.shutdown()
    server.server_close()


def test_a_hub_id_with_a_commit_is_downloaded_once(hub):
    place, asked = hub
    found = resolve(f"sam:own/sam@{COMMIT}", hub=place)
    assert [p.read_bytes() for p in (found.encoder, found.decoder)] == [ENCODER, DECODER]
    assert found.name == f"own/sam@{COMMIT}"
    asked.clear()
    place.fetch("own/sam", COMMIT, ["my_encoder.onnx", "my_decoder.onnx"])
    assert asked == []


def test_a_name_is_downloaded_at_its_commit_and_checked(hub, monkeypatch):
    place, _ = hub
    files = {"my_encoder.onnx": digest(ENCODER), "my_decoder.onnx": digest(DECODER).upper()}
    monkeypatch.setitem(REGISTRY, "mine", Published("own/sam", COMMIT, files))
    assert resolve("sam:mine", hub=place).name == f"mine@{COMMIT}"
    wrong = Published("own/sam", COMMIT, files | {"my_decoder.onnx": digest(b"other")})
    monkeypatch.setitem(REGISTRY, "mine", wrong)
    with pytest.raises(ModelError, match=r"my_decoder\.onnx has sha256"):
        resolve("sam:mine", hub=place)


def test_a_hub_that_lacks_it_is_one_error(hub):
    place, _ = hub
    with pytest.raises(ModelError, match="cannot be fetched"):
        resolve(f"sam:own/other@{COMMIT}", hub=place)
    with pytest.raises(ModelError, match="cannot be fetched"):
        place.fetch("own/sam", COMMIT, ["missing.onnx"])


def test_without_the_library_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "huggingface_hub", None)
    with pytest.raises(MissingExtraError, match=r"\[sam\]"):
        resolve("sam:mobile-sam")
