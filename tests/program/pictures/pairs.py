#!/usr/bin/env python3
"""pairs.py NAME=VALUE,VALUE... ...: few rows in which each two values of two parameters meet, a row a line."""
import itertools
import sys

lists = [word.split("=", 1)[1].split(",") for word in sys.argv[1:]]
left = {((i, a), (j, b)) for (i, x), (j, y) in itertools.combinations(enumerate(lists), 2) for a in x for b in y}
while left:
    # Begin with the first pair that is left; then each parameter takes the value that meets most of what is left.
    row = dict(min(left))
    for i, values in enumerate(lists):
        if i not in row:
            row[i] = max(values, key=lambda v: sum(tuple(sorted(((i, v), other))) in left for other in row.items()))
    left -= set(itertools.combinations(sorted(row.items()), 2))
    print(*(row[i] for i in range(len(lists))))
