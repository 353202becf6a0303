"""Saved results with faults: a part of the tree exchanged, or bytes of the file mangled."""

import copy
import json

WORDS = (
    "L1\n",
    "L1\x1b[31m",
    "Ｌ１",
    "D1; import os",
    'crank-rocker"""\nraise SystemExit(7)\n"""',
    '"/><include file="x"/>',
    "-->",
    "\ud800",
    "\u202e",
    "a" * 20_000,
    "first",
    "RR",
    "PP",
    "",
    "burmester.synthesis/1",
)
LONG_NUMBER = 10**400
NUMBERS = (0, 1, -1, 2, 90, 1e-300, 1e90, 1e200, -1e200, 10**30, LONG_NUMBER, 0.5, 1e12)
REST = (None, True, False, [], {}, [[]], [None], {"id": 5}, [1, 2], [1, 2, 3])


def places(tree, path=()):
    """The path of every part of a tree."""
    yield path
    if isinstance(tree, dict | list):
        for key in tree if isinstance(tree, dict) else range(len(tree)):
            yield from places(tree[key], (*path, key))


def part(tree, path):
    """The part of a tree at a path."""
    for key in path:
        tree = tree[key]
    return tree


def with_fault(rng, tree):
    """A copy of a tree with one part exchanged, and the path of that part."""
    paths = [path for path in places(tree) if path]
    # Long lists (poses, places) have most of the parts: every second fault is near the top.
    short = [path for path in paths if len(path) < 5]
    path = rng.choice(short if rng.randrange(2) else paths)
    out = copy.deepcopy(tree)
    parent, key = part(out, path[:-1]), path[-1]
    old, how = parent[key], rng.randrange(8)
    if how == 0:
        del parent[key]
    elif how == 1 and isinstance(parent, list):
        parent.insert(key, copy.deepcopy(rng.choice(parent)))
    elif how == 2 and isinstance(old, int | float) and not isinstance(old, bool):
        parent[key] = rng.choice((-old, old * 1.001 + 1e-3, old + 1, old * 1e9, str(old)))
    elif how == 3 and isinstance(old, str):
        parent[key] = rng.choice((old + rng.choice(WORDS), old.upper(), old[1:], old * 300))
    elif how == 4:  # what stands elsewhere
        parent[key] = copy.deepcopy(part(tree, rng.choice(paths)))
    else:
        parent[key] = copy.deepcopy(rng.choice((*WORDS, *NUMBERS, *REST)))
    return out, path


def with_faults(rng, tree):
    """The bytes of a result with one to three faults in its tree, or in its bytes."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        tree, _ = with_fault(rng, tree)
        if not tree:
            break
    data = json.dumps(tree).encode()
    if rng.randrange(4):
        return data
    at, cut = rng.randrange(len(data)), rng.randrange(30)
    pieces = (b"", b"1e999", b"NaN", b"-Infinity", b"9" * 5000, b"{", b"[" * 3000, b"\xff", b'"')
    return data[:at] + rng.choice((*pieces, data[:50], b',"id":"L1"', b"\0")) + data[at + cut :]
