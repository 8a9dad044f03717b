// A fixed set of threads that run a loop in chunks. Which thread runs a chunk may vary; what a chunk computes
// must not, so results never depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace flaneur {

struct Workers;
struct WorkersDelete {
    void operator()(Workers*) const;
};
using WorkersPtr = std::unique_ptr<Workers, WorkersDelete>;

// `threads` threads in all, the calling one included; 0 takes one for every core of the machine.
WorkersPtr make_workers(int threads);
int thread_count(const Workers& workers);

// body(begin, end, thread) for consecutive chunks of at most `grain` of [0, count); thread <
// thread_count(workers). Returns when all are done. `body` must not call parallel_for on the same workers,
// and must not throw.
void parallel_for(Workers& workers, size_t count, size_t grain,
                  const std::function<void(size_t begin, size_t end, int thread)>& body);

}  // namespace flaneur
