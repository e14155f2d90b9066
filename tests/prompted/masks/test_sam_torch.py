"""SAM and SAM 2 by Transformers, end to end on small random models that the test saves.

pip install torch==2.13.0 transformers && pytest -m slow tests/models_sam
"""

import json
import sys

import numpy as np
import pytest

from anymesh.errors import MissingExtraError, ModelError, OptionError
from anymesh.prompted.masks.sam import AutomaticMasks, PromptedSegmenter, automatic_masks
from anymesh.prompted.masks.sam_load import load_sam
from anymesh.prompted.masks.sam_torch_ import TorchSam

HEIGHT, WIDTH = 90, 160
POINTS = np.array([[40.0, 30], [100, 70], [10, 10]])


def picture():
    return np.random.default_rng(0).integers(0, 255, (HEIGHT, WIDTH, 3), dtype=np.uint8)


def save_sam(folder):
    torch, transformers = pytest.importorskip("torch"), pytest.importorskip("transformers")
    torch.manual_seed(0)
    vision = {"hidden_size": 32, "output_channels": 16, "num_hidden_layers": 2, "num_attention_heads": 2, "image_size": 128}
    vision |= {"mlp_dim": 64, "window_size": 4, "global_attn_indexes": [1], "num_pos_feats": 8}
    config = transformers.SamConfig(
        vision_config=vision,
        prompt_encoder_config={"hidden_size": 16, "image_size": 128, "image_embedding_size": 8, "mask_input_channels": 4},
        mask_decoder_config={
            "hidden_size": 16,
            "mlp_dim": 32,
            "num_attention_heads": 2,
            "num_hidden_layers": 2,
            "iou_head_hidden_dim": 16,
        },
    )
    model = transformers.SamModel(config).eval()
    model.save_pretrained(folder)
    return model


def save_sam2(folder):
    torch, transformers = pytest.importorskip("torch"), pytest.importorskip("transformers")
    torch.manual_seed(0)
    backbone = transformers.Sam2HieraDetConfig(
        hidden_size=8,
        image_size=[128, 128],
        blocks_per_stage=[1, 1, 2, 1],
        embed_dim_per_stage=[8, 16, 32, 64],
        num_attention_heads_per_stage=[1, 1, 2, 2],
        window_size_per_stage=[8, 4, 4, 2],
        window_positional_embedding_background_size=[4, 4],
        global_attention_blocks=[3],  # a block that does not halve the raster
    )
    vision = transformers.Sam2VisionConfig(
        backbone_config=backbone.to_dict(),
        backbone_channel_list=[64, 32, 16, 8],
        backbone_feature_sizes=[[32, 32], [16, 16], [8, 8]],
        fpn_hidden_size=32,
    )
    config = transformers.Sam2Config(
        vision_config=vision.to_dict(),
        prompt_encoder_config={"hidden_size": 32, "image_size": 128, "patch_size": 16, "mask_input_channels": 4},
        mask_decoder_config={"hidden_size": 32, "mlp_dim": 32, "num_attention_heads": 2, "iou_head_hidden_dim": 32},
    )
    model = transformers.Sam2Model(config).eval()
    model.save_pretrained(folder)
    return model


@pytest.mark.slow
@pytest.mark.parametrize(("save", "padded"), [(save_sam, True), (save_sam2, False)], ids=["sam", "sam2"])
def test_a_saved_model_end_to_end(save, padded, tmp_path):
    import torch

    whole = save(tmp_path)
    model = load_sam(f"sam:{tmp_path}", device="cpu")
    assert isinstance(model, PromptedSegmenter)
    assert (model.frame.side, model.frame.padded) == (128, padded)
    logits, scores = model.predict(model.embed(picture()), POINTS)
    assert logits.shape == (3, 3, 32, 32)
    assert scores.shape == (3, 3)
    at = torch.tensor(model.frame.points(POINTS, HEIGHT, WIDTH), dtype=torch.float32)[None, :, None]
    with torch.no_grad():  # the model asked directly, from pixels to masks in one call
        direct = whole(pixel_values=torch.from_numpy(model.frame.normalized(picture())), input_points=at)
    np.testing.assert_allclose(logits, direct.pred_masks[0].numpy(), atol=1e-5)
    np.testing.assert_allclose(scores, direct.iou_scores[0].numpy(), atol=1e-5)
    settings = AutomaticMasks(points_per_side=4, min_score=0.0, min_stability=0.0, nms_iou=0.9)
    found = automatic_masks(model, picture(), settings=settings)
    assert found
    assert all(p.mask.shape == (HEIGHT, WIDTH) for p in found)


@pytest.mark.slow
def test_the_square_is_what_transformers_own_processor_makes(tmp_path):
    save_sam(tmp_path)
    module = pytest.importorskip("transformers.models.sam.image_processing_pil_sam")
    size = {"size": {"longest_edge": 128}, "pad_size": {"height": 128, "width": 128}}
    expected = module.SamImageProcessorPil(**size)(picture(), return_tensors="np")["pixel_values"]
    np.testing.assert_allclose(TorchSam(tmp_path).frame.normalized(picture()), expected, atol=1e-4)


@pytest.mark.slow
def test_weights_that_lack_tensors_are_refused(tmp_path):
    from safetensors.numpy import load_file, save_file

    save_sam(tmp_path)
    tensors = load_file(tmp_path / "model.safetensors")
    gone = next(name for name in tensors if "mask_decoder" in name)
    save_file({n: t for n, t in tensors.items() if n != gone}, tmp_path / "model.safetensors", {"format": "pt"})
    with pytest.raises(ModelError, match=rf"lacks 1 tensors.*{gone}"):
        TorchSam(tmp_path)
    (tmp_path / "model.safetensors").write_bytes(b"no tensors")
    with pytest.raises(ModelError, match="cannot load SamModel"):
        TorchSam(tmp_path)


@pytest.mark.slow
def test_a_device_that_is_not_there_is_refused(tmp_path):
    save_sam(tmp_path)
    with pytest.raises(OptionError, match="'nonsense'"):
        TorchSam(tmp_path, device="nonsense")


@pytest.mark.slow
def test_on_cuda_it_says_the_same(tmp_path):
    torch = pytest.importorskip("torch")
    if not torch.cuda.is_available():
        pytest.skip("no CUDA here")
    save_sam(tmp_path)
    one, other = TorchSam(tmp_path), TorchSam(tmp_path, device="cpu")
    a, b = (m.predict(m.embed(picture()), POINTS)[0] for m in (one, other))
    np.testing.assert_allclose(a, b, atol=1e-2)


def test_another_kind_of_model_is_refused(tmp_path):
    (tmp_path / "config.json").write_text(json.dumps({"model_type": "clip"}))
    (tmp_path / "model.safetensors").write_bytes(b"")
    with pytest.raises(ModelError, match="model_type 'clip'; valid are sam, sam2"):
        load_sam(f"sam:{tmp_path}")
    (tmp_path / "config.json").write_text("[")
    with pytest.raises(ModelError, match=r"config\.json cannot be read"):
        load_sam(f"sam:{tmp_path}")


@pytest.mark.parametrize("library", ["torch", "transformers"])
def test_without_the_libraries_the_extra_is_named(library, monkeypatch, tmp_path):
    (tmp_path / "config.json").write_text(json.dumps({"model_type": "sam"}))
    (tmp_path / "model.safetensors").write_bytes(b"")
    if library == "transformers":
        monkeypatch.setitem(sys.modules, "torch", sys)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(MissingExtraError, match=r"\[sam-torch\]"):
        load_sam(f"sam:{tmp_path}")
