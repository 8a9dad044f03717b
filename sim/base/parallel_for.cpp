#include "sim/base/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "sim/base/zone.h"

namespace flaneur {

namespace {

struct Loop {
    LoopBody body;
    size_t count = 0, grain = 1;
    const char* zone = nullptr;  // that it is run in
    std::atomic<size_t> next = 0;
    std::atomic<bool> has_failed = false;
    std::exception_ptr failure;  // of the first that failed
};

void run_chunks(Loop& loop, int thread) {
    try {
        for (size_t begin; !loop.has_failed && (begin = loop.next.fetch_add(loop.grain)) < loop.count;)
            loop.body.call(loop.body.context, begin, std::min(begin + loop.grain, loop.count), thread);
    } catch (...) {
        if (!loop.has_failed.exchange(true)) loop.failure = std::current_exception();
    }
}

}  // namespace

struct Workers {
    TaskSystem tasks;  // instead of threads, if it can run
    std::vector<std::thread> threads;
    std::mutex mutex;
    std::condition_variable loop_opened, loop_left;
    // Under the mutex:
    Loop* loop = nullptr;     // open to who wakes; its owner closes it when no chunk is left to take
    uint64_t generation = 0;  // counts loops, so that a thread never takes part in one twice
    int inside = 0;           // threads that work on it
    bool quit = false;
};

// Until a loop is open that the thread has not seen yet; false: the last one is over.
static bool wait_for_loop(Workers& w, std::unique_lock<std::mutex>& lock, uint64_t seen) {
    FLANEUR_ZONE("wait for work");
    w.loop_opened.wait(lock, [&] { return w.quit || (w.loop && w.generation != seen); });
    return !w.quit;
}

static void thread_main(Workers& w, int thread) {
    name_trace_thread("worker", thread);
    uint64_t seen = 0;
    std::unique_lock lock(w.mutex);
    while (wait_for_loop(w, lock, seen)) {
        seen = w.generation;
        Loop& loop = *w.loop;
        ++w.inside;
        lock.unlock();
        {
            FLANEUR_ZONE(loop.zone ? loop.zone : "work");
            run_chunks(loop, thread);
        }
        lock.lock();
        if (--w.inside == 0) w.loop_left.notify_one();
    }
}

WorkersPtr make_workers(int threads) {
    if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    WorkersPtr workers(new Workers);
    for (int i = 1; i < threads; ++i) workers->threads.emplace_back(thread_main, std::ref(*workers), i);
    return workers;
}

WorkersPtr make_workers(const TaskSystem& tasks) {
    assert(tasks.run && tasks.threads >= 1);
    WorkersPtr workers(new Workers);
    workers->tasks = tasks;
    return workers;
}

void WorkersDelete::operator()(Workers* w) const {
    {
        std::lock_guard lock(w->mutex);
        w->quit = true;
    }
    w->loop_opened.notify_all();
    for (auto& t : w->threads) t.join();
    delete w;
}

int thread_count(const Workers& w) {
    return w.tasks.run ? w.tasks.threads : static_cast<int>(w.threads.size()) + 1;
}

static void run_all(Workers& w, Loop& loop) {
    if (thread_count(w) == 1 || loop.count <= loop.grain) return run_chunks(loop, 0);
    if (w.tasks.run) {
        size_t chunks = (loop.count + loop.grain - 1) / loop.grain;
        int tasks = static_cast<int>(std::min<size_t>(chunks, static_cast<size_t>(w.tasks.threads)));
        auto task = [](void* context, int index) { run_chunks(*static_cast<Loop*>(context), index); };
        w.tasks.run(w.tasks.user, tasks, task, &loop);
        return;
    }
    {
        std::lock_guard lock(w.mutex);
        w.loop = &loop;
        ++w.generation;
    }
    w.loop_opened.notify_all();
    run_chunks(loop, 0);
    FLANEUR_ZONE("wait for workers");
    // Only for those who took a chunk: who still sleeps finds the loop closed.
    std::unique_lock lock(w.mutex);
    w.loop = nullptr;
    w.loop_left.wait(lock, [&] { return w.inside == 0; });
}

void run_loop(Workers& w, size_t count, size_t grain, LoopBody body) {
    if (count == 0) return;
    Loop loop{body, count, grain, innermost_zone(), 0, false, nullptr};
    run_all(w, loop);
    if (loop.failure) std::rethrow_exception(loop.failure);
}

}  // namespace flaneur
