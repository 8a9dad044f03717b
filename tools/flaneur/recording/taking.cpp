#include "tools/flaneur/recording/taking.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "assets/idles.h"
#include "assets/recording/head.h"
#include "assets/recording/recorder.h"
#include "sim/sim.h"
#include "sim/state.h"
#include "sim/without.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/recording/chunks.h"
#include "tools/flaneur/recording/program.h"
#include "tools/flaneur/recording/shown.h"

namespace flaneur {

struct Taking {
    std::string path;
    RecordedAs as = RecordedAs::motion;
    bool is_exact = false;
    RecorderPtr recorder;
    const World* world = nullptr;  // that is recorded, and its ground
    const Ground* ground = nullptr;
    uint64_t mark = 0;  // of its states
    uint32_t last = 0;  // tick that was recorded
    std::optional<uint32_t> hashed;
    std::optional<Error> ended;  // why nothing more is recorded
    Without without;
    std::vector<BodyMember> bodies;
    ColumnTick columns;
    std::vector<std::byte> state;
};

namespace {

// So that it may be shown from another folder.
std::string whole_path(const std::string& path) {
    std::error_code failed;
    const std::filesystem::path whole = std::filesystem::absolute(path, failed);
    return path.empty() || failed ? path : whole.lexically_normal().string();
}

std::string whole_scene(Scene scene) {
    scene.city = whole_path(scene.city);
    scene.terrain = whole_path(scene.terrain);
    scene.demand = whole_path(scene.demand);
    if (scene.rock != k_torus) scene.rock = whole_path(scene.rock);
    for (PeopleShare& people : scene.people) people.character = whole_path(people.character);
    for (std::string& idle : scene.idles)
        if (!is_built_in_idle(idle)) idle = whole_path(idle);
    return scene_text(scene);
}

void end(Taking& t, Error why) {
    if (!t.ended) t.ended = std::move(why);
}

void add(Taking& t, uint32_t kind, uint32_t tick, std::string_view bytes) {
    if (t.ended) return;
    if (Result<void> added = add_other(*t.recorder, kind, tick, 1, bytes); !added) end(t, added.error());
}

void add_hash(Taking& t, const World& w) {
    if (t.hashed == w.tick) return;
    const uint64_t hash = hash_world(w);
    add(t, k_hash_chunk, w.tick, {reinterpret_cast<const char*>(&hash), sizeof hash});
    t.hashed = w.tick;
}

void add_state(Taking& t, uint32_t kind, const World& w) {
    save_state(w, t.state);
    if (t.state.size() > k_most_chunk_bytes)
        return end(t,
                   {"The state of so many people does not fit into a recording of inputs: record motion."});
    add(t, kind, w.tick, {reinterpret_cast<const char*>(t.state.data()), t.state.size()});
}

// Those whose bodies are drawn.
void find_bodies(Taking& t, const World& w) {
    t.bodies.clear();
    for (const WalkerId id : w.crowd.slots.living) {
        if (is_creature(w.herd, id.index)) continue;
        const uint32_t kind = w.crowd.identity.body[id.index];
        t.bodies.push_back({{body_id(id), kind, kind, w.crowd.identity.scale[id.index]}, id.index});
    }
}

void add_shown(Taking& t, const World& w) {
    catch_up(t.without, w);
    const std::vector<PoseBlock>& poses = is_whole(t.without) ? w.poses : t.without.poses;
    take_shown(w, poses, t.is_exact, t.columns);
    if (!t.is_exact) find_bodies(t, w);
    if (Result<void> added = add_tick(*t.recorder, w.tick, poses, t.bodies, {}, t.columns); !added)
        end(t, added.error());
    keep_previous(t.without, w);
}

void add_now(Taking& t, const World& w) {
    if (t.as == RecordedAs::motion)
        add_shown(t, w);
    else if (w.tick % k_state_ticks == 0)
        add_state(t, k_state_chunk, w);
    if (w.tick % k_hash_ticks == 0) add_hash(t, w);
    t.last = w.tick;
}

bool is_same_world(const Taking& t, const World& w) {
    return t.world == &w && t.ground == w.ground.get() &&
           (t.as == RecordedAs::motion || t.mark == state_mark(w));
}

}  // namespace

Result<void> check_record(const Options& options) {
    const RecordOptions& asked = options.record;
    if (asked.path.empty()) return {};
    if (asked.as == RecordedAs::inputs && options.lod > 0)
        return Error{
            "--record-as inputs cannot repeat what goes by where it is looked at from: leave out --lod, "
            "or record motion."};
    // What is refused of other outputs is refused of this one too, which is written where it will be read.
    if (is_stream(asked.path))
        return Error{"--record " + asked.path +
                     " is no file, and a recording is read from its middle too: give "
                     "the name of one."};
    const Result<PartFilePtr> checked = open_file(asked.path);
    return checked ? Result<void>() : checked.error();
}

Result<TakingPtr> begin_taking(const Options& options, const World& world) {
    const RecordOptions& asked = options.record;
    if (asked.path.empty()) return TakingPtr();
    if (Result<void> checked = check_record(options); !checked) return checked.error();
    std::error_code failed;
    std::filesystem::create_directories(std::filesystem::path(asked.path).parent_path(), failed);
    TakingPtr t(new Taking);
    t->path = asked.path;
    t->as = asked.as;
    t->is_exact = asked.as == RecordedAs::motion && asked.error == 0;
    t->world = &world;
    t->ground = world.ground.get();
    t->mark = state_mark(world);
    t->without.on = options.techniques;
    const RecordingHead head{this_program(), asked.as,   options.scene.name, whole_scene(options.scene),
                             options.force,  world.tick, asked.error};
    RecorderOptions how;
    if (asked.error > 0) how.bound = {asked.error, asked.error * (how.bound.turn / how.bound.place)};
    Result<RecorderPtr> recorder = begin_recorder(asked.path, recording_head(head), how);
    if (!recorder) return recorder.error();
    t->recorder = std::move(*recorder);
    for (const Kind& kind : world.kinds) add_tree(*t->recorder, bone_tree_of(kind.body));
    if (t->as == RecordedAs::inputs) add_state(*t, k_state_chunk, world);
    if (t->as == RecordedAs::motion) add_shown(*t, world);
    add_hash(*t, world);
    t->last = world.tick;
    if (t->ended) return *t->ended;
    return t;
}

bool take(Taking& t, const World& w) {
    if (t.ended) return false;
    if (!is_same_world(t, w))
        end(t, {t.path + " ends at tick " + std::to_string(t.last) +
                ": what is there now are other people, or "
                "another place. Record it anew."});
    if (!t.ended && w.tick > t.last) add_now(t, w);
    return !t.ended;
}

void note_change(Taking& t, const World& w) {
    if (t.ended || t.as == RecordedAs::motion) {
        if (!t.ended && w.tick < t.last)
            end(t, {t.path + " ends at tick " + std::to_string(t.last) +
                    ": what came before was changed. Record it anew."});
        return;
    }
    if (w.tick < t.last || !is_same_world(t, w))
        return end(t, {t.path + " ends at tick " + std::to_string(t.last) +
                       ": inputs cannot tell what was changed then. Record it as motion."});
    add_state(t, k_change_chunk, w);
}

void note_led(Taking& t) {
    if (t.as == RecordedAs::inputs)
        end(t, {t.path + " ends at tick " + std::to_string(t.last) +
                ": inputs cannot tell how somebody is led by hand. Record it as motion."});
}

Result<void> finish_taking(TakingPtr taking) {
    if (!taking) return {};
    Taking& t = *taking;
    if (!t.recorder) return {};
    if (!t.ended && t.hashed != t.last) add_hash(t, *t.world);
    const Result<RecorderCount> count = finish_recorder(std::move(t.recorder));
    if (t.ended) return *t.ended;
    if (!count) return count.error();
    char told[160];
    std::snprintf(told, sizeof told, " (%.1f MB, to tick %u%s", static_cast<double>(count->bytes) / 1e6,
                  t.last, count->missed > 0 ? "; some joints are off by more than was asked for" : "");
    std::string waited;
    if (count->waits > 0) waited = "; waited " + std::to_string(count->waits) + " times for what was encoded";
    say("Recorded " + t.path + told + waited + ")");
    return {};
}

void TakingDelete::operator()(Taking* taking) const {
    if (taking->recorder) (void)finish_recorder(std::move(taking->recorder));
    delete taking;
}

}  // namespace flaneur
