// Names of files, completed as they are typed.
#pragma once

#include <string>
#include <vector>

namespace flaneur {

// A leading ~ is the home folder; what is no full path starts at the folder that the program runs in.
std::string full_path(const std::string& typed);

// The folder above that in which `typed` is, ending in /; "" above the root.
std::string folder_above(const std::string& typed);

// What `typed` may become: folders, which end in /, and then files that can be opened, by name; without those
// whose names begin with a dot, unless that is typed. At most `most`.
std::vector<std::string> completions(const std::string& typed, size_t most = 200);

// As far as all of them agree; `typed` where they do not agree further.
std::string completed(const std::string& typed, const std::vector<std::string>& found);

}  // namespace flaneur
