"""Pictures and films, by the program: what is drawn, what is refused, and Ctrl-C."""

import base64
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import flaneur
from test_trajectories import AREA, TrajectoryData, WalkableArea, two_who_walk

SMALL = (160, 96)
needs_ffmpeg = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="there is no ffmpeg")


def size_of(png):
    head = png.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


def test_a_frame_and_a_scene_are_drawn(tmp_path):
    data = TrajectoryData(two_who_walk(), 10.0)
    out = flaneur.render(data, tmp_path / "two.png", start=2, size=SMALL, geometry=WalkableArea(), camera=((4, -9, 6), (4, 1, 1)))
    assert size_of(out) == SMALL
    empty = flaneur.render(data, tmp_path / "later.png", start=11, size=SMALL, geometry=WalkableArea(), camera=((4, -9, 6), (4, 1, 1)))
    assert out.read_bytes() != empty.read_bytes()
    scene = flaneur.render("corner", tmp_path / "corner.png", start=0.5, size=SMALL, options=["--walkers", "5"])
    assert size_of(scene) == SMALL


def test_heads_are_no_ground(tmp_path):
    """Who is known by the height of the head stands on the floor, as one does whose height is not known."""
    feet = []
    for heights, frame in (("heads", two_who_walk(z=1.75)), ("nothing", two_who_walk())):
        flaneur.render(
            flaneur.Trajectories(frame, 10.0, heights=heights), tmp_path / "a.png", start=2, size=SMALL, geometry=AREA,
            camera=((4, -9, 6), (4, 1, 1)), options=["--ids", str(tmp_path / "ids.png")],
        )
        things = json.loads((tmp_path / "ids.json").read_text())["things"]
        feet.append([thing["box"][1] + thing["box"][3] for thing in things if thing["kind"] == "walker"])
    assert len(feet[0]) == 2 and np.allclose(feet[0], feet[1], atol=2), feet


def test_a_file_and_a_recording_are_drawn(tmp_path):
    file, recording = tmp_path / "two.json", tmp_path / "corner.flr"
    flaneur.write_trajectories(two_who_walk(), file, fps=10)  # moving features, which are no scene
    assert size_of(flaneur.render(file, tmp_path / "two.png", size=SMALL)) == SMALL
    subprocess.run(
        [flaneur.program(), "sim", "--scene", "corner", "--walkers", "5", "--seconds", "1", "--record", str(recording)],
        check=True, capture_output=True,
    )
    assert size_of(flaneur.render(recording, tmp_path / "corner.png", start=0.5, size=SMALL)) == SMALL


@needs_ffmpeg
def test_a_notebook_shows_a_film():
    film = flaneur.show(two_who_walk(), geometry=AREA, seconds=0.4, size=SMALL, fps=10)
    shown = re.fullmatch(r'<video width="160" height="96" .* src="data:video/mp4;base64,([^"]+)"></video>', film._repr_html_())
    assert shown and base64.b64decode(shown[1]) == film.mp4 and film.mp4[4:8] == b"ftyp"
    count = subprocess.run(
        ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate", "-of", "csv=p=0", "-"],
        input=film.mp4, check=True, capture_output=True,
    ).stdout.decode().strip()
    assert count == "10/1,4"


@needs_ffmpeg
def test_a_film_ends_where_people_do(tmp_path):
    film = flaneur.show(two_who_walk().query("frame < 5"), fps=10, size=SMALL)
    film.save(tmp_path / "a.mp4")
    told = subprocess.run(
        ["ffprobe", "-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", tmp_path / "a.mp4"],
        check=True, capture_output=True,
    ).stdout
    assert float(told) <= 0.5


@pytest.mark.parametrize(
    "words, told",
    [
        (dict(source="distrct"), "Did you mean district"),
        (dict(source="corner", camera="up"), "--camera up is none of"),
        (dict(source="corner", camera=(1, 2)), "A camera is"),
        (dict(source="corner", fps=7), "7 pictures a second"),
        (dict(source="corner", start=float("nan")), "start"),
        (dict(source="corner", size=(0, 3)), "--size 0x3"),
        (dict(source="corner", geometry=AREA), "A geometry is for trajectories"),
        (dict(source="none.flr"), "no file none.flr"),
        (dict(source="none.txt"), "no file"),
        (dict(source=two_who_walk().assign(x=float("nan"))), "no number"),
        (dict(source="corner", options=["--wlakers", "3"]), "Did you mean --walkers"),
    ],
)
def test_refusals_of_the_program_are_exceptions(tmp_path, words, told):
    with pytest.raises(flaneur.Refused, match=re.escape(told)):
        flaneur.render(out=tmp_path / "a.png", **words)
    assert not list(tmp_path.iterdir())


def test_the_program_is_found(monkeypatch, tmp_path):
    monkeypatch.setenv("FLANEUR", str(tmp_path / "none"))
    with pytest.raises(flaneur.Refused, match="no program"):
        flaneur.program()
    monkeypatch.delenv("FLANEUR")
    monkeypatch.setattr(flaneur.pictures, "__file__", str(tmp_path / "lib" / "flaneur" / "pictures.py"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(flaneur.Refused, match="not found"):
        flaneur.program()
    (tmp_path / "flaneur").write_text("#!/bin/sh\n")
    (tmp_path / "flaneur").chmod(0o755)
    assert flaneur.program() == str(tmp_path / "flaneur")


def test_ctrl_c_ends_the_program_too(tmp_path):
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        flaneur.render("corner", tmp_path / "%05d.png", seconds=100_000, size=SMALL)
    assert time.monotonic() - begin < 8
    children = subprocess.run(["pgrep", "-P", str(os.getpid()), "-x", "flaneur"], capture_output=True).stdout
    assert not children.strip()


def test_temporary_files_are_gone(tmp_path):
    words = "import flaneur, test_trajectories as t; flaneur.render(t.two_who_walk(), 'a.png', size=(160, 96))"
    env = {**os.environ, "TMPDIR": str(tmp_path / "tmp"), "PYTHONPATH": os.environ["PYTHONPATH"] + ":" + os.getcwd()}
    (tmp_path / "tmp").mkdir()
    subprocess.run([sys.executable, "-c", words], cwd=tmp_path, env=env, check=True)
    assert not list((tmp_path / "tmp").iterdir()) and (tmp_path / "a.png").exists()
