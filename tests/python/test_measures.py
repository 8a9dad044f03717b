"""Measures: what is known by hand, and the same numbers as `flaneur measure` writes."""

import subprocess

import numpy as np
import pandas as pd
import pytest

import flaneur
from test_trajectories import AREA, TrajectoryData, WalkableArea, two_who_walk

MIDDLE = "POLYGON ((3 0, 7 0, 7 2, 3 2, 3 0))"


def crowd(people=40, frames=60):
    """Who go to the east through a corridor of 12 x 2 m, each at a speed of its own."""
    draw = np.random.default_rng(4)
    start, y, speed = draw.uniform(0, 8, people), draw.uniform(0.1, 1.9, people), draw.uniform(0.5, 1.5, people)
    rows = pd.MultiIndex.from_product([range(people), range(frames)], names=["id", "frame"]).to_frame(index=False)
    return rows.assign(x=(start[rows.id] + speed[rows.id] * rows.frame / 25), y=y[rows.id])


def test_two_who_walk():
    data = TrajectoryData(two_who_walk(), 10.0)
    moments = flaneur.voronoi_density(data, area=MIDDLE, geometry=WalkableArea())
    at_four = moments.set_index("frame").loc[40]  # people at 4 and at 6
    assert at_four.people == 2 and abs(at_four.classic - 0.25) < 1e-6 and abs(at_four.mean_speed - 1) < 1e-3
    assert abs(at_four.time - 4) < 1e-6
    alone = flaneur.individual(data, geometry=WalkableArea())
    assert np.allclose(alone.nearest, 2, atol=1e-3) and (alone.area[:-1] > 0).all()
    assert alone.area.iloc[-1] == 0  # beyond the edge, by a rounding
    assert np.allclose(alone.density[:-1], 1 / alone.area[:-1])


def test_speeds_have_directions():
    to_the_north = two_who_walk().rename(columns={"x": "y", "y": "x"})
    speeds = flaneur.speeds(to_the_north, fps=10)
    assert speeds.columns.tolist() == ["id", "frame", "time", "x", "y", "v_x", "v_y", "speed"]
    assert np.allclose(speeds.v_y, 1, atol=1e-3) and np.allclose(speeds.v_x, 0, atol=1e-3)
    assert flaneur.speeds(to_the_north, fps=10, ends="exclude").speed.isna().sum() == 8  # two frames at each end of two


def test_flow():
    through = flaneur.flow(two_who_walk(), line=((5, 0), (5, 2)), fps=10)
    assert through.crossings.id.tolist() == [2, 1] and not through.crossings.to_left.any()
    assert np.allclose(through.crossings.time, [3, 5], atol=0.02) and np.allclose(through.crossings[["x", "y"]], [5, 1])
    back = flaneur.flow(two_who_walk(), line=((5, 2), (5, 0)), fps=10)
    assert back.crossings.to_left.all()
    assert flaneur.flow(two_who_walk(), line=((5, 3), (5, 4)), fps=10).crossings.empty


def test_as_the_program_measures(tmp_path):
    file = tmp_path / "crowd.txt"
    flaneur.write_trajectories(crowd(), file, fps=25)
    subprocess.run(
        [flaneur.program(), "measure", str(file), "--walkable", AREA, "--area", MIDDLE, "--line", "a:6,0 6,2", "--profile", "0.5",
         "--voronoi", "--service", "--individual", "--flow-seconds", "1", "--out", str(tmp_path / "told")],
        check=True, capture_output=True,
    )
    def told(name):
        return pd.read_csv(tmp_path / "told" / f"{name}.csv")

    recorded = flaneur.read_trajectories(file)
    moments = flaneur.voronoi_density(recorded, area=MIDDLE, geometry=AREA)
    area = told("area")
    assert len(area) == 60 and area.density_voronoi_per_m2.max() > 1
    for ours, theirs in (("density", "density_voronoi_per_m2"), ("classic", "density_classic_per_m2"),
                         ("mean_speed", "speed_mean_m_per_s"), ("voronoi_speed", "speed_voronoi_m_per_s"), ("covered", "covered")):
        assert np.allclose(moments[ours], area[theirs], atol=6e-5, equal_nan=True), ours
    flows = told("line-a-flow")
    intervals = flaneur.flow(recorded, line=((6, 0), (6, 2)), seconds=1).intervals
    assert len(flows) and np.allclose(intervals[["flow", "specific_flow"]], flows[["flow_per_s", "flow_per_m_s"]], atol=6e-5)
    maps = flaneur.profiles(recorded, square=0.5, area=MIDDLE, geometry=AREA)
    profile = told("profile")
    assert maps.density.shape == (4, 8) and maps.extent == (3, 7, 0, 2)
    assert np.allclose(maps.density.ravel(), profile.density_per_m2, atol=6e-5)
    assert np.allclose(maps.speed.ravel(), profile.speed_m_per_s, atol=6e-5, equal_nan=True)
    levels = flaneur.level_of_service(moments.density).value_counts(normalize=True)
    for _, row in told("service").iterrows():
        assert abs(levels.get(row.level, 0) - row.share) < 1e-3
    people, cells = told("individual"), flaneur.individual(recorded, geometry=AREA)
    assert len(people) == len(cells) and np.allclose(people["nearest_m"], cells.nearest, atol=6e-4)


def test_rows_in_any_order_measure_the_same():
    frame = crowd()
    mixed = frame.sample(frac=1, random_state=2)
    for measure in (flaneur.speeds, flaneur.individual, flaneur.voronoi_density):
        pd.testing.assert_frame_equal(measure(frame), measure(mixed))


def test_squares_are_in_rows_from_the_north():
    one = pd.DataFrame({"id": 1, "frame": range(10), "x": 0.5, "y": 1.5})
    maps = flaneur.profiles(one, square=1, method="classic", geometry="POLYGON ((0 0, 3 0, 3 2, 0 2, 0 0))")
    assert maps.density.tolist() == [[1, 0, 0], [0, 0, 0]] and maps.frames == 10


def test_levels_of_service():
    assert [flaneur.level_of_service(d) for d in (0, 0.4, 0.7, 1, 2, 3)] == list("ABCDEF")
    assert flaneur.level_of_service(1.0, of="queue") == "B"
    assert flaneur.level_of_service(np.array([[0.1, np.nan]])).tolist() == [["A", ""]]


@pytest.mark.parametrize(
    "measure, told",
    [
        (lambda f: flaneur.speeds(f, ends="never"), "ends is exclude, adaptive or single_sided"),
        (lambda f: flaneur.speeds(f, frame_step=-1), "frame_step"),
        (lambda f: flaneur.voronoi_density(f, area="POLYGON ((90 90, 91 90, 91 91, 90 90))"), "Nobody can walk"),
        (lambda f: flaneur.voronoi_density(f, area="POLYGON"), "area"),
        (lambda f: flaneur.voronoi_density(f, area=3), "well-known text"),
        (lambda f: flaneur.voronoi_density(f, cut_off=-1), "cut_off"),
        (lambda f: flaneur.profiles(f, square=1e-5), "squares"),
        (lambda f: flaneur.profiles(f, square=0), "square"),
        (lambda f: flaneur.profiles(f, method="kriging"), "method is classic, voronoi or gaussian"),
        (lambda f: flaneur.profiles(f, every=0), "every"),
        (lambda f: flaneur.flow(f, line=((1, 1), (1, 1))), "two places"),
        (lambda f: flaneur.flow(f, line=(1, 2)), "two places"),
        (lambda f: flaneur.flow(f, line=((0, 0), (1, 1)), seconds=0), "seconds"),
        (lambda f: flaneur.level_of_service(1, of="lifts"), "walkway"),
    ],
)
def test_refusals(measure, told):
    with pytest.raises(flaneur.Refused, match=told):
        measure(crowd())
