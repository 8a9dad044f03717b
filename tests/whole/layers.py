#!/usr/bin/env python3
"""layers.py ROOT: who includes whom, how full the rooms are, and that names are defined once.

The table says which rooms a room may include, besides itself. A room may name only rooms above it, so no circle can be
stated; every folder that holds code is a room; and an arrow that nobody takes any more has to go. Where a folder's
public headers lie below its other rooms and its sources above them, those are two rooms: "assets" and "assets sources".
"""
import os
import re
import sys

ROOMS = """
sim/base:
sim/body: sim/base
sim/ik: sim/base
sim/limbs: sim/base
sim/ground: sim/base
sim/movers: sim/base, sim/ground
sim/ball: sim/base, sim/ground
sim/linkages: sim/base, sim/ik, sim/movers
sim/navigation: sim/base, sim/ground
sim/ways: sim/base
sim/gait/curves: sim/base
sim/gait: sim/base, sim/body, sim/gait/curves, sim/ground
sim/hands: sim/base, sim/gait
sim/pose: sim/base, sim/gait, sim/gait/curves, sim/ground, sim/ik, sim/limbs
sim/stepper: sim/base, sim/gait, sim/gait/curves, sim/movers, sim/pose
sim/animation: sim/base, sim/pose
sim/fall: sim/base, sim/body, sim/gait, sim/ground, sim/pose
sim/lamps: sim/base, sim/navigation
sim/lanes: sim/base, sim/ground, sim/lamps
sim/fellows: sim/base
sim/crowd: sim/base, sim/body, sim/fellows, sim/ground, sim/lamps, sim/lanes, sim/limbs, sim/navigation, sim/ways
sim/coming: sim/base, sim/crowd
sim/vehicles: sim/base, sim/crowd, sim/lanes
sim/alone: sim/crowd, sim/gait, sim/ground
sim/figures: sim/alone, sim/animation, sim/base, sim/crowd, sim/gait, sim/ground, sim/pose
sim/deeds: sim/alone, sim/base, sim/crowd, sim/fall, sim/gait, sim/ground, sim/movers, sim/pose
sim/pastimes: sim/base, sim/crowd, sim/deeds, sim/fall, sim/ground, sim/pose
sim/company: sim/base, sim/coming, sim/crowd, sim/deeds, sim/fall, sim/gait, sim/hands, sim/pose
sim/surface: sim/base
sim/creature: sim/base, sim/linkages, sim/surface
sim/alongside: sim/base, sim/fall, sim/ground, sim/movers, sim/pose
sim/traced: sim/base
sim: sim/alongside, sim/animation, sim/ball, sim/base, sim/body, sim/coming, sim/company, sim/creature, sim/crowd, sim/deeds, sim/fall, sim/figures, sim/gait, sim/ground, sim/hands, sim/lamps, sim/lanes, sim/limbs, sim/linkages, sim/movers, sim/navigation, sim/pastimes, sim/pose, sim/stepper, sim/surface, sim/traced, sim/vehicles
sim/traced sources: sim, sim/base, sim/crowd, sim/traced
sim/alongside sources: sim, sim/alongside, sim/base, sim/fall
sim/fall sources: sim, sim/base, sim/fall, sim/pose

assets/files: sim/base
assets/terrain: assets/files, sim/base
assets: sim/alongside, sim/animation, sim/ball, sim/base, sim/body, sim/crowd, sim/fall, sim/ground, sim/lamps, sim/lanes, sim/limbs, sim/pastimes
assets/plan: assets, sim/base, sim/lamps
assets/trajectories: assets, assets/files, assets/plan, sim/base, sim/ground
assets/measures: assets/trajectories, sim/base, sim/ground
assets/trajectories/formats: assets/files, assets/trajectories, sim/base
assets/trajectories/ground: assets/files, assets/plan, assets/trajectories, assets/trajectories/formats, sim/base
assets/traced: assets, assets/plan, assets/trajectories, sim/base, sim/crowd, sim/traced
assets/recording: sim/base, sim/body, sim/pose
assets/pastimes: assets, sim/base, sim/ground, sim/pastimes
assets/props: assets, sim/base
assets/people/shapes: sim/base
assets/alongside: assets, assets/people/shapes, sim/alongside, sim/base
assets/people: assets, assets/people/shapes, sim/base, sim/body
assets/levels: assets, assets/people, sim/base
assets/district: assets, assets/plan, sim/base, sim/lanes
assets/stages: assets, sim, sim/base, sim/deeds, sim/figures, sim/linkages, sim/movers, sim/surface, sim/ways
assets/osm: assets, assets/files, assets/plan, assets/terrain, sim/base
assets/osm/read: assets, assets/files, assets/osm
assets/osm/street: assets, assets/osm, assets/plan, sim/lanes
assets/demand: assets, assets/files, assets/osm, sim/base, sim/coming
assets/cache: assets, assets/files, sim/base, sim/navigation
assets/gltf: assets, assets/files, sim/base
assets/gltf/group: assets, assets/files, assets/gltf, sim/base
assets/gltf/city: assets, assets/files, assets/gltf, sim/base, sim/ground
assets/gltf/character: assets, assets/cache, assets/files, assets/gltf, assets/people, sim/animation, sim/base, sim/body
assets/scene: assets, assets/files, sim/base, sim/ways
assets sources: sim/animation, sim/body, assets, sim/base

shaders:
shaders/base: shaders
shaders/city: shaders/base
shaders/people: shaders, shaders/base
shaders/light: shaders/base
shaders/picture: shaders, shaders/base
shaders/shadow: shaders, shaders/base, shaders/people
shaders/views: shaders/base, shaders/people

renderer: shaders, sim/base
renderer/device: renderer, sim/base
renderer/light: renderer, shaders/light, sim/base
renderer/visible: renderer, renderer/light, sim/base
renderer/people: renderer, renderer/visible, sim/base
renderer/pipelines: renderer, renderer/device, renderer/people
renderer/loaded: renderer, renderer/device, renderer/people, renderer/pipelines, renderer/visible, sim/base
renderer/frame: renderer, renderer/device, renderer/light, renderer/loaded, renderer/people, renderer/pipelines, renderer/visible, sim/base
renderer/passes: renderer/frame
renderer/picture: renderer, renderer/device, renderer/frame, renderer/passes, sim/base
renderer sources: renderer, renderer/device, renderer/picture, renderer/visible, sim/base

tools/rendercheck/files: sim/base
tools/rendercheck/process: sim/base
tools/rendercheck/picture: sim/base, tools/rendercheck/files
tools/rendercheck/verdict: tools/rendercheck/picture

tools/extract: assets, assets/alongside, assets/props, renderer, sim, sim/alongside, sim/base, sim/coming, sim/crowd, sim/deeds, sim/figures, sim/movers, sim/pastimes, sim/pose

tools/flaneur/console: sim/base
tools/flaneur/plot:
tools/flaneur/measure: assets/files, assets/measures, sim, sim/base, sim/crowd
tools/flaneur/options: assets, assets/files, assets/measures, assets/trajectories, assets/recording, sim/base, sim/pose, tools/flaneur/measure
tools/rendercheck/suite: assets/files, sim/base, tools/flaneur/options, tools/rendercheck/files, tools/rendercheck/verdict
tools/rendercheck/references: assets/files, sim/base, tools/rendercheck/files, tools/rendercheck/process, tools/rendercheck/suite
tools/rendercheck/check: assets/files, tools/flaneur/options, tools/rendercheck/files, tools/rendercheck/process, tools/rendercheck/references, tools/rendercheck/suite, tools/rendercheck/verdict
tools/rendercheck/report: tools/rendercheck/check
tools/rendercheck: assets/files, tools/flaneur/options, tools/rendercheck/files, tools/rendercheck/references, tools/rendercheck/report, tools/rendercheck/suite
tools/flaneur/output: assets/files, sim/base, tools/flaneur/console, tools/flaneur/measure, tools/flaneur/options
tools/flaneur/tracks: assets/files, assets/trajectories, sim, sim/base, tools/flaneur/output
tools/flaneur/validate: assets/measures, assets/trajectories, sim, sim/base, sim/ground, sim/navigation, tools/flaneur/console, tools/flaneur/measure, tools/flaneur/plot
tools/flaneur/measures: assets/measures, assets/trajectories, sim/base, tools/flaneur/options, tools/flaneur/plot
tools/flaneur/load: assets, assets/cache, assets/demand, assets/files, assets/gltf/character, assets/gltf/city, assets/pastimes, assets/stages, assets/traced, sim, sim/alongside, sim/base, sim/pastimes, tools/flaneur/console, tools/flaneur/options
tools/flaneur/recording: assets, assets/files, assets/recording, sim, sim/alongside, sim/base, sim/crowd, sim/pastimes, sim/pose, tools/flaneur/console, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output
tools/flaneur/check: assets/files, sim, sim/base, tools/flaneur/console, tools/flaneur/options
tools/flaneur/gait/measure: sim/base, sim/body, sim/crowd, sim/gait, sim/gait/curves, sim/ground, sim/hands, sim/pose, tools/flaneur/output
tools/flaneur/gait: sim, sim/base, sim/body, sim/gait/curves, tools/flaneur/console, tools/flaneur/gait/measure, tools/flaneur/output, tools/flaneur/plot
tools/flaneur/gait/people: tools/flaneur/gait/measure, sim/base, sim/body, tools/flaneur/console, tools/flaneur/gait, tools/flaneur/options
tools/flaneur/motion: assets/gltf, sim/base, sim/body, sim/pose
tools/flaneur/export: assets/files, assets/gltf/group, assets/trajectories, sim, sim/base, tools/extract, tools/flaneur/console, tools/flaneur/load, tools/flaneur/motion, tools/flaneur/options, tools/flaneur/output, tools/flaneur/recording, tools/flaneur/tracks
tools/flaneur/overlay: renderer, sim, sim/deeds, sim/gait, sim/stepper, sim/ways, tools/extract, tools/flaneur/measure, tools/flaneur/options
tools/flaneur/view: assets, assets/cache, renderer, renderer/light, sim, sim/base, tools/flaneur/console, tools/extract, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output, tools/flaneur/overlay, tools/flaneur/recording
tools/flaneur/history: sim, sim/base
tools/flaneur/window/ask: assets, renderer, sim/base, sim/body, sim/limbs, sim/pose, tools/flaneur/gait/measure, tools/flaneur/view
tools/flaneur/window/cameras: assets, renderer, sim, tools/flaneur/options, tools/flaneur/view
tools/flaneur/window/change: assets, renderer, sim, sim/base, sim/crowd, sim/linkages, sim/navigation, tools/flaneur/options
tools/flaneur/window/exhibits: renderer, sim/linkages, tools/flaneur/options
tools/flaneur/window/steppers: renderer, sim/base, tools/flaneur/options
tools/flaneur/window/frame:
tools/flaneur/window/measure: tools/flaneur/measure, tools/flaneur/view
tools/flaneur/window/open: renderer, tools/flaneur/options, tools/flaneur/view
tools/flaneur/window/record: renderer, tools/flaneur/options, tools/flaneur/output, tools/flaneur/view
tools/flaneur/window/settings: renderer, sim/base, tools/flaneur/options, tools/flaneur/view
tools/flaneur/window/time: assets, sim, tools/extract, tools/flaneur/history, tools/flaneur/measure, tools/flaneur/overlay, tools/flaneur/window/change
tools/flaneur/window/kept: assets, tools/flaneur/window/cameras, tools/flaneur/window/time
tools/flaneur/window: renderer, sim, tools/flaneur/options, tools/flaneur/view, tools/flaneur/window/ask, tools/flaneur/window/cameras, tools/flaneur/window/change, tools/flaneur/window/exhibits, tools/flaneur/window/frame, tools/flaneur/window/kept, tools/flaneur/window/measure, tools/flaneur/window/open, tools/flaneur/window/record, tools/flaneur/window/settings, tools/flaneur/window/steppers, tools/flaneur/window/time
tools/flaneur/window/panels: tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/ask, tools/flaneur/window/change
tools/flaneur/window/ask sources: assets/files, sim, sim/alongside, sim/base, sim/gait, sim/pastimes, tools/extract, tools/flaneur/overlay, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/ask, tools/flaneur/window/change, tools/flaneur/window/measure
tools/flaneur/window/cameras sources: sim/base, tools/flaneur/output, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/cameras
tools/flaneur/window/change sources: assets, assets/files, assets/pastimes, assets/stages, sim, sim/alongside, sim/base, sim/pastimes, sim/ways, tools/extract, tools/flaneur/options, tools/flaneur/output, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/change, tools/flaneur/window/steppers, tools/flaneur/window/time
tools/flaneur/window/steppers sources: sim, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/change, tools/flaneur/window/open, tools/flaneur/window/steppers
tools/flaneur/window/exhibits sources: renderer, tools/extract, tools/flaneur/overlay, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/change, tools/flaneur/window/exhibits
tools/flaneur/window/frame sources: renderer, sim/base, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/frame
tools/flaneur/window/kept sources: assets/files, sim/base, tools/flaneur/console, tools/flaneur/output, tools/flaneur/window, tools/flaneur/window/kept, tools/flaneur/window/open
tools/flaneur/window/measure sources: renderer, tools/flaneur/console, tools/flaneur/measure, tools/flaneur/output, tools/flaneur/overlay, tools/flaneur/window, tools/flaneur/window/ask, tools/flaneur/window/measure, tools/flaneur/window/time
tools/flaneur/window/open sources: assets, assets/files, tools/flaneur/console, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output, tools/flaneur/window, tools/flaneur/window/open
tools/flaneur/window/record sources: sim/base, tools/flaneur/console, tools/flaneur/load, tools/flaneur/output, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/change, tools/flaneur/window/measure, tools/flaneur/window/record
tools/flaneur/window/settings sources: assets/files, tools/flaneur/console, tools/flaneur/output, tools/flaneur/window, tools/flaneur/window/settings
tools/flaneur/window/time sources: renderer, sim, sim/base, tools/flaneur/load, tools/flaneur/recording, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/measure, tools/flaneur/window/time
tools/flaneur/window sources: renderer, sim/base, tools/flaneur/console, tools/flaneur/measure, tools/flaneur/options, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/ask, tools/flaneur/window/cameras, tools/flaneur/window/change, tools/flaneur/window/exhibits, tools/flaneur/window/frame, tools/flaneur/window/measure, tools/flaneur/window/panels, tools/flaneur/window/settings, tools/flaneur/window/steppers
tools/flaneur/sheets: assets, sim/base, sim/body, sim/crowd, tools/flaneur/console, tools/extract, tools/flaneur/gait/measure, tools/flaneur/gait/people, tools/flaneur/options, tools/flaneur/output, tools/flaneur/view
tools/flaneur/city: assets, assets/files, assets/gltf/city, sim, sim/alongside, sim/base, sim/deeds, sim/ground, sim/pastimes, tools/flaneur/console, tools/extract, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output
tools/flaneur/bench: tools/rendercheck/verdict, assets/files, assets/gltf/character, sim, sim/animation, sim/base, sim/fall, sim/gait, sim/linkages, sim/ik, sim/pose, tools/flaneur/console, tools/extract, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/cameras
tools/flaneur/bench/gauntlet: assets/files, tools/flaneur/bench, tools/flaneur/console, tools/flaneur/gait, tools/flaneur/gait/people, tools/flaneur/load, tools/flaneur/options, tools/flaneur/output, tools/flaneur/plot, sim/base
tools/flaneur/bench/study: tools/rendercheck/verdict, sim/pose, tools/flaneur/bench, tools/flaneur/console, tools/flaneur/load, tools/flaneur/output, tools/flaneur/plot, tools/flaneur/view
tools/flaneur: assets, assets/cache, assets/files, assets/gltf, assets/gltf/group, assets/recording, assets/trajectories, sim, sim/base, tools/flaneur/bench, tools/flaneur/bench/gauntlet, tools/flaneur/bench/study, tools/flaneur/check, tools/flaneur/city, tools/flaneur/console, tools/flaneur/export, tools/flaneur/gait, tools/flaneur/gait/people, tools/flaneur/load, tools/flaneur/measure, tools/flaneur/measures, tools/flaneur/motion, tools/flaneur/options, tools/flaneur/output, tools/flaneur/recording, tools/flaneur/sheets, tools/flaneur/tracks, tools/flaneur/validate, tools/flaneur/view, tools/flaneur/window, tools/flaneur/window/ask, tools/flaneur/window/change, tools/flaneur/window/kept, tools/flaneur/window/measure, tools/flaneur/window/open, tools/flaneur/window/record, tools/flaneur/window/settings
python/native: assets, assets/measures, assets/trajectories, sim, sim/base, tools/flaneur/console, tools/flaneur/load
"""
MOST_FILES = 25
CODE = (".h", ".cpp", ".glsl", ".vert", ".frag", ".comp")
TOPS = ("sim", "assets", "renderer", "shaders", "tools", "python")

faults = []


def read_table(table):
    rooms = {}
    for line in filter(None, table.splitlines()):
        room, _, allowed = line.partition(":")
        rooms[room.strip()] = words = [word.strip() for word in allowed.split(",") if word.strip()]
        faults.extend(f"{room}: {word} does not stand above it in the table" for word in words if word not in rooms)
        if room.strip() in words:
            faults.append(f"{room} names itself")
    return rooms


def files_below(root, top):
    for folder, folders, names in os.walk(os.path.join(root, top)):
        folders[:] = sorted(f for f in folders if not f.startswith(".") and f not in ("build", "out"))
        for name in sorted(names):
            yield os.path.relpath(os.path.join(folder, name), root)


def check_arrows(root, rooms):
    def room_of(path):
        folder = os.path.dirname(path)
        sources = folder + " sources"
        return sources if sources in rooms and not path.endswith(".h") else folder

    taken = set()
    for path in (p for top in TOPS for p in files_below(root, top) if p.endswith(CODE)):
        room = room_of(path)
        if room not in rooms:
            faults.append(f"{path}: {room} is no room of the table")
            continue
        taken.add((room, room))
        with open(os.path.join(root, path), encoding="utf-8") as file:
            included = re.findall(r'^\s*#\s*include\s+"([^"]+)"', file.read(), re.MULTILINE)
        for header in (h for h in included if h.split("/")[0] in TOPS):
            other = room_of(header)
            taken.add((room, other))
            if other != room and other not in rooms[room]:
                faults.append(f"{path} includes {header}: {room} may not include {other}")
    for room, allowed in rooms.items():
        if (room, room) not in taken:
            faults.append(f"{room} is a room of the table without code")
        faults.extend(f"{room} includes nothing of {o} any more" for o in allowed if (room, o) not in taken)


def check_fullness(root):
    count = {}
    for path in files_below(root, "."):
        folder = os.path.dirname(os.path.normpath(path))
        count[folder] = count.get(folder, 0) + 1
    for folder, files in sorted(count.items()):
        if files > MOST_FILES and folder != "docs/images" and not folder.startswith("tests/golden/golden/"):
            faults.append(f"{folder} holds {files} files side by side, more than {MOST_FILES}")


TOKEN = re.compile(
    r"""//[^\n]*|/\*.*?\*/|\#(?:[^\n\\]|\\.)*                      # comments and what the preprocessor reads
    |R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+'    # strings, characters
    |(?:inline\s+)?namespace\b[^{;=]*(?=[{;=])
    |\busing\s+(?P<alias>[A-Z]\w*)\s*=
    |(?:template\s*<[^{};]*>\s*)?\b(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+(?P<name>[A-Z]\w*)[^;{}()=]*(?=\{)
    |[{}]""",
    re.VERBOSE | re.DOTALL,
)


def types_of(text, is_header):
    """The types that TEXT defines in namespaces that other files share, each with its namespace. Aliases count in headers."""
    scopes, opening = [], None
    for match in TOKEN.finditer(text):
        token = match.group(0)
        if re.match(r"(inline\s+)?namespace\b", token):
            opening = token.split("namespace")[1].strip() or "nameless"
        elif name := match.group("name") or (is_header and match.group("alias")):
            if all(scope and scope != "nameless" for scope in scopes) and not token.split(name)[1].startswith("<"):
                yield "::".join(scopes + [name])
        elif token == "{":
            scopes.append(opening)  # None: neither a namespace's
            opening = None
        elif token == "}" and scopes:
            scopes.pop()


def check_names(root):
    defined = {}
    for path in (p for top in TOPS + ("tests",) for p in files_below(root, top) if p.endswith((".h", ".cpp"))):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for name in types_of(file.read(), path.endswith(".h")):
                defined.setdefault(name, []).append(path)
    faults.extend(f"{name} is defined in {' and in '.join(where)}" for name, where in defined.items() if len(where) > 1)
    return len(defined)


root = sys.argv[1]
rooms = read_table(ROOMS)
check_arrows(root, rooms)
check_fullness(root)
types = check_names(root)
print(f"{len(rooms)} rooms, {types} types that files share.")
for fault in faults:
    print("FAILED:", fault)
sys.exit(1 if faults or types < 100 else 0)
