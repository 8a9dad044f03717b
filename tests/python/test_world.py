"""Worlds: shapes, axes, determinism, what is refused, and threads of Python beside them."""

import doctest
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import flaneur


@pytest.fixture(scope="module")
def corner():
    world = flaneur.World("corner", walkers=30, seed=3)
    world.step(120)
    return world


def test_shapes(corner):
    count = len(corner)
    assert corner.tick == 120 and count == 30
    assert corner.positions().shape == (count, 3) and corner.positions().dtype == np.float32
    assert corner.headings().shape == (count,) and corner.headings().dtype == np.float32
    assert corner.ids().shape == (count,) and len(set(corner.ids())) == count
    assert corner.poses().shape == (count, 22, 7) and len(flaneur.JOINTS) == len(flaneur.JOINT_PARENTS) == 22
    assert np.isfinite(corner.poses()).all()


def test_nobody():
    world = flaneur.World("corner", walkers=0)
    world.step(3)
    assert world.positions().shape == (0, 3) and world.poses().shape == (0, 22, 7) and len(world) == 0


def test_up_is_z_and_joints_are_where_people_are(corner):
    joint = flaneur.JOINTS.index
    places, poses = corner.positions(), corner.poses()
    assert (np.abs(poses[:, joint("hips"), :2] - places[:, :2]) < 0.4).all()
    rise = poses[:, joint("head"), 2] - places[:, 2]
    assert ((rise > 0.6) & (rise < 2.1)).all()
    assert np.allclose(np.linalg.norm(poses[:, :, 3:], axis=2), 1, atol=1e-4)


def test_headings_are_where_bodies_face(corner):
    """By shoulders, and by hips turned from facing south."""
    joint, poses = flaneur.JOINTS.index, corner.poses()
    facing = np.stack([np.cos(corner.headings()), np.sin(corner.headings())], axis=1)
    left = poses[:, joint("left_upper_arm"), :2] - poses[:, joint("right_upper_arm"), :2]
    ahead = np.stack([left[:, 1], -left[:, 0]], axis=1) / np.linalg.norm(left, axis=1, keepdims=True)
    assert np.median(np.sum(ahead * facing, axis=1)) > 0.95
    axis, w = poses[:, 0, 3:6], poses[:, 0, 6:]
    south = np.tile(np.float32([0, -1, 0]), (len(axis), 1))
    turned = south + 2 * np.cross(axis, np.cross(axis, south) + w * south)
    assert np.median(np.sum(turned[:, :2] * facing, axis=1)) > 0.95


def test_people_go_where_they_face(corner):
    before, ids = corner.positions(), corner.ids()
    corner.step(30)
    assert (corner.ids() == ids).all()
    gone = (corner.positions() - before)[:, :2]
    walked = np.linalg.norm(gone, axis=1) > 0.3
    facing = np.stack([np.cos(corner.headings()), np.sin(corner.headings())], axis=1)
    assert walked.any() and np.median(np.sum(gone * facing, axis=1)[walked] / np.linalg.norm(gone, axis=1)[walked]) > 0.9


def test_places_are_those_of_the_program(tmp_path):
    file = tmp_path / "ways.csv"
    subprocess.run(
        [flaneur.program(), "sim", "--scene", "corner", "--walkers", "12", "--seconds", "1", "--fps", "60",
         "--trajectories", str(file)], check=True, capture_output=True,
    )
    told = flaneur.read_trajectories(file).frame.query("frame == 60").set_index("id")[["x", "y", "z"]]
    world = flaneur.World("corner", walkers=12)
    world.step(60)
    assert sorted(told.index) == sorted(world.ids())
    assert np.allclose(told.loc[world.ids()].to_numpy(), world.positions(), atol=1e-4)


@pytest.mark.parametrize("scene", ["corner", "asteroid"])
def test_hash_is_that_of_the_program(scene):
    told = subprocess.run(
        [flaneur.program(), "sim", "--scene", scene, "--walkers", "40", "--seed", "5", "--seconds", "2", "--hash"],
        check=True, capture_output=True, text=True,
    ).stdout.strip()
    for threads in (1, 3):
        world = flaneur.World(scene, walkers=40, seed=5, threads=threads)
        world.step(120)
        assert f"{world.hash():016x}" == told
        assert np.isfinite(world.positions()).all() and np.isfinite(world.headings()).all()
    other = flaneur.World(scene, walkers=40, seed=6)
    other.step(120)
    assert f"{other.hash():016x}" != told


@pytest.mark.parametrize(
    "make, told",
    [
        (lambda: flaneur.World("distrct"), "There is no scene"),
        (lambda: flaneur.World("corner", walkers=-1), "-1 walkers"),
        (lambda: flaneur.World("corner", walkers=2_000_000), "1000000"),
        (lambda: flaneur.World("corner", threads=-1), "threads"),
        (lambda: flaneur.World("yard", walkers=50_000), "fit on the ground"),
        (lambda: flaneur.World("none.json"), "none.json"),
    ],
)
def test_refusals_are_exceptions(make, told):
    with pytest.raises(flaneur.Refused, match=told):
        make()


def test_a_world_does_not_go_back(corner):
    with pytest.raises(flaneur.Refused, match="back"):
        corner.step(-1)
    assert issubclass(flaneur.Refused, ValueError)


def test_other_threads_go_on_while_it_steps():
    world = flaneur.World("corner", walkers=30, threads=1)
    looks, is_stepping = 0, threading.Event()

    def step_for_long():
        is_stepping.set()
        end = time.monotonic() + 0.5
        while time.monotonic() < end:
            world.step(200)
        is_stepping.clear()

    stepping = threading.Thread(target=step_for_long)
    stepping.start()
    is_stepping.wait()
    gaps, last = [], time.monotonic()
    while is_stepping.is_set():
        time.sleep(0.001)
        looks += 1
        assert world.positions().shape[1] == 3  # between two ticks
        gaps.append(time.monotonic() - last)
        last = time.monotonic()
    stepping.join()
    assert looks > 2 and np.isfinite(world.positions()).all()


def test_a_counter_runs_while_one_call_steps():
    world = flaneur.World("corner", walkers=30, threads=1)
    world.step(1)
    begin = time.monotonic()
    world.step(600)
    ticks = int(600 * 0.6 / (time.monotonic() - begin)) + 600  # more than half a second's
    marks = {}

    def step_once():
        marks["begin"] = time.monotonic()
        world.step(ticks)
        marks["end"] = time.monotonic()

    stepping = threading.Thread(target=step_once)
    stepping.start()
    looks = []
    while stepping.is_alive():
        looks.append(time.monotonic())
        time.sleep(0.002)
    during = [t for t in looks if marks["begin"] + 0.05 < t < marks["end"] - 0.05]
    assert len(during) > 10, f"{len(during)} looks in {marks['end'] - marks['begin']:.2f} s"


@pytest.fixture
def ctrl_c():
    """Comes after 0.3 s, whatever Python is at, as a signal that does the same."""
    usual = signal.signal(signal.SIGALRM, signal.getsignal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, usual)


def test_ctrl_c_ends_a_long_step(request):
    world = flaneur.World("corner", walkers=30)
    request.getfixturevalue("ctrl_c")
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        world.step(10**9)
    assert time.monotonic() - begin < 5
    gone = world.tick
    assert 0 < gone < 10**9
    world.step(1)
    assert world.tick == gone + 1


def test_ctrl_c_ends_the_making_of_a_world(ctrl_c):
    with pytest.raises(KeyboardInterrupt):
        flaneur.World("district", walkers=50_000)
    assert len(flaneur.World("corner", walkers=3)) == 3


def test_examples_in_docstrings_do_what_they_say():
    finder, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    for thing in (flaneur.World, flaneur.level_of_service, flaneur.scenes):
        runner.run(finder.get_doctest(thing.__doc__, {"flaneur": flaneur}, thing.__name__, None, 0))
    assert runner.summarize(verbose=False).attempted >= 5 and runner.failures == 0


def test_everything_has_a_docstring_with_an_example():
    without = [
        name for name in flaneur.__all__
        if callable(thing := getattr(flaneur, name)) and name not in ("Refused", "Flow", "Profiles")
        and ">>>" not in (thing.__doc__ or "")
    ]
    without += [
        name for name in ("step", "positions", "headings", "ids", "poses", "hash")
        if ">>>" not in getattr(flaneur.World, name).__doc__
    ]
    assert not without
