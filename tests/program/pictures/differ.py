#!/usr/bin/env python3
"""differ.py A.png B.png MOST: fails if a channel of a pixel differs by more than MOST of 255."""
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
    if worst > int(sys.argv[3]):
        sys.exit(f"FAILED: they differ by {worst}, at most {sys.argv[3]}.")
