"""Whether a card keeps its linkage: random drags over the studio's websocket, without a browser.

    python -m benchmarks.studio_cards --drags 1000 --seed 0

A hand moves or turns a pose in steps, each of which is followed; then the whole road answers, and
says which of its linkages are those of before ("was").  Where the last step was judged, the
linkages of before are known at that very task, and are compared with the new ones by the numbers of
their dyads.  Of each card whose linkage goes on

    kept    its linkage is where it was
    told    it is elsewhere, and the card says how far
    wrong   it is elsewhere, and the card does not say so
    unseen  the last step did not judge it, so the card showed where it was earlier

and of the others

    ended   no new linkage is where it was
    lost    one is, but the card is told to have ended

Every second drag asks for all linkages to be judged at its last step, so none is unseen.  A drag
that cannot be followed to its end counts as refused.  Exit code 1 if one is wrong or lost.
"""

import argparse
import math
import random
import sys
import tempfile
from collections import Counter

from tests.oracles.studio import served

from benchmarks.studio_drags import SAME, apart

# Ten poses, with pins and with sliders; eight with limits; five, four and three.
TASKS = (
    "case:ge2012-exact",
    "case:motiongen-rrpr",
    None,
    "case:motiongen-shoulder",
    "case:motiongen-four-line",
    "case:motiongen-three-pivots",
)
PATIENCE_S = 600.0
UNDER_WAY = ("solving", "progress", "waiting")  # kinds of messages that more follow
A_ROUND = 12  # drags from the first task on; then the next task is opened


def ask(tab, do, **more):
    """The last answer to a message, whatever else the machine does."""
    n = tab.say(do, **more)
    while (heard := tab.hear(PATIENCE_S))["n"] != n or heard["kind"] in UNDER_WAY:
        pass
    return heard


class Hand:
    """A hand in a tab: the task as it is, the last answer, and where its linkages are."""

    def __init__(self, tab, document, options, rng):
        self.tab, self.rng, self.options = tab, rng, options
        self.document, self.first = document, document
        self.seen, self.fresh, self.refused = {}, set(), False
        self.solve()

    def solve(self):
        """The whole road: the new linkages by their ids, and the old id of those that go on."""
        answer = ask(self.tab, "solve", document=self.document, options=self.options)
        assert answer["kind"] == "solved", answer
        self.linkages = {each["id"]: each for each in answer["result"]["linkages"]}
        return answer["was"]

    def follow(self, **more):
        """Where the linkages are at the task as it is; whether they could be followed."""
        shown = list(self.linkages)[:1]
        answer = ask(
            self.tab, "follow", document=self.document, options=self.options, shown=shown, **more
        )
        if answer["kind"] != "followed":
            return False
        for each in answer["linkages"]:
            if "led" in each:
                self.seen[each["id"]] = each
        self.fresh = {each["id"] for each in answer["linkages"] if each["fresh"]}
        self.there = {each["id"] for each in answer["linkages"]}
        return True

    def drag(self, every):
        """One pose moved or turned in steps; whether all of them could be followed."""
        rng, poses = self.rng, self.document["poses"]
        k, steps = rng.randrange(len(poses)), rng.randint(6, 14)
        span = max(math.dist((a["x"], a["y"]), (b["x"], b["y"])) for a in poses for b in poses)
        turn, length = rng.uniform(0, math.tau), span * rng.uniform(0.008, 0.06)
        by = {"x": length * math.cos(turn), "y": length * math.sin(turn)}
        if rng.random() < 0.3:
            by = {"angle": rng.uniform(-8, 8)}
        start = poses[k]
        for step in range(1, steps + 1):
            moved = {name: start[name] + value * step / steps for name, value in by.items()}
            self.document = {
                **self.document,
                "poses": [*poses[:k], {**start, **moved}, *poses[k + 1 :]],
            }
            if not self.follow(every=every and step == steps):
                return False
        return True

    def go_home(self):
        """Back to the first task, in one step."""
        self.document = self.first
        self.solve()


def verdicts(hand, was):
    """What became of each card, as (verdict, id before, id now)."""
    goes_on = {each["id"]: (now, each["moved"]) for now, each in was.items()}
    taken = {now for now, _ in goes_on.values()}
    for old in hand.there:
        now, moved = goes_on.get(old, (None, 0))
        if old not in hand.fresh:
            yield "unseen" if now else "ended unseen", old, now
        elif now:
            away = apart(hand.seen[old], hand.linkages[now])
            yield "kept" if away < SAME else "told" if moved else "wrong", old, now
        else:
            others = (each for key, each in hand.linkages.items() if key not in taken)
            near = min((apart(hand.seen[old], each) for each in others), default=math.inf)
            yield "lost" if near < SAME else "ended", old, now


def campaign(task, drags, rng):
    """Drags of one task: counts."""
    count = Counter()
    given = [*([task] if task else []), "--time-limit", str(PATIENCE_S)]
    with tempfile.TemporaryDirectory() as home, served(*given, home=home) as one:
        start = one.http.get("/start").json()
        with one.live() as tab:
            hand = Hand(tab, start["document"], start["options"], rng)
            for k in range(drags):
                count["drags"] += 1
                if not hand.drag(every=k % 2 == 0):
                    count["refused"] += 1
                    hand.go_home()
                    continue
                before = hand.document
                for verdict, old, now in verdicts(hand, hand.solve()):
                    count[verdict] += 1
                    if verdict in ("wrong", "lost"):
                        print(f"  {verdict}: {old}, now {now}, drag {k} of {task}: {before}")
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--drags", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    counts, left, rounds = {task: Counter() for task in TASKS}, given.drags, 0
    while left > 0:
        for task in TASKS:
            drags = min(A_ROUND, left)
            counts[task] += campaign(task, drags, random.Random(f"{given.seed} {task} {rounds}"))
            left -= drags
        rounds += 1
        whole = sum(counts.values(), Counter())
        print(f"round {rounds}", dict(whole), flush=True)
    for task, count in counts.items():
        print(task or "the studio's own", dict(count))
    sys.exit(bool(whole["wrong"] + whole["lost"]))


if __name__ == "__main__":
    main()
