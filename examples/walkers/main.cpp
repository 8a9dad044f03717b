// A thousand people stroll about a plane of a hundred by a hundred metres. After ten seconds it prints where
// they are, and the hash of all that they did, which is the same on every x86-64 machine.
#include <flaneur/sim/sim.h>

#include <cinttypes>
#include <cstdio>

using namespace flaneur;

static int fail(const Error& error) {
    std::fprintf(stderr, "walkers: %s\n", error.message.c_str());
    return 1;
}

int main() {
    const Vec3 corners[] = {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    Result<WorldPtr> made = make_world({corners, triangles}, {.capacity = 1000});
    if (!made) return fail(made.error());
    World& world = **made;

    for (int i = 0; i < 1000; ++i) {
        Result<WalkerId> walker = add_walker(world, {.wanders = true});
        if (!walker) return fail(walker.error());
    }
    for (int tick = 0; tick < 600; ++tick) step(world);

    for (WalkerId walker : walkers(world)) {
        Vec3 place = motion_of(world, walker)->position;
        std::printf("%" PRIu32 " is at %.2f %.2f\n", walker.index, place.x, place.z);
    }
    std::printf("hash %016" PRIx64 "\n", hash_world(world));
}
