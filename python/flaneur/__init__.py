"""Crowds that walk, and trajectories of people: simulated, read, measured and shown.

Three lines from a file to people who walk:

>>> import flaneur
>>> recorded = flaneur.read_trajectories("corridor.txt")
>>> flaneur.show(recorded)

Axes are x to the east, y to the north, z upwards; metres, seconds, radians. What cannot be done is refused: Refused, a
ValueError, says why in a sentence.
"""

from flaneur._native import JOINT_PARENTS, JOINTS, Refused, World, __version__, scenes
from flaneur.measures import Flow, Profiles, flow, individual, level_of_service, profiles, speeds, voronoi_density
from flaneur.pictures import Film, program, render, show
from flaneur.trajectories import Trajectories, read_trajectories, write_trajectories

__all__ = [
    "JOINTS",
    "JOINT_PARENTS",
    "Film",
    "Flow",
    "Profiles",
    "Refused",
    "Trajectories",
    "World",
    "__version__",
    "flow",
    "individual",
    "level_of_service",
    "profiles",
    "program",
    "read_trajectories",
    "render",
    "scenes",
    "show",
    "speeds",
    "voronoi_density",
    "write_trajectories",
]
