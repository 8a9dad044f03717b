"""What people's trajectories tell of density, speed and flow, by the methods of docs/measures.md.

An area is well-known text, or a shapely polygon; None is all that is walkable, and where no geometry is known that is the
box about everybody. Speeds are of ``frame_step`` frames before and after; 0 takes those of a fifth of a second.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd

from flaneur._native import Refused, Tracks, levels
from flaneur.trajectories import Source, as_trajectories, tracks_of, wkt_of


@dataclass
class Flow:
    """``crossings`` has everybody's first one: id, frame, time, to_left, x, y. ``intervals`` has flow (1/s), specific_flow
    (1/(m s)), people and speed from one crossing to another."""

    crossings: pd.DataFrame
    intervals: pd.DataFrame


@dataclass
class Profiles:
    """Means over frames on squares, rows from north to south, as imshow() has them with ``extent``: density (1/m2), speed
    (m/s; NaN where nobody was) and flow (1/(m s))."""

    density: np.ndarray[Any, Any]
    speed: np.ndarray[Any, Any]
    flow: np.ndarray[Any, Any]
    extent: tuple[float, float, float, float]
    frames: int


def speeds(
    source: Source, fps: float | None = None, frame_step: int = 0, ends: str = "single_sided"
) -> pd.DataFrame:
    """How fast everybody is in each frame: id, frame, time, x, y, v_x, v_y and speed, m/s.

    ``ends`` says what becomes of windows that are cut short: 'exclude', 'adaptive' or 'single_sided'.

    >>> flaneur.speeds("corridor.txt").speed.median()
    """
    tracks, _ = _measured(source, fps, None)
    return _people(tracks).assign(**tracks.speeds(frame_step, ends))


def individual(
    source: Source, fps: float | None = None, geometry: Any | None = None, cut_off: float = 1.0
) -> pd.DataFrame:
    """Everybody's Voronoi cell in each frame: its area (m2; 0: off the ground), density (1/m2), neighbours, and how far
    the nearest one is (m). Cells reach ``cut_off`` metres; 0: as far as the ground does.

    >>> flaneur.individual("corridor.txt").groupby("id").density.max()
    """
    tracks, walkable = _measured(source, fps, geometry)
    return _people(tracks).assign(**tracks.spaces(walkable, cut_off))


def voronoi_density(
    source: Source,
    area: Any | None = None,
    fps: float | None = None,
    geometry: Any | None = None,
    cut_off: float = 1.0,
    frame_step: int = 0,
    ends: str = "single_sided",
) -> pd.DataFrame:
    """Density and speed in an area, frame by frame: density by cells and classic (people over square metres), mean_speed
    of those inside, voronoi_speed, and covered, what of the area anybody's cell has.

    >>> moments = flaneur.voronoi_density("corridor.txt", area="POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))")
    >>> moments.plot("time", "density")
    """
    tracks, walkable = _measured(source, fps, geometry)
    return pd.DataFrame(tracks.moments(wkt_of(area) or walkable, walkable, cut_off, frame_step, ends))


def flow(
    source: Source,
    line: tuple[tuple[float, float], tuple[float, float]],
    seconds: float = 10.0,
    fps: float | None = None,
    frame_step: int = 0,
    ends: str = "single_sided",
) -> Flow:
    """Who crosses a line between two places, and how many a second in each ``seconds``.

    >>> through = flaneur.flow("bottleneck.txt", line=((-0.3, 0), (0.3, 0)))
    >>> through.intervals.specific_flow.mean()
    """
    try:
        (x0, y0), (x1, y1) = getattr(line, "coords", line)
        ends_of_line = (float(x0), float(y0), float(x1), float(y1))
    except (TypeError, ValueError):
        raise Refused("A line is two places, ((x, y), (x, y)).") from None
    tracks, _ = _measured(source, fps, None)
    crossings, intervals = tracks.flow(ends_of_line, seconds, frame_step, ends)
    return Flow(pd.DataFrame(crossings), pd.DataFrame(intervals))


def profiles(
    source: Source,
    square: float = 0.2,
    method: str = "voronoi",
    area: Any | None = None,
    fps: float | None = None,
    geometry: Any | None = None,
    every: int = 1,
    width: float = 0.5,
    cut_off: float = 1.0,
    frame_step: int = 0,
    ends: str = "single_sided",
) -> Profiles:
    """Maps of density, speed and flow on squares of so many metres, of every ``every``-th frame; by ``method`` 'voronoi',
    'classic' or 'gaussian' (of a full ``width`` at half maximum).

    >>> maps = flaneur.profiles("corridor.txt", square=0.2)
    >>> plt.imshow(maps.density, extent=maps.extent)
    """
    tracks, walkable = _measured(source, fps, geometry)
    made = tracks.profiles(
        wkt_of(area) or walkable, walkable, square, method, width, every, cut_off, frame_step, ends
    )
    return Profiles(**made)


def level_of_service(density: Any, of: str = "walkway") -> Any:
    """Fruin's level, 'A' to 'F', of so many people to a square metre, on a 'walkway', on 'stairs' or in a 'queue'; of a
    number, or of each of a series or an array. '' where there is none.

    >>> flaneur.level_of_service(1.0)
    'D'
    """
    letters = np.array(["A", "B", "C", "D", "E", "F", ""])
    values = np.asarray(density, dtype=np.float64)
    found = letters[levels(values.ravel(), of)].reshape(values.shape)
    if isinstance(density, pd.Series):
        return pd.Series(found, index=density.index, name="level")
    return str(found) if found.ndim == 0 else found


def _measured(source: Source, fps: float | None, geometry: Any | None) -> tuple[Tracks, str]:
    """People alone, and where they can be."""
    taken = as_trajectories(source, fps, geometry)
    if taken.vehicles:
        taken = replace(taken, frame=taken.frame[~taken.frame["id"].isin(taken.vehicles)])
    return tracks_of(taken), taken.area or _box_about(taken.frame)


def _people(tracks: Tracks) -> pd.DataFrame:
    return pd.DataFrame(tracks.columns())[["id", "frame", "time", "x", "y"]]


def _box_about(table: pd.DataFrame) -> str:
    west, south, east, north = table["x"].min(), table["y"].min(), table["x"].max(), table["y"].max()
    return f"POLYGON (({west} {south}, {east} {south}, {east} {north}, {west} {north}, {west} {south}))"
