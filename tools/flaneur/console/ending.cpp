#include "tools/flaneur/console/ending.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "tools/flaneur/console/console.h"

namespace flaneur {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double k_patience = 0.7;    // seconds
constexpr double k_same_order = 0.3;  // seconds in which a second signal is the first one's echo

std::atomic<int> asked_by = 0;  // the signal; 0: nobody asked
std::atomic<double> patience = k_patience;
void (*clean_up_files)() = nullptr;

void clean_up() {
    if (clean_up_files) clean_up_files();
}

[[noreturn]] void die_by(int number) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, number);
    signal(number, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    raise(number);
    std::_Exit(128 + number);
}

// A thread of its own waits for the signals, so nothing here runs in a signal handler.
void watch(sigset_t signals) {
    int number = 0;
    if (sigwait(&signals, &number) != 0) return;
    asked_by = number;
    auto passed = [start = Clock::now()] {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    while (passed() < patience) {
        constexpr timespec k_while{0, 20'000'000};
        if (sigtimedwait(&signals, nullptr, &k_while) > 0 && passed() > k_same_order) break;
    }
    clean_up();
    constexpr char k_words[] = "flaneur: Interrupted; what was half done is removed.\n";
    if (write(STDERR_FILENO, k_words, sizeof k_words - 1) < 0) {
        // there is nobody to tell
    }
    die_by(number);
}

std::string told(const std::exception_ptr& exception) {
    try {
        if (exception) std::rethrow_exception(exception);
    } catch (const std::bad_alloc&) {
        return "There is not enough memory for this; ask for fewer people or a smaller city.";
    } catch (const std::system_error& e) {
        return std::string("The system refuses what the program needs (") + e.what() + ").";
    } catch (const std::exception& e) {
        return std::string("The program made a mistake and stops (") + e.what() + ").";
    } catch (...) {
    }
    return "The program made a mistake and stops.";
}

[[noreturn]] void on_terminate() {
    say("flaneur: " + told(std::current_exception()));
    end_now(1);
}

}  // namespace

void obey_signals(void (*to_clean_up)()) {
    clean_up_files = to_clean_up;
    signal(SIGXFSZ, SIG_IGN);  // what is too large is told where it is written, as on a full disk
    sigset_t signals;
    sigemptyset(&signals);
    for (int number : {SIGINT, SIGQUIT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction now {};
        sigaction(number, nullptr, &now);
        if (now.sa_handler != SIG_IGN) sigaddset(&signals, number);
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // for the threads to come too
    std::thread(watch, signals).detach();
}

bool is_stopping() { return asked_by != 0; }

Error interrupted(const std::string& what) { return Error{"Interrupted; " + what + "."}; }

Error unread() { return Error{""}; }
bool is_unread(const Error& error) { return error.message.empty(); }

void be_patient(double seconds) { patience = seconds; }

int run_guarded(const std::function<int()>& program) {
    std::set_terminate(on_terminate);
    try {
        return program();
    } catch (...) {
        say("flaneur: " + told(std::current_exception()));
        return 1;
    }
}

void end_now(int status) {
    clean_up();
    std::_Exit(status);
}

void end_by_signal() { die_by(asked_by); }
void end_unread() { die_by(SIGPIPE); }

}  // namespace flaneur
