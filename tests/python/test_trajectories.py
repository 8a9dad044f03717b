"""Trajectories: read, written, and taken from tables of other programs."""

import os
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import flaneur

CORPUS = Path(os.environ.get("FLANEUR_SHARED", "/nowhere")) / "corpus" / "trajectories"
AREA = "POLYGON ((0 0, 12 0, 12 2, 0 2, 0 0))"


def two_who_walk(**others):
    """At 1 m/s to the east, 2 m apart, ten frames a second."""
    frames = np.arange(101)
    return pd.concat(
        pd.DataFrame({"id": who, "frame": frames, "x": frames / 10 + 2 * k, "y": 1.0, **others}) for k, who in enumerate((1, 2))
    )


class TrajectoryData:
    """What PedPy's has."""

    def __init__(self, data, frame_rate):
        self.data, self.frame_rate = data, frame_rate


class WalkableArea:
    """The same."""

    class polygon:
        wkt = AREA


def test_petrack_is_read(tmp_path):
    file = tmp_path / "two.txt"
    file.write_text("# framerate: 16 fps\n# id frame x/cm y/cm z/cm\n1 4 100 200 176\n1 5 110 200 176\n7 5 0 50 176\n")
    read = flaneur.read_trajectories(file)
    assert read.frame.columns.tolist() == ["id", "frame", "time", "x", "y", "z"]
    assert read.fps == 16 and read.area is None and read.heights == "heads" and read.assumed
    assert np.allclose(read.frame[["id", "frame", "time", "x", "y", "z"]].to_numpy(),
                       [[1, 4, 0.25, 1, 2, 1.76], [1, 5, 5 / 16, 1.1, 2, 1.76], [7, 5, 5 / 16, 0, 0.5, 1.76]])
    assert np.allclose(flaneur.read_trajectories(file, unit=0.1, fps=8).frame.x, [10, 11, 0])
    assert flaneur.read_trajectories(file, fps=8).fps == 8


@pytest.mark.parametrize("ending", [".txt", ".sqlite", ".csv", ".xml", ".json", ".traj"])
def test_what_is_written_is_read_again(tmp_path, ending):
    file = tmp_path / f"two{ending}"
    frame = two_who_walk()
    flaneur.write_trajectories(frame.sample(frac=1, random_state=1), file, fps=10, geometry=AREA)
    read = flaneur.read_trajectories(file)
    assert abs(read.fps - 10) < 1e-3
    there = read.frame.sort_values(["frame", "x"])
    assert np.allclose(there[["x", "y"]], frame.sort_values(["frame", "x"])[["x", "y"]], atol=2e-4)
    assert (read.area is not None) == (ending == ".sqlite")
    assert [p.name for p in tmp_path.iterdir()] == [file.name]


@pytest.mark.parametrize("z, heights", [(1.2, "heads"), (1.76, "heads"), (3.4, "ground")])
def test_heights_stay_what_they_are_of(tmp_path, z, heights):
    file = tmp_path / "two.txt"
    recorded = flaneur.Trajectories(two_who_walk(z=z), fps=10, heights=heights)
    flaneur.write_trajectories(recorded, file)
    read = flaneur.read_trajectories(file)
    assert read.heights == heights and np.allclose(read.frame.z, z)


def test_pedpys_own_is_taken(tmp_path):
    data = TrajectoryData(two_who_walk(point=None), 10.0)
    file = tmp_path / "two.sqlite"
    flaneur.write_trajectories(data, file, geometry=WalkableArea())
    assert "12" in flaneur.read_trajectories(file).area
    assert np.allclose(flaneur.speeds(data).speed, 1, atol=1e-3)


def test_a_rate_is_known_by_times():
    frame = two_who_walk().assign(time=lambda f: f.frame / 10)
    assert np.allclose(flaneur.speeds(frame).speed, 1, atol=1e-3)
    assert np.allclose(flaneur.speeds(frame, fps=20).speed, 2, atol=1e-3)
    assert np.allclose(flaneur.speeds(two_who_walk()).speed, 2.5, atol=1e-3)  # 25 a second, as cameras have it


@pytest.mark.parametrize(
    "frame, told",
    [
        (two_who_walk().assign(x=np.nan), "Row 0 .* no number"),
        (two_who_walk().assign(y=np.inf), "Row 0 .* no number"),
        (two_who_walk().assign(frame=np.nan), "Row 0 .* whole number"),
        (two_who_walk().assign(frame=lambda f: f.frame + 0.5), "whole number"),
        (two_who_walk().assign(frame=-1), "counted from 0"),
        (two_who_walk().assign(id=1), "Person 1 is twice in frame 0"),
        (two_who_walk().assign(id="anna"), "id holds what is no number"),
        (two_who_walk().assign(x=1e9), "1000 km"),
        (two_who_walk().drop(columns="y"), "no column y"),
        (two_who_walk().iloc[:0], "Nobody"),
        (3, "not int"),
    ],
)
def test_frames_that_are_none_are_refused(frame, told, tmp_path):
    with pytest.raises(flaneur.Refused, match=told):
        flaneur.write_trajectories(frame, tmp_path / "a.txt")
    with pytest.raises(flaneur.Refused, match=told):
        flaneur.speeds(frame)
    assert not list(tmp_path.iterdir())


def test_files_that_are_none_are_refused(tmp_path):
    with pytest.raises(flaneur.Refused, match="no file"):
        flaneur.read_trajectories(tmp_path / "none.txt")
    (tmp_path / "a.txt").write_text("hello\n")
    with pytest.raises(flaneur.Refused):
        flaneur.read_trajectories(tmp_path / "a.txt")
    with pytest.raises(flaneur.Refused, match="unit"):
        flaneur.read_trajectories(tmp_path / "a.txt", unit=-1)
    with pytest.raises(flaneur.Refused, match="up is"):
        flaneur.read_trajectories(tmp_path / "a.txt", up="x")
    with pytest.raises(flaneur.Refused, match="must end in"):
        flaneur.write_trajectories(two_who_walk(), tmp_path / "a.doc")
    with pytest.raises(flaneur.Refused, match="Cannot write"):
        flaneur.write_trajectories(two_who_walk(), tmp_path / "none" / "a.txt")
    with pytest.raises(flaneur.Refused, match="geometry"):
        flaneur.write_trajectories(two_who_walk(), tmp_path / "a.txt", geometry="CIRCLE (0 0)")
    with pytest.raises(flaneur.Refused, match="fps"):
        flaneur.write_trajectories(two_who_walk(), tmp_path / "a.txt", fps=-3)


@pytest.mark.skipif(not CORPUS.is_dir(), reason="the corpus of trajectories is not here")
@pytest.mark.parametrize(
    "name, people, fps",
    [("040_c_56_h-.txt", 75, 25), ("bi_corr_400_b_03.txt", 480, 25), ("00_01a.h5", 46, 25), ("trajectories.sqlite", 30, 25),
     ("pathfinder.csv", 150, 1), ("vadere_postvis.traj", 20, None), ("sumo_grid4x4_300peds_fcd.xml.gz", 300, 2)],
)
def test_recordings_of_others(name, people, fps):
    read = flaneur.read_trajectories(CORPUS / name)
    assert read.frame.id.nunique() == people and (fps is None or read.fps == fps)
    assert str(people) in repr(read)
    assert 0.05 < flaneur.speeds(read).speed.median() < 2
