"""Pictures and films of people who walk, drawn by the program `flaneur`: on a GPU, or on none by Mesa's lavapipe."""

from __future__ import annotations

import base64
import json
import math
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

from flaneur._native import Refused, scenes
from flaneur.trajectories import Source, as_trajectories, write_trajectories

_TICKS = 60  # a second
_RATES = (1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60)  # pictures a second, each some whole ticks apart
_PATIENCE = 5.0  # seconds for the program to clean up in, once it has been asked to stop

Place = tuple[float, float, float]
#: As `flaneur render --camera` takes it ('overview', 'street', 'map', 'follow:12'), or where the eye is and what it looks
#: at: x to the east, y to the north, z upwards, metres.
Camera = Union[str, tuple[Place, Place]]


@dataclass
class Film:
    """A film that a notebook shows where it is the last thing in a cell.

    >>> film = flaneur.show("corridor.txt")
    >>> film.save("corridor.mp4")
    """

    mp4: bytes
    size: tuple[int, int]

    def save(self, path: str | os.PathLike[str]) -> None:
        Path(path).write_bytes(self.mp4)

    def _repr_html_(self) -> str:
        words = base64.b64encode(self.mp4).decode("ascii")
        return (
            f'<video width="{self.size[0]}" height="{self.size[1]}" style="max-width: 100%; height: auto" '
            f'controls autoplay loop muted playsinline src="data:video/mp4;base64,{words}"></video>'
        )

    def __repr__(self) -> str:
        return f"<Film: {self.size[0]} x {self.size[1]}, {len(self.mp4) / 1e6:.1f} MB>"


def program() -> str:
    """The path of the program `flaneur`: the environment's FLANEUR, one beside this package, or of PATH.

    >>> flaneur.program()
    '/usr/bin/flaneur'
    """
    named = os.environ.get("FLANEUR")
    beside = Path(__file__).resolve().parents[2] / "flaneur"
    found = named or (str(beside) if beside.is_file() else None) or shutil.which("flaneur")
    if not found:
        raise Refused("The program flaneur is not found: install it, or say where it is by FLANEUR=PATH.")
    if not os.access(found, os.X_OK) or not os.path.isfile(found):
        raise Refused(f"FLANEUR names {found}, which is no program.")
    return found


def render(
    source: Source,
    out: str | os.PathLike[str],
    seconds: float = 0.0,
    start: float = 0.0,
    size: tuple[int, int] = (1280, 720),
    camera: Camera | None = None,
    fps: int = 30,
    geometry: Any | None = None,
    options: Sequence[str] = (),
) -> Path:
    """Draws a scene's name or file, a recording (.flr), or trajectories (of a file, a frame, or PedPy).

    ``out`` is a .png (with ``seconds`` 0: the moment ``start``), DIR/%05d.png for a picture each 1/``fps`` s, or a film,
    .mp4. ``geometry`` is where people can be, of trajectories. ``options`` go to `flaneur render` as they are. What the
    program refuses is Refused; Ctrl-C stops it.

    >>> flaneur.render("district", "city.png", start=10, options=["--walkers", "300"])
    PosixPath('city.png')
    """
    if fps not in _RATES:
        raise Refused(f"{fps} pictures a second are none of {', '.join(map(str, _RATES))}.")
    if not (math.isfinite(start) and math.isfinite(seconds) and start >= 0 and seconds >= 0):
        raise Refused("start and seconds are 0 or more.")
    first, every = round(start * _TICKS), _TICKS // fps
    last = first + max(0, round(seconds * _TICKS) - every) // every * every
    words = ["--frames", str(first) if seconds == 0 else f"{first}:{last}:{every}", "--size", f"{size[0]}x{size[1]}"]
    if camera is not None:
        words += ["--camera", camera if isinstance(camera, str) else _told(camera)]
    with tempfile.TemporaryDirectory(prefix="flaneur-") as folder:
        words += _laid_out(source, geometry, Path(folder))
        _run(["render", *words, *options, "--out", os.fspath(out)])
    return Path(out)


def show(
    source: Source,
    geometry: Any | None = None,
    seconds: float = 6.0,
    start: float = 0.0,
    size: tuple[int, int] = (640, 360),
    camera: Camera | None = None,
    fps: int = 15,
    options: Sequence[str] = (),
) -> Film:
    """A film of people who walk where the trajectories say, or about a scene: for notebooks. Takes ffmpeg.

    >>> flaneur.show(frame, geometry="POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))", seconds=4, camera="map")
    """
    if not _is_drawn_as_it_is(source):
        source = as_trajectories(source)
        frames = source.frame["frame"]
        if len(frames):
            seconds = min(seconds, max(1 / fps, (frames.max() - frames.min() + 1) / source.fps - start))
    with tempfile.TemporaryDirectory(prefix="flaneur-") as folder:
        film = Path(folder) / "film.mp4"
        render(source, film, max(seconds, 1 / fps), start, size, camera, fps, geometry, options)
        return Film(film.read_bytes(), size)


def _told(camera: tuple[Place, Place]) -> str:
    try:
        eye, target = ((float(x), float(z), -float(y)) for x, y, z in camera)
    except (TypeError, ValueError):
        raise Refused("A camera is a word, or two places: ((x, y, z), (x, y, z)).") from None
    return "/".join(",".join(f"{n:.9g}" for n in place) for place in (eye, target))


def _is_drawn_as_it_is(source: Source) -> bool:
    """Scenes and recordings; all else is trajectories."""
    if not isinstance(source, (str, os.PathLike)):
        return False
    name = os.fspath(source)
    if name in scenes() or name.endswith(".flr"):
        return True
    if "." not in name and not os.path.exists(name):
        return True  # a scene's name, nearly
    if not name.endswith(".json"):
        return False
    try:
        read = json.loads(Path(name).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return True  # whose refusal says more
    return isinstance(read, dict) and "type" not in read  # unlike moving features


def _laid_out(source: Source, geometry: Any | None, folder: Path) -> list[str]:
    """Words that name the source; what is no file becomes one."""
    if _is_drawn_as_it_is(source):
        if geometry is not None:
            raise Refused("A geometry is for trajectories: scenes and recordings have a place of their own.")
        return ["--replay" if os.fspath(source).endswith(".flr") else "--scene", os.fspath(source)]
    if isinstance(source, (str, os.PathLike)) and geometry is None:
        file = Path(source).resolve()
    else:
        taken = as_trajectories(source, geometry=geometry)
        file = folder / "people.txt"
        write_trajectories(taken, file)
        if taken.area:
            file.with_suffix(".wkt").write_text(taken.area, encoding="utf-8")
    scene = folder / "scene.json"
    scene.write_text(json.dumps({"trajectories": os.fspath(file)}), encoding="utf-8")
    return ["--scene", os.fspath(scene)]


def _run(words: Sequence[str]) -> str:
    """What the program says on stderr; it is asked to stop, and waited for, where Python is."""
    with subprocess.Popen(
        [program(), *words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            said = process.communicate()[1]
        except BaseException:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(_PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
            raise
    if process.returncode == 0:
        return said
    lines = [line for line in said.splitlines() if line.strip()]
    told = [line.removeprefix("flaneur: ") for line in lines if line.startswith("flaneur: ")]
    if process.returncode < 0:
        raise Refused(f"The program flaneur was ended by signal {-process.returncode}.")
    raise Refused(told[-1] if told else "\n".join(lines[-3:]) or f"The program ended with {process.returncode}.")
