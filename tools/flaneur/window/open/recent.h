// The files that were opened of late, which are kept between runs.
#pragma once

#include <string>
#include <vector>

namespace flaneur {

inline constexpr size_t k_most_recent = 12;

// $XDG_STATE_HOME/flaneur/recent, or else $HOME/.local/state/flaneur/recent; empty, for nowhere, where
// neither is an absolute path.
std::string recent_file();

// A path a line, the last one opened first. Empty where there is no such file, or no sense in it; at most
// k_most_recent.
std::vector<std::string> read_recent(const std::string& file);
// Keeps them if it can.
void keep_recent(const std::string& file, const std::vector<std::string>& paths);

// Puts a path before the others, once.
void remember(std::vector<std::string>& paths, const std::string& path);

}  // namespace flaneur
