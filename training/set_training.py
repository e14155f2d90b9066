"""Train set networks (`anymesh.scoring.classifier`) by torch, which nothing else here needs except the extras."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np
import torch
from jaxtyping import Float
from torch import nn

from anymesh.scoring.classifier import HEADS, SetNetwork, pair_inputs, place_tokens, scaled, turned

WIDTH, HIDDEN, PAIR_HIDDEN, LAYERS = 48, 96, 24, 3
KNOTS, KNOT_ROWS = 33, 60  # quantiles of a feature, and candidates of an object that they are taken over
DROPOUT, INPUT_DROPOUT = 0.15, 0.1
RATE, DECAY, BATCH = 2e-3, 0.05, 6  # AdamW; objects of one step
MOST = 96  # candidates of an object in one step, drawn anew each time
LEAST_SHARE = 0.7  # of the candidates are kept at least


@dataclass(frozen=True, eq=False)
class CandidateSet:
    """All candidates of one object. target: 1 right to 0 wrong; weight: of each candidate."""

    own: Float[np.ndarray, "n k"]
    place: Float[np.ndarray, "n 12"]
    relations: Float[np.ndarray, "n n r"]
    target: Float[np.ndarray, " n"]
    weight: float


class Layer(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.norm, self.mix, self.out = nn.LayerNorm(WIDTH), nn.Linear(WIDTH, 3 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.norm_up, self.up, self.down = nn.LayerNorm(WIDTH), nn.Linear(WIDTH, 2 * WIDTH), nn.Linear(2 * WIDTH, WIDTH)
        self.dropout = nn.Dropout(DROPOUT)

    def forward(self, state: torch.Tensor, bias: torch.Tensor) -> torch.Tensor:
        count = len(state)
        query, key, value = self.mix(self.norm(state)).view(count, 3, HEADS, WIDTH // HEADS).permute(1, 2, 0, 3)
        taken = torch.softmax(query @ key.transpose(1, 2) / (WIDTH // HEADS) ** 0.5 + bias, 2) @ value
        state = state + self.dropout(self.out(taken.transpose(0, 1).reshape(count, WIDTH)))
        return state + self.dropout(self.down(torch.relu(self.up(self.norm_up(state)))))


class Network(nn.Module):
    """The same computation as `SetNetwork`, with the same names of weights."""

    def __init__(self, inputs: int, pair_inputs: int) -> None:
        super().__init__()
        self.first, self.second = nn.Linear(inputs, HIDDEN), nn.Linear(HIDDEN, WIDTH)
        self.pair_first, self.pair_second = nn.Linear(pair_inputs, PAIR_HIDDEN), nn.Linear(PAIR_HIDDEN, LAYERS * HEADS)
        for k in range(LAYERS):
            self.add_module(f"layer{k}", Layer())
        self.norm, self.score = nn.LayerNorm(WIDTH), nn.Linear(WIDTH, 1)
        self.dropout, self.input_dropout = nn.Dropout(DROPOUT), nn.Dropout(INPUT_DROPOUT)

    def forward(self, tokens: torch.Tensor, pairs: torch.Tensor) -> torch.Tensor:
        state = self.second(self.dropout(torch.relu(self.first(self.input_dropout(tokens)))))
        bias = self.pair_second(torch.relu(self.pair_first(pairs))).permute(2, 0, 1)
        for k in range(LAYERS):
            state = getattr(self, f"layer{k}")(state, bias[k * HEADS : (k + 1) * HEADS])
        return self.score(self.norm(state))[:, 0]


def knots_of(sets: Sequence[CandidateSet]) -> Float[np.ndarray, "q k"]:
    """Return the quantiles of each own feature."""
    some = np.concatenate([s.own[:: max(1, len(s.own) // KNOT_ROWS)] for s in sets])
    return np.quantile(some, np.linspace(0, 1, KNOTS), axis=0).astype(np.float32)


def train(sets: Sequence[CandidateSet], epochs: int, seed: int) -> SetNetwork:
    """Train one network; the same input and seed give the same weights."""
    torch.set_num_threads(1)
    torch.manual_seed(seed)
    rng, knots = np.random.default_rng(seed), knots_of(sets)
    own = [scaled(s.own, knots) for s in sets]
    first = sets[0]
    network = Network(own[0].shape[1] + 12, pair_inputs(first.place, first.relations).shape[2])
    optimizer = torch.optim.AdamW(network.parameters(), RATE, weight_decay=DECAY)
    steps = len(sets) // BATCH
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, RATE, total_steps=epochs * steps + 1, pct_start=0.1)
    mean = float(np.mean([s.weight * np.sqrt(len(s.own)) for s in sets]))
    for _ in range(epochs):
        order = rng.permutation(len(sets))
        for batch in order[: steps * BATCH].reshape(steps, BATCH):
            optimizer.zero_grad()
            for k in batch:
                s, count = sets[k], len(own[k])
                share = rng.uniform(LEAST_SHARE, 1)
                some = np.sort(rng.permutation(count)[: min(MOST, max(1, round(count * share)))])
                place = turned(s.place[some], int(rng.integers(4)), mirrored=rng.random() < 0.5)
                pairs = pair_inputs(place, s.relations[np.ix_(some, some)])
                tokens = np.concatenate([own[k][some], place_tokens(place)], 1, dtype=np.float32)
                score = network(torch.from_numpy(tokens), torch.from_numpy(pairs))
                target = torch.from_numpy(s.target[some].astype(np.float32))
                loss = nn.functional.binary_cross_entropy_with_logits(score, target, reduction="sum")
                (loss * (count / len(some) * s.weight / mean / BATCH)).backward()
            nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimizer.step()
            schedule.step()
    weights = {n: w.numpy().astype(np.float16).astype(np.float32) for n, w in network.state_dict().items()}
    trained = SetNetwork(knots, weights)
    check(network, trained, first)
    return trained


def check(network: Network, trained: SetNetwork, some: CandidateSet) -> None:
    """Raise AssertionError if the network scores other than its arrays do."""
    network.load_state_dict({n: torch.from_numpy(w) for n, w in trained.weights.items()})
    network.eval()
    tokens = np.concatenate([scaled(some.own, trained.knots), place_tokens(some.place)], 1, dtype=np.float32)
    pairs = pair_inputs(some.place, some.relations)
    with torch.no_grad():
        score = network(torch.from_numpy(tokens), torch.from_numpy(pairs)).numpy()
    np.testing.assert_allclose(trained.score(some.own, some.place, pairs), score, atol=2e-3)


_SETS: list[CandidateSet] = []  # of the workers of `train_all`, which share the memory of their parent


def train_all(sets: Sequence[CandidateSet], chosen: Sequence[Sequence[int]], epochs: int, seeds: int) -> list[list[SetNetwork]]:
    """Train an ensemble of networks, with seeds from 0, on each choice of sets, in processes."""
    _SETS[:] = sets
    jobs = [(list(some), epochs, seed) for some in chosen for seed in range(seeds)]
    with ProcessPoolExecutor(os.cpu_count(), get_context("fork")) as workers:
        networks = list(workers.map(_train_on, jobs))
    return [networks[k : k + seeds] for k in range(0, len(networks), seeds)]


def _train_on(job: tuple[list[int], int, int]) -> SetNetwork:
    chosen, epochs, seed = job
    return train([_SETS[k] for k in chosen], epochs, seed)
