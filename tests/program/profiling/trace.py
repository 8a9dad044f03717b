"""trace.py FILE FRAMES [device]: FILE is a trace as docs/files.md tells it, of that many frames at least: every event has
what it must have and nothing else, zones of a row lie within each other or beside, what the device did lies within the
frame that asked for it, and zones say where the time of frames went."""
import json
import sys

path, least, wants_device = sys.argv[1], int(sys.argv[2]), sys.argv[3:] == ["device"]
with open(path, encoding="utf-8") as file:
    trace = json.load(file)
faults = []


def fault(text):
    if len(faults) < 20:
        faults.append(text)


def ns(microseconds):
    return round(microseconds * 1000)


# What the events have.
KEYS = {
    "X": {"name": str, "ph": str, "pid": int, "tid": int, "ts": (int, float), "dur": (int, float)},
    "C": {"name": str, "ph": str, "pid": int, "tid": int, "ts": (int, float), "args": dict},
    "M": {"name": str, "ph": str, "pid": int, "tid": int, "args": dict},
}
if set(trace) != {"displayTimeUnit", "otherData", "traceEvents"}:
    fault(f"it has {sorted(trace)}")
if set(trace["otherData"]) != {"program", "lost"} or trace["otherData"]["lost"] != 0:
    fault(f"otherData is {trace['otherData']}")
rows, names, counters = {}, {}, {}
for event in trace["traceEvents"]:
    keys = KEYS.get(event.get("ph"))
    if keys is None or set(event) != set(keys) or not all(isinstance(event[k], t) for k, t in keys.items()):
        fault(f"no event: {event}")
        continue
    if event["ph"] == "M" and event["name"] == "thread_name":
        if event["tid"] in names:
            fault(f"row {event['tid']} has two names")
        names[event["tid"]] = event["args"]["name"]
    if event["ph"] == "C":
        if set(event["args"]) != {"value"} or event["ts"] < 0:
            fault(f"no counter: {event}")
        counters.setdefault(event["name"], []).append(event["args"]["value"])
    if event["ph"] == "X":
        if event["ts"] < 0 or event["dur"] < 0:
            fault(f"a zone before the start, or shorter than nothing: {event}")
        rows.setdefault(event["tid"], []).append((ns(event["ts"]), ns(event["ts"]) + ns(event["dur"]), event["name"]))


def nest(row, zones):
    """Each zone with the one that it lies in, or None."""
    within, open_zones = [], []
    for zone in sorted(zones, key=lambda z: (z[0], -z[1])):
        while open_zones and open_zones[-1][1] <= zone[0]:
            open_zones.pop()
        if open_zones and zone[1] > open_zones[-1][1]:
            fault(f"{names.get(row)}: {zone} begins within {open_zones[-1]} and ends after it")
        within.append((zone, open_zones[-1] if open_zones else None))
        open_zones.append(zone)
    return within


frames = []
for row, zones in rows.items():
    if row not in names:
        fault(f"row {row} has no name")
    within = nest(row, zones)
    if names.get(row) != "main":
        continue
    frames = [zone for zone, _ in within if zone[2] == "frame"]
    # These hold others: of their own they should take next to nothing.
    holders = {"frame", "tick", "draw"}
    alone = {}
    for zone, outer in within:
        if zone[2] in holders:
            alone[zone] = alone.get(zone, 0) + zone[1] - zone[0]
        if outer and outer[2] in holders:
            alone[outer] -= zone[1] - zone[0]
    shares = []
    for frame in frames:
        mine = sum(time for zone, time in alone.items() if frame[0] <= zone[0] and zone[1] <= frame[1])
        shares.append(1 - mine / max(frame[1] - frame[0], 1))
    whole = sum(frame[1] - frame[0] for frame in frames)
    explained = sum(share * (frame[1] - frame[0]) for share, frame in zip(shares, frames)) / max(whole, 1)
    well = sum(share >= 0.95 for share in shares)
    print(f"{len(frames)} frames of {whole / max(len(frames), 1) / 1e6:.2f} ms; zones tell where {100 * explained:.2f} % of "
          f"that went, and more than 95 % in {well} of them")
    # A busy machine may halt the thread anywhere, now and then: between two zones too.
    if well < 0.75 * len(frames):
        fault(f"zones tell where {100 * explained:.1f} % of the time went, and 95 % in {well} of {len(frames)} frames")
if len(frames) < least:
    fault(f"there are {len(frames)} frames, not {least}")

device = [zone for row, zones in rows.items() if names.get(row) == "device" for zone in zones]
if wants_device:
    # Before the first frame, pipelines are warmed up.
    later = [zone for zone in device if frames and zone[0] >= frames[0][0]]
    asked = set()
    for zone in later:
        around = [frame for frame in frames if frame[0] <= zone[0] and zone[1] <= frame[1]]
        if len(around) != 1:
            fault(f"the device's {zone} lies within no frame")
        asked.update(around)
    if len(asked) < len(frames):
        fault(f"the device did something in {len(asked)} of {len(frames)} frames")
    print(f"{len(later)} zones of the device, each within its frame")
wanted = ["paths due", "people who do not get on"]
if wants_device:
    wanted += ["draws", "triangles", "bytes handed to the device", "people in sight", "people, level 0"]
for name in wanted:
    if name not in counters:
        fault(f"nothing counts {name}")
if not any(names.get(row, "").startswith("worker") and any(z[2] == "wait for work" for z in zones) for row, zones in rows.items()):
    fault("no worker waits")
for text in faults:
    print("FAILED:", text)
sys.exit(bool(faults))
