// Zones: what is recorded, and that nothing is where nobody asked.
#include <gtest/gtest.h>

#include <thread>

#include "sim/base/parallel_for.h"
#include "sim/base/zone.h"
#include "tests/sim/allocations.h"

namespace flaneur {
namespace {

const TraceThread* thread_named(const std::vector<TraceThread>& threads, const std::string& name) {
    for (const TraceThread& thread : threads)
        if (thread.name == name) return &thread;
    return nullptr;
}

TEST(Zone, IsRecordedWithinThoseAroundIt) {
    begin_trace();
    {
        FLANEUR_ZONE("outer");
        FLANEUR_ZONE("inner");
        EXPECT_STREQ(innermost_zone(), "inner");
        trace_counter("people", 7);
    }
    EXPECT_EQ(innermost_zone(), nullptr);
    const std::vector<TraceThread> threads = end_trace();
    ASSERT_EQ(threads.size(), 1u);
    EXPECT_EQ(threads[0].name, "main");
    EXPECT_EQ(threads[0].lost, 0u);
    ASSERT_EQ(threads[0].events.size(), 3u);  // as they ended
    const TraceEvent &people = threads[0].events[0], &inner = threads[0].events[1],
                     &outer = threads[0].events[2];
    EXPECT_EQ(people.kind, TraceKind::counter);
    EXPECT_EQ(people.value, 7);
    EXPECT_STREQ(inner.name, "inner");
    EXPECT_STREQ(outer.name, "outer");
    EXPECT_LE(outer.begin, inner.begin);
    EXPECT_LE(inner.begin, people.begin);
    EXPECT_LE(people.begin, inner.end);
    EXPECT_LE(inner.end, outer.end);
}

TEST(Zone, IsNothingWhereNobodyAsked) {
    const size_t before = allocations();
    {
        FLANEUR_ZONE("unasked");
        EXPECT_EQ(innermost_zone(), nullptr);
        trace_counter("unasked", 1);
    }
    EXPECT_EQ(allocations(), before);
    begin_trace();
    for (const TraceThread& thread : end_trace()) EXPECT_TRUE(thread.events.empty());
    { FLANEUR_ZONE("afterwards"); }
    begin_trace();
    EXPECT_TRUE(end_trace().empty());
}

TEST(Zone, TellsItsTimeWithoutATraceToo) {
    double ms = -1;
    {
        FLANEUR_ZONE("timed", ms);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_GE(ms, 2);
}

TEST(Zone, ThatALoopRunsInIsWhatItsWorkersAreAt) {
    const WorkersPtr workers = make_workers(2);
    begin_trace();
    bool has_helped = false;  // the other thread may come too late for a loop
    while (!has_helped) {
        FLANEUR_ZONE("loop");
        std::atomic<int> inside = 0;
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        parallel_for(*workers, 2, 1, [&](size_t, size_t, int thread) {
            ++inside;
            while (inside < 2 && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
            if (thread == 1) has_helped = true;
        });
    }
    const std::vector<TraceThread> threads = end_trace();
    const TraceThread* const worker = thread_named(threads, "worker 1");
    ASSERT_TRUE(worker);
    EXPECT_STREQ(worker->events.back().name, "loop");
    const TraceThread* const main = thread_named(threads, "main");
    ASSERT_TRUE(main);
    EXPECT_STREQ(main->events.back().name, "loop");
    EXPECT_STREQ(main->events[main->events.size() - 2].name, "wait for workers");
}

TEST(Zone, KeepsTheLastOfMany) {
    begin_trace();
    const size_t more = 1000;
    for (size_t i = 0; i < k_trace_events + more; ++i) trace_counter("i", static_cast<double>(i));
    const std::vector<TraceThread> threads = end_trace();
    ASSERT_EQ(threads.size(), 1u);
    EXPECT_EQ(threads[0].lost, more);
    ASSERT_EQ(threads[0].events.size(), k_trace_events);
    EXPECT_EQ(threads[0].events.front().value, more);
    EXPECT_EQ(threads[0].events.back().value, k_trace_events + more - 1);
}

TEST(Zone, OfAThreadThatIsGoneStays) {
    begin_trace();
    std::thread([] {
        name_trace_thread("packer");
        FLANEUR_ZONE("pack");
    }).join();
    const std::vector<TraceThread> threads = end_trace();
    const TraceThread* const packer = thread_named(threads, "packer");
    ASSERT_TRUE(packer);
    EXPECT_STREQ(packer->events.at(0).name, "pack");
}

}  // namespace
}  // namespace flaneur
