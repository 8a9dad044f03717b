"""Where people were, frame by frame: read, written, and taken from tables of other programs."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from typing import Any, Union

import numpy as np
import pandas as pd

from flaneur._native import Refused, Tracks

#: What is taken for trajectories: a file's name, what was read, a frame of pandas with columns id, frame, x and y (and z
#: or time), or PedPy's TrajectoryData.
Source = Union[str, "os.PathLike[str]", "Trajectories", pd.DataFrame, Any]

_USUAL_FPS = 25.0


@dataclass
class Trajectories:
    """Who was where when.

    ``frame`` has a row for each person in each frame: id, frame, time (s), x, y, z (m), by frame, then by id. ``area`` is
    where people can be, as well-known text, or None; ``assumed`` has a sentence for each thing that the file did not say.
    ``heights`` tells what z is: of 'nothing', of the 'ground', or of 'heads'.

    >>> recorded = flaneur.read_trajectories("corridor.txt")
    >>> recorded.frame.groupby("id").time.agg(["min", "max"])
    """

    frame: pd.DataFrame
    fps: float
    area: str | None = None
    assumed: list[str] = field(default_factory=list)
    format: str = "a frame"
    heights: str = "nothing"
    names: dict[int, str] = field(default_factory=dict)
    vehicles: list[int] = field(default_factory=list)

    def __repr__(self) -> str:
        people = self.frame["id"].nunique()
        seconds = (self.frame["frame"].max() - self.frame["frame"].min()) / self.fps
        return f"<Trajectories: {people} people, {seconds:.1f} s at {self.fps:g} frames a second, of {self.format}>"


def read_trajectories(
    path: str | os.PathLike[str],
    unit: float | None = None,
    fps: float | None = None,
    up: str | None = None,
    geometry: str | os.PathLike[str] | None = None,
) -> Trajectories:
    """Reads a file by what is in it: PeTrack, JuPedSim, Juelich's HDF5, SUMO, Vadere, Pathfinder and more.

    ``unit`` (metres to 1 of the file), ``fps``, ``up`` ('y' or 'z') and ``geometry`` (a file of where people can be)
    overrule what the file says; what is None goes by evidence, and ``assumed`` tells of it.

    >>> recorded = flaneur.read_trajectories("corridor.txt")
    >>> recorded.fps, recorded.frame.columns.tolist()
    (25.0, ['id', 'frame', 'time', 'x', 'y', 'z'])
    """
    for name, value in (("unit", unit), ("fps", fps)):
        if value is not None and not value > 0:
            raise Refused(f"{name} is a number above 0, or None; not {value}.")
    tracks = Tracks.read(os.fspath(path), unit or 0, fps or 0, up or "", os.fspath(geometry) if geometry else "")
    return Trajectories(
        frame=pd.DataFrame(tracks.columns()),
        fps=tracks.fps,
        area=tracks.area or None,
        assumed=tracks.assumed,
        format=tracks.format,
        heights=tracks.heights,
        names=tracks.names,
        vehicles=tracks.vehicles,
    )


def write_trajectories(
    source: Source, path: str | os.PathLike[str], fps: float | None = None, geometry: Any | None = None
) -> None:
    """Writes a file for other programs; its ending tells the format: .txt (PeTrack), .sqlite (JuPedSim), .csv, .xml
    (SUMO), .json (OGC) or .traj (Vadere).

    >>> flaneur.write_trajectories(frame, "corridor.sqlite", fps=25, geometry="POLYGON ((0 0, 9 0, 9 4, 0 4, 0 0))")
    """
    tracks_of(as_trajectories(source, fps, geometry)).write(os.fspath(path))


def wkt_of(geometry: Any | None) -> str | None:
    """Well-known text of what PedPy, JuPedSim and shapely take for a geometry."""
    if geometry is None or isinstance(geometry, str):
        return geometry
    for polygon in (geometry, getattr(geometry, "polygon", None)):
        if isinstance(getattr(polygon, "wkt", None), str):
            return str(polygon.wkt)
    if callable(getattr(geometry, "as_wkt", None)):
        return str(geometry.as_wkt())
    raise Refused(f"A geometry is well-known text, or has a .wkt, unlike {type(geometry).__name__}.")


def as_trajectories(source: Source, fps: float | None = None, geometry: Any | None = None) -> Trajectories:
    """What any Source has, with another rate and another area where these are given."""
    if isinstance(source, (str, os.PathLike)):
        taken = read_trajectories(source, fps=fps)
    elif isinstance(source, Trajectories):
        taken = source
    elif isinstance(source, pd.DataFrame):
        taken = Trajectories(source, fps or _fps_of(source))
    elif isinstance(getattr(source, "data", None), pd.DataFrame) and hasattr(source, "frame_rate"):
        taken = Trajectories(source.data, float(source.frame_rate), format="PedPy's TrajectoryData")
    else:
        raise Refused(
            "Trajectories are a file's name, what read_trajectories() gave, a frame with columns id, frame, x and y, "
            f"or PedPy's TrajectoryData; not {type(source).__name__}."
        )
    if fps is None and geometry is None:
        return taken
    return replace(taken, fps=fps or taken.fps, area=wkt_of(geometry) or taken.area)


def tracks_of(trajectories: Trajectories) -> Tracks:
    """The same for the compiled part, in the order of frames and ids."""
    table = trajectories.frame
    lacking = [name for name in ("id", "frame", "x", "y") if name not in table.columns]
    if lacking:
        raise Refused(f"The frame has no column {', '.join(lacking)}: it takes id, frame, x and y.")
    heights = trajectories.heights
    z = _numbers(table, "z") if "z" in table.columns else None
    if heights == "nothing" and z is not None:
        heights = _heights_of(z)
    return Tracks.of(
        _whole(table, "id"),
        _whole(table, "frame"),
        _numbers(table, "x"),
        _numbers(table, "y"),
        None if heights == "nothing" else z,
        float(trajectories.fps),
        trajectories.area or "",
        heights,
    )


def _heights_of(z: np.ndarray[Any, Any]) -> str:
    """As files are taken that do not say it."""
    if not np.isfinite(z).all() or not z.any():
        return "nothing"
    of_heads = np.mean((z >= 1.0) & (z <= 2.2)) >= 0.95 and 1.4 <= float(np.median(z)) <= 2.1
    return "heads" if of_heads else "ground"


def _fps_of(table: pd.DataFrame) -> float:
    """By the columns frame and time, where both are there; else as cameras mostly have it."""
    if "time" not in table.columns or "frame" not in table.columns or len(table) == 0:
        return _USUAL_FPS
    ends = table.loc[[table["frame"].idxmin(), table["frame"].idxmax()]]
    frames, seconds = np.diff(ends["frame"].iloc[[0, -1]])[0], np.diff(ends["time"].iloc[[0, -1]])[0]
    return float(frames / seconds) if seconds > 0 else _USUAL_FPS


def _numbers(table: pd.DataFrame, name: str) -> np.ndarray[Any, Any]:
    try:
        return table[name].to_numpy(dtype=np.float64, na_value=np.nan)
    except (TypeError, ValueError):
        raise Refused(f"The column {name} holds what is no number.") from None


def _whole(table: pd.DataFrame, name: str) -> np.ndarray[Any, Any]:
    values = _numbers(table, name)
    wrong = np.flatnonzero(~np.isfinite(values) | (values != np.floor(values)))
    if len(wrong):
        raise Refused(f"Row {wrong[0]} of the frame has {values[wrong[0]]} for {name}, which is no whole number.")
    return values.astype(np.int64)
