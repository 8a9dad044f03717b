#!/usr/bin/env python3
"""differ.py A.png B.png MOST [SHARE]: fails if a channel of a pixel differs by more than MOST of 255; with SHARE, only if
more than that share of them do."""
import subprocess
import sys


def texels(path):
    words = ["ffmpeg", "-loglevel", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, check=True).stdout


a, b = texels(sys.argv[1]), texels(sys.argv[2])
if len(a) != len(b):
    sys.exit(f"FAILED: {len(a)} and {len(b)} bytes.")
if a != b:
    worst = max(abs(x - y) for x, y in zip(a, b))
    count = sum(x != y for x, y in zip(a, b))
    print(f"{count} of {len(a)} differ, by {worst} at most")
    share = float(sys.argv[4]) if len(sys.argv) > 4 else 0
    more = sum(abs(x - y) > int(sys.argv[3]) for x, y in zip(a, b))
    if more > share * len(a):
        sys.exit(f"FAILED: {more} differ by more than {sys.argv[3]}.")
