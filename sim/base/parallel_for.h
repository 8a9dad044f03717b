// A fixed set of threads that run a loop in chunks. Which thread runs a chunk may vary; what a chunk computes
// must not, so results never depend on the number of threads.
#pragma once

#include <cstddef>
#include <memory>

#include "sim/base/tasks.h"

namespace flaneur {

struct Workers;
struct WorkersDelete {
    void operator()(Workers*) const;
};
using WorkersPtr = std::unique_ptr<Workers, WorkersDelete>;

// `threads` threads in all, the calling one included; 0 takes one for every core of the machine.
WorkersPtr make_workers(int threads);
// Somebody else's threads: none is started.
WorkersPtr make_workers(const TaskSystem& tasks);
int thread_count(const Workers& workers);

// What a loop does with one chunk; `context` is handed back as it is.
struct LoopBody {
    void (*call)(void* context, size_t begin, size_t end, int thread);
    void* context;
};
void run_loop(Workers& workers, size_t count, size_t grain, LoopBody body);

// body(begin, end, thread) for consecutive chunks of at most `grain` of [0, count); thread <
// thread_count(workers), and no two chunks run on one `thread` at a time. Returns when all are done.
// Allocates nothing. `body` must not call parallel_for on the same workers; what it throws comes out of this
// call, when all are done.
template <class Body>
void parallel_for(Workers& workers, size_t count, size_t grain, const Body& body) {
    auto call = [](void* context, size_t begin, size_t end, int thread) {
        (*static_cast<const Body*>(context))(begin, end, thread);
    };
    run_loop(workers, count, grain, {call, const_cast<Body*>(&body)});
}

}  // namespace flaneur
