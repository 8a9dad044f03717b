// What rendercheck can be asked for: a function a command, which gives the exit code.
#pragma once

#include <string>
#include <vector>

#include "tools/rendercheck/suite/suite.h"

namespace flaneur {

// Exit codes. Where several hold, a failure goes before a regression, and that before a missing reference.
inline constexpr int k_exit_passed = 0, k_exit_regression = 1, k_exit_missing = 2, k_exit_device = 3,
                     k_exit_failed = 4, k_exit_usage = 5;

struct CheckOptions {
    std::string suite;
    std::vector<std::string> programs;  // NAME=PATH
    std::string filter, required_device, references;
    int jobs = 1, runs = 0;
    bool blesses = false, forces = false;
    std::string junit, html, keep;
    bool is_github = false;
};
int run_suite(const CheckOptions& options);

struct CompareOptions {
    std::string picture, reference, mask;
    Tolerance tolerance;
    bool is_json = false;
    std::string html;
};
int run_compare(const CompareOptions& options);

// Asks on the terminal where `command` is empty.
int run_init(const std::string& path, const std::vector<std::string>& command);

int run_explain(const CheckOptions& options, const std::string& name);

int run_device();

// Says an error on standard error, and gives the code.
int fail_with(int code, const std::string& message);

// The suite with the programs of the command line in it.
Result<Suite> load_with_programs(const CheckOptions& options);

// The path of this program, for a process of its own.
std::string own_program();

}  // namespace flaneur
