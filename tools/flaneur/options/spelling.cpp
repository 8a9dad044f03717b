#include "tools/flaneur/options/spelling.h"

#include <algorithm>

namespace flaneur {

size_t typing_errors(std::string_view a, std::string_view b) {
    // Rows of the usual table, two back.
    std::vector<size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            size_t exchanged = last[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = std::min({exchanged, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
    constexpr size_t k_longest = 40;  // of what may have been meant
    if (word.size() > k_longest) return "";
    size_t least = std::max<size_t>(word.size() / 3, 1) + 1;
    const std::string* nearest = nullptr;
    for (const std::string& one : known) {
        size_t errors = typing_errors(word, one);
        if (errors < least) {
            least = errors;
            nearest = &one;
        }
    }
    return nearest ? " Did you mean " + *nearest + "?" : "";
}

}  // namespace flaneur
