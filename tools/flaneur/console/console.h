// What the program says on the terminal, and how far it is.
#pragma once

#include <string>
#include <string_view>

namespace flaneur {

// `text` with its control characters, those of direction too (and what is no UTF-8) written out, as in \x1b:
// names and notes come from files of strangers, and must neither move the cursor nor begin a line of their
// own.
std::string printable(std::string_view text);

// A line on stderr, printable, in place of the line of progress.
void say(std::string_view line);

// A line on stderr that the next one replaces; nothing where stderr is not a terminal. May be called by any
// thread.
void show_progress(const std::string& line);
void clear_progress();
// The line that was shown last; empty: none. For those who show it elsewhere.
std::string progress_line();

}  // namespace flaneur
