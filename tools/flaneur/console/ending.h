// How the program ends before it is done: asked to by a signal, or by an exception that nobody caught.
//
// SIGINT, SIGQUIT, SIGTERM, SIGHUP and SIGXCPU ask it to stop. Long loops ask is_stopping() and leave by
// an Error; what cannot ask (a library at work) is cut short: the process ends 0.7 s after the signal
// whatever it is about, with what was half done cleaned up. Either way it ends by that signal, which a shell
// tells as 130, 131, 143, 129 or 152.
#pragma once

#include <functional>
#include <string>

#include "sim/base/result.h"

namespace flaneur {

// To be called first in main, before there are threads. `clean_up` removes what is half done; it may be
// called on any thread, while others are at work, and the process ends after it. A signal that the program's
// parent has it ignore (nohup) stays ignored.
void obey_signals(void (*clean_up)());

// Whether somebody asked the program to stop.
bool is_stopping();
// "Interrupted; `what`."
Error interrupted(const std::string& what = "nothing was finished");

// That nobody reads any more what is written: the program ends by SIGPIPE, without a word.
Error unread();
bool is_unread(const Error& error);

// From now on what is half done is worth so many seconds after a signal; a second signal ends it all the
// same.
void be_patient(double seconds);

// What `program` returns. An exception that it throws is told in a sentence, and gives 1; so does one of
// another thread, at once.
int run_guarded(const std::function<int()>& program);

// Ends the process: cleans up, without waiting for anything that is under way.
[[noreturn]] void end_now(int status);
// Ends it by the signal that asked for it; only if is_stopping().
[[noreturn]] void end_by_signal();
[[noreturn]] void end_unread();

}  // namespace flaneur
