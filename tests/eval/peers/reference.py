"""The reference's M3 decision (sum, entropy thresholds) in plain numpy, one sample at a time.

    python3 reference.py SETS REPEATS

Reads the JSON-lines sets in SETS, decides every sample REPEATS times and prints one JSON object:
{"decisions": n, "seconds": s, "answers": {set: [[action, object, storage], ...]}} with the decided
options as indices into vocab.json, -1 for none. Reading and parsing are not timed.
"""

import gzip
import json
import pathlib
import sys
import time

import numpy as np

CATEGORIES = ("action", "object", "storage")
EPSILON = np.finfo(float).eps
LEAST_H = 1e-14
ABSENT_BELOW = 1e-3
LEAD = 0.01
PENALTY = 0.2
VISIBLE = 0.1
LIFT = 0.3


def cross_entropy(w):
    """Diagonal cross-entropy of every option, and the normalised entropy."""
    p = (w + EPSILON) / (w + EPSILON).sum()
    log = np.log2(p)
    per_log_n = 1.0 / np.log2(len(w))
    return np.maximum(-log * per_log_n, 0.0), -(p * log).sum() * per_log_n


def penalise(w):
    h, _ = cross_entropy(w)
    return (w + EPSILON) / np.maximum(h, LEAST_H)


def one_hot(w):
    return (w == 1).sum() == 1 and (w == 0).sum() == len(w) - 1


def settle(w):
    """The decided option or -1: something is clear and the best leads."""
    if not w.any():
        return -1
    h, entropy = cross_entropy(w)
    best = int(np.argmax(w))
    second = np.delete(w, best).max()
    return best if (h < entropy).any() and w[best] - second > LEAD else -1


class Decider:
    def __init__(self, vocabulary):
        self.names = {c: vocabulary[c + "s"] for c in CATEGORIES}
        needs = [vocabulary["action_requirements"][a] for a in self.names["action"]]
        features, types = vocabulary["features"], vocabulary["types"]
        self.types = types
        self.takes = np.array([[c in n["compulsory"] for c in CATEGORIES] for n in needs])
        self.wanted, self.unwanted = {}, {}
        for c in CATEGORIES[1:]:
            rows = [n[c + "_positive"] + (n["storage_type"] if c == "storage" else []) for n in needs]
            self.wanted[c] = np.array([[f in r for f in features + types] for r in rows])
            rows = [n[c + "_negative"] for n in needs]
            self.unwanted[c] = np.array([[f in r for f in features + types] for r in rows])

    def prepare(self, sample):
        """A parsed line as arrays."""
        words = {}
        for m in ("gesture", "language"):
            for c in CATEGORIES:
                n = len(self.names[c])
                words[m, c] = np.array(sample[m][c], float) if sample[m][c] else np.zeros(n)
        things = {}
        for c in CATEGORIES[1:]:
            things[c] = np.array(
                [
                    [bool(f[1]) for f in features] + [t in kinds[:1] for t in self.types]
                    for _, kinds, features in sample[c + "s"]
                ]
            )
        there = [self.names["object"].index(o[0]) for o in sample["objects"]]
        return words, things, there

    def decide(self, words, things, there):
        words = dict(words)
        if one_hot(words["language", "action"]):
            words["language", "action"] = np.minimum(words["language", "action"] + LIFT, 1.0)
        if one_hot(words["language", "object"]):
            said, shown = words["language", "object"].copy(), words["gesture", "object"].copy()
            said[there] = np.minimum(said[there] + LIFT, 1.0)
            inside = shown[there]
            span = inside.max() - inside.min()
            if span > 0:
                shown[there] = (inside - inside.min()) / span * (1 - LIFT) + LIFT
            words["language", "object"], words["gesture", "object"] = said, shown
        visible, merged = [], {}
        for c in CATEGORIES:
            both = [words["gesture", c], words["language", c]]
            visible.append(max(w.sum() for w in both) > VISIBLE)
            said = [penalise(w) for w in both if (w >= ABSENT_BELOW).any()]
            w = sum(said) if said else np.zeros(len(both[0]))
            merged[c] = w / w.sum() if said else w
        alpha = PENALTY ** (self.takes != np.array(visible)).sum(1)
        beta = np.ones(len(alpha))
        for k, c in enumerate(CATEGORIES[1:], 1):
            fits = np.zeros(len(alpha), bool)
            for thing in things[c]:
                fits |= ~((self.wanted[c] & ~thing).any(1) | (self.unwanted[c] & thing).any(1))
            beta *= np.where(self.takes[:, k], fits, True)
        merged["action"] = merged["action"] * alpha * beta
        return [settle(merged[c]) for c in CATEGORIES]


def main(folder, repeats):
    folder = pathlib.Path(folder)
    decider = Decider(json.loads((folder / "vocab.json").read_text()))
    answers, decisions, seconds = {}, 0, 0.0
    for file in sorted(folder.glob("*.jsonl.gz")):
        with gzip.open(file, "rt") as lines:
            samples = [decider.prepare(json.loads(line)) for line in lines]
        started = time.process_time()
        for _ in range(repeats):
            decided = [decider.decide(*sample) for sample in samples]
        seconds += time.process_time() - started
        decisions += repeats * len(samples)
        answers[file.name.removesuffix(".jsonl.gz")] = decided
    json.dump({"decisions": decisions, "seconds": seconds, "answers": answers}, sys.stdout)


if __name__ == "__main__":
    np.seterr(all="ignore")
    main(sys.argv[1], int(sys.argv[2]))
