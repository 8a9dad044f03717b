#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/folder.h"
#include "tools/rendercheck/process/process.h"

namespace flaneur {
namespace {

ProcessPlan shell(const std::string& line) {
    ProcessPlan plan;
    plan.words = {"/bin/sh", "-c", line};
    plan.time_limit = 20;
    return plan;
}

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Whether a process that said its number in a file is there, after a moment for its end.
bool lives(const std::string& path) {
    const std::string told = text_of(path);
    EXPECT_FALSE(told.empty()) << path;
    if (told.empty()) return true;
    const std::string state = "/proc/" + told.substr(0, told.find('\n'));
    for (int n = 0; n < 100; ++n) {
        if (!std::filesystem::exists(state)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
}

TEST(Process, EndsAsItEnds) {
    EXPECT_EQ(run_process(shell("exit 0"))->code, 0);
    ProcessEnd end = *run_process(shell("exit 3"));
    EXPECT_EQ(end.how, HowEnded::exited);
    EXPECT_EQ(end.code, 3);
    end = *run_process(shell("kill -SEGV $$"));
    EXPECT_EQ(end.how, HowEnded::signalled);
    EXPECT_EQ(end.code, SIGSEGV);
    ProcessPlan none;
    none.words = {"/no/such/program"};
    end = *run_process(none);
    EXPECT_EQ(end.how, HowEnded::not_started);
    EXPECT_EQ(end.code, ENOENT);
    EXPECT_NE(told_end(end, none).find("No such file"), std::string::npos);
}

TEST(Process, HasItsFolderEnvironmentAndFiles) {
    const TestFolder folder;
    ProcessPlan plan = shell("pwd; echo $A; echo ${B-none}; echo loud >&2; cat");
    setenv("B", "ours", 1);
    plan.folder = folder.path.string();
    plan.env = {{"A", "a 'b'"}, {"B", std::nullopt}};
    plan.stdout_file = folder / "out", plan.stderr_file = folder / "err";
    EXPECT_EQ(run_process(plan)->code, 0);
    EXPECT_EQ(text_of(plan.stdout_file), folder.path.string() + "\na 'b'\nnone\n");
    EXPECT_EQ(text_of(plan.stderr_file), "loud\n");
}

TEST(Process, OneThatNeverEndsIsEnded) {
    ProcessPlan plan = shell("while :; do sleep 0.05; done");
    plan.time_limit = 0.2;
    const ProcessEnd end = *run_process(plan);
    EXPECT_EQ(end.how, HowEnded::timed_out);
    EXPECT_LT(end.seconds, 10);
}

TEST(Process, OneThatIgnoresSignalsIsEndedToo) {
    const TestFolder folder;
    ProcessPlan plan =
        shell("trap '' TERM INT HUP; echo $$ > " + (folder / "pid") + "; while :; do sleep 0.05; done");
    plan.time_limit = 0.2;
    EXPECT_EQ(run_process(plan)->how, HowEnded::timed_out);
    EXPECT_FALSE(lives(folder / "pid"));
}

// Nobody hides: in the background, in a session of its own, orphaned twice.
TEST(Process, WhatItStartsEndsWithIt) {
    const TestFolder folder;
    for (const char* hidden :
         {"sh -c 'echo $$ > FILE; exec sleep 1000' &",
          "setsid sh -c 'trap \"\" TERM; echo $$ > FILE; sleep 1000; sleep 1000' &",
          "(setsid sh -c '(exec sh -c \"echo \\$\\$ > FILE; exec setsid sleep 1000\") &' &);"}) {
        std::string line = hidden;
        line.replace(line.find("FILE"), 4, folder / "pid");
        const ProcessEnd end =
            *run_process(shell(line + " while [ ! -s " + (folder / "pid") + " ]; do sleep 0.02; done"));
        EXPECT_EQ(end.how, HowEnded::exited) << hidden;
        EXPECT_GE(end.left_over, 1) << hidden;
        EXPECT_FALSE(lives(folder / "pid")) << hidden;
        std::filesystem::remove(folder / "pid");
    }
}

TEST(Process, ATreeOfForksEnds) {
    const TestFolder folder;
    ProcessPlan plan =
        shell("f() { [ $1 -gt 0 ] && { f $(($1 - 1)) & f $(($1 - 1)) & }; sleep 1000; }; echo $$ > " +
              (folder / "pid") + "; f 4");
    plan.time_limit = 0.5;
    EXPECT_EQ(run_process(plan)->how, HowEnded::timed_out);
    EXPECT_FALSE(lives(folder / "pid"));
}

TEST(Process, WritesNoMoreThanItMay) {
    const TestFolder folder;
    ProcessPlan plan = shell("exec cat /dev/zero > " + (folder / "big"));
    plan.disk_limit = 1 << 20;
    EXPECT_EQ(run_process(plan)->how, HowEnded::wrote_too_much);
    EXPECT_EQ(std::filesystem::file_size(folder / "big"), size_t{1} << 20);
    std::filesystem::remove(folder / "big");
    // In many files.
    plan = shell("n=0; while :; do head -c 300000 /dev/zero > " + (folder / "many") +
                 "-$n; n=$(((n + 1) % 40)); sleep 0.01; done");
    plan.disk_limit = 1 << 20;
    plan.watched = folder.path.string();
    EXPECT_EQ(run_process(plan)->how, HowEnded::wrote_too_much);
    // In what it prints.
    plan = shell("yes");
    plan.disk_limit = 1 << 20;
    plan.stdout_file = folder / "printed";
    EXPECT_NE(run_process(plan)->how, HowEnded::timed_out);
    EXPECT_LE(std::filesystem::file_size(plan.stdout_file), size_t{1} << 20);
}

// Whoever waits for it may be ended too, without a chance to say so.
TEST(Process, EndsWithWhoeverStartedIt) {
    const TestFolder folder;
    const pid_t starter = fork();
    if (starter == 0) {
        (void)run_process(
            shell("echo $$ > " + (folder / "pid") + "; trap '' TERM; while :; do sleep 0.05; done"));
        _exit(0);
    }
    for (int n = 0; n < 500 && text_of(folder / "pid").empty(); ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(starter, SIGKILL);
    waitpid(starter, nullptr, 0);
    for (int n = 0; n < 30 && lives(folder / "pid"); ++n) {
    }
    EXPECT_FALSE(lives(folder / "pid"));
}

}  // namespace
}  // namespace flaneur
