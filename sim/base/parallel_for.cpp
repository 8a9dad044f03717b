#include "sim/base/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace flaneur {

struct Workers {
    std::vector<std::thread> threads;
    std::mutex mutex;
    std::condition_variable work_ready, work_done;
    uint64_t generation = 0;  // counts loops, so that a thread never takes part in one twice
    int busy = 0;
    bool quit = false;

    // The loop being run. Written under the mutex before the generation goes up.
    const std::function<void(size_t, size_t, int)>* body = nullptr;
    size_t count = 0, grain = 1;
    std::atomic<size_t> next = 0;
};

static void run_chunks(Workers& w, int thread) {
    for (size_t begin; (begin = w.next.fetch_add(w.grain)) < w.count;) {
        (*w.body)(begin, std::min(begin + w.grain, w.count), thread);
    }
}

static void thread_main(Workers& w, int thread) {
    uint64_t seen = 0;
    std::unique_lock lock(w.mutex);
    while (true) {
        w.work_ready.wait(lock, [&] { return w.quit || w.generation != seen; });
        if (w.quit) return;
        seen = w.generation;
        lock.unlock();
        run_chunks(w, thread);
        lock.lock();
        if (--w.busy == 0) w.work_done.notify_one();
    }
}

WorkersPtr make_workers(int threads) {
    if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    WorkersPtr workers(new Workers);
    for (int i = 1; i < threads; ++i) workers->threads.emplace_back(thread_main, std::ref(*workers), i);
    return workers;
}

void WorkersDelete::operator()(Workers* w) const {
    {
        std::lock_guard lock(w->mutex);
        w->quit = true;
    }
    w->work_ready.notify_all();
    for (auto& t : w->threads) t.join();
    delete w;
}

int thread_count(const Workers& w) { return static_cast<int>(w.threads.size()) + 1; }

void parallel_for(Workers& w, size_t count, size_t grain,
                  const std::function<void(size_t, size_t, int)>& body) {
    if (count == 0) return;
    if (w.threads.empty() || count <= grain) {
        for (size_t begin = 0; begin < count; begin += grain) body(begin, std::min(begin + grain, count), 0);
        return;
    }
    {
        std::lock_guard lock(w.mutex);
        w.body = &body;
        w.count = count;
        w.grain = grain;
        w.next = 0;
        w.busy = static_cast<int>(w.threads.size());
        ++w.generation;
    }
    w.work_ready.notify_all();
    run_chunks(w, 0);
    std::unique_lock lock(w.mutex);
    w.work_done.wait(lock, [&] { return w.busy == 0; });
}

}  // namespace flaneur
