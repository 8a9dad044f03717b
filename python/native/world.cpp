#include "sim/world.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "assets/scene.h"
#include "python/native/native.h"
#include "sim/roam.h"
#include "tools/flaneur/load/load.h"

namespace py = pybind11;

namespace flaneur {
namespace {

constexpr const char* k_world_doc =
    R"(People who walk about a scene, in ticks of 1/60 s.

``scene`` is a built-in one (``flaneur.scenes()``) or a ``.json`` file; ``walkers`` and ``seed`` are its own where they
are None. The same scene, walkers and seed give the same world to the last bit, on any number of threads: ``hash()`` is
that of ``flaneur sim --hash``. Metres and radians, x to the east, y to the north, z upwards. Rows are people, in the
same order in all that is told between two ticks.

>>> world = flaneur.World("corner", walkers=20, seed=1)
>>> world.step(60)
>>> world.tick, world.positions().shape
(60, (20, 3))
)";

// A world, and what was said while it was made. Python may ask of it on one thread while another steps.
struct HeldWorld {
    Loaded loaded;
    std::vector<std::string> notes;
    std::mutex mutex;
    World& world() { return *loaded.world; }
};

std::unique_ptr<HeldWorld> make_held(const std::string& scene, std::optional<int64_t> walkers,
                                     std::optional<uint64_t> seed, int threads) {
    Options options;
    options.scene = taken(load_scene(scene));
    if (walkers && (*walkers < 0 || *walkers > k_max_walkers))
        throw Refusal(std::to_string(*walkers) + " walkers are not 0 to " + std::to_string(k_max_walkers) +
                      ".");
    if (threads < 0 || threads > 1024)
        throw Refusal(std::to_string(threads) + " threads are not 0 to 1024; 0 is one a core.");
    if (walkers && is_recorded(options.scene))
        throw Refusal("Those who walk in " + scene + " are those who were recorded: leave walkers as it is.");
    if (walkers) options.scene.walkers = static_cast<int>(*walkers);
    if (seed) options.scene.seed = *seed;
    options.threads = threads;
    auto held = std::make_unique<HeldWorld>();
    std::optional<Error> failed;
    {
        const py::gil_scoped_release released;
        begin_loading();
        Result<Loaded> loaded = load(options);
        held->notes = end_loading();
        if (loaded)
            held->loaded = std::move(*loaded);
        else
            failed = loaded.error();
    }
    if (PyErr_Occurred()) throw py::error_already_set();
    if (failed) throw Refusal(failed->message);
    return held;
}

// Lets other threads of Python go on; comes back now and then to see whether somebody pressed Ctrl-C.
void step_world(HeldWorld& held, int64_t ticks) {
    constexpr std::chrono::milliseconds k_between_looks{50};
    if (ticks < 0) throw Refusal("A world does not go back: ticks are 0 or more.");
    while (ticks > 0) {
        {
            const py::gil_scoped_release released;
            const std::scoped_lock locked(held.mutex);
            const auto begin = std::chrono::steady_clock::now();
            do step(held.world());
            while (--ticks > 0 && std::chrono::steady_clock::now() - begin < k_between_looks);
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

// Everybody's, `count` numbers each; `tell(world, slot, to)` writes them.
template <class T, class Tell>
std::vector<T> rows_of(HeldWorld& held, size_t count, Tell tell) {
    const py::gil_scoped_release released;
    const std::scoped_lock locked(held.mutex);
    const World& world = held.world();
    std::vector<T> rows;
    rows.reserve(world.crowd.slots.living.size() * count);
    for (uint32_t slot = 0; slot < world.crowd.count; ++slot) {
        if (!is_there(world.crowd, slot)) continue;
        rows.resize(rows.size() + count);
        tell(world, slot, rows.data() + rows.size() - count);
    }
    return rows;
}

template <class T>
py::array_t<T> shaped(const std::vector<T>& rows, std::vector<py::ssize_t> each) {
    py::ssize_t count = 1;
    for (const py::ssize_t n : each) count *= n;
    each.insert(each.begin(), static_cast<py::ssize_t>(rows.size()) / count);
    return py::array_t<T>(each, rows.data());
}

void put(Vec3 ours, float* to) {
    to[0] = ours.x;
    to[1] = -ours.z;
    to[2] = ours.y;
}

Vec3 place_of(const World& world, uint32_t slot) {
    return world.roam ? world.roam->frames[slot].position : world.crowd.motion.position[slot];
}
float heading_of(const World& world, uint32_t slot) {
    if (!world.roam) {
        const float heading = world.crowd.motion.heading[slot];
        return std::atan2(-std::cos(heading), std::sin(heading));
    }
    const Vec3 ahead = rotate(world.roam->frames[slot].rotation, Vec3{0, 0, 1});
    return std::atan2(-ahead.z, ahead.x);
}

py::array_t<float> positions(HeldWorld& held) {
    return shaped(
        rows_of<float>(held, 3, [](const World& w, uint32_t slot, float* to) { put(place_of(w, slot), to); }),
        {3});
}
py::array_t<float> headings(HeldWorld& held) {
    return shaped(
        rows_of<float>(held, 1, [](const World& w, uint32_t slot, float* to) { *to = heading_of(w, slot); }),
        {});
}
py::array_t<int64_t> ids(HeldWorld& held) {
    return shaped(rows_of<int64_t>(held, 1,
                                   [](const World& w, uint32_t slot, int64_t* to) {
                                       *to = person_number(w.crowd, {slot, w.crowd.slots.generation[slot]});
                                   }),
                  {});
}
py::array_t<float> poses(HeldWorld& held) {
    constexpr size_t k_numbers = 7;
    return shaped(rows_of<float>(held, k_joint_count * k_numbers,
                                 [](const World& w, uint32_t slot, float* to) {
                                     for (int j = 0; j < k_joint_count; ++j, to += k_numbers) {
                                         const JointPose p = joint_between(w, slot, static_cast<Joint>(j), 1);
                                         put(p.position, to);
                                         put({p.rotation.x, p.rotation.y, p.rotation.z}, to + 3);
                                         to[6] = p.rotation.w;
                                     }
                                 }),
                  {k_joint_count, k_numbers});
}

template <class Value>
auto asked(Value value) {
    return [value](HeldWorld& held) {
        const py::gil_scoped_release released;
        const std::scoped_lock locked(held.mutex);
        return value(held.world());
    };
}

}  // namespace

void add_world(py::module_& module) {
    module.def("scenes", scene_names,
               "The names of the built-in scenes.\n\n>>> 'district' in flaneur.scenes()\nTrue\n");
    py::list joints, parents;
    for (int j = 0; j < k_joint_count; ++j) {
        joints.append(py::str(k_joint_names[j].data(), k_joint_names[j].size()));
        parents.append(k_joint_parents[j]);
    }
    module.attr("JOINTS") = py::tuple(joints);
    module.attr("JOINT_PARENTS") = py::tuple(parents);
    py::class_<HeldWorld> world(module, "World", k_world_doc);
    world.attr("__module__") = "flaneur";
    world
        .def(py::init(&make_held), py::arg("scene") = "district", py::arg("walkers") = py::none(),
             py::arg("seed") = py::none(), py::arg("threads") = 0)
        .def("step", step_world, py::arg("ticks") = 1,
             "So many ticks of 1/60 s. Other threads of Python go on meanwhile; Ctrl-C ends it between two "
             "ticks.\n\n>>> world.step(60)\n")
        .def_property_readonly("tick", asked([](const World& w) { return w.tick; }),
                               "How many ticks it has gone.")
        .def("positions", positions,
             "(n, 3) float32, metres: on the ground, between the feet.\n\n>>> x, y, z = "
             "world.positions().T\n")
        .def("headings", headings,
             "(n,) float32: where bodies face, radians from the east towards the north, in [-pi, "
             "pi].\n\n>>> numpy.degrees(world.headings())\n")
        .def("ids", ids,
             "(n,) int64: numbers that nobody else has had, as `flaneur sim --trajectories` writes "
             "them.\n\n>>> dict(zip(world.ids(), world.positions()))\n")
        .def("poses", poses,
             "(n, 22, 7) float32: of each of flaneur.JOINTS its place and, as x, y, z, w, the quaternion "
             "that turns it from a pose in which one stands upright and faces south.\n\n>>> heads = "
             "world.poses()[:, flaneur.JOINTS.index('head'), :3]\n")
        .def("hash", asked([](const World& w) { return hash_world(w); }),
             "Of the whole state: equal in equal runs.\n\n>>> f'{world.hash():016x}'\n")
        .def("__len__", asked([](const World& w) { return w.crowd.slots.living.size(); }))
        .def_readonly("notes", &HeldWorld::notes, "Sentences on what was assumed or left out.");
}

}  // namespace flaneur
