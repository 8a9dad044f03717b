// Somebody else's threads.
#pragma once

namespace flaneur {

// A way to run a function several times at once, such as a game's job system. With one, the library starts no
// thread of its own.
struct TaskSystem {
    // Calls task(context, index) once for each index in [0, count), on any threads, in any order, at the same
    // time or one after the other, and returns when all calls have returned. `user` is handed back as it is.
    // The tasks never block, never throw and start no tasks themselves.
    void (*run)(void* user, int count, void (*task)(void* context, int index), void* context) = nullptr;
    void* user = nullptr;
    int threads = 1;  // that can run tasks at the same time, the calling one included: the largest `count`
};

}  // namespace flaneur
