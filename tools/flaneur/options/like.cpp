#include "tools/flaneur/options/like.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "assets/files/file.h"
#include "assets/files/picture.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

constexpr std::string_view k_like = "--like";
// Of options that have no value.
constexpr std::array<std::string_view, 5> k_flags = {"--validate", "--force", "--no-cache", "--resume",
                                                     "--transparent"};
constexpr size_t k_most_bytes = size_t{1} << 30;

}  // namespace

std::string picture_of_like(const std::vector<std::string>& words) {
    std::string path;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == k_like && i + 1 < words.size()) path = words[++i];
        if (words[i].starts_with("--like=")) path = words[i].substr(k_like.size() + 1);
    }
    return path;
}

Result<std::vector<std::string>> words_in_picture(const std::string& path) {
    const Result<Bytes> bytes = read_bytes(path, k_most_bytes);
    if (!bytes) return Error{excerpt(path) + " " + bytes.error().message + "."};
    constexpr std::array<uint8_t, 4> k_magic = {0x89, 'P', 'N', 'G'};
    if (bytes->size() < k_magic.size() || !std::equal(k_magic.begin(), k_magic.end(), bytes->begin()))
        return Error{excerpt(path) + " is no PNG; give a picture that F12 wrote in `flaneur view`."};
    const std::string comment = png_comment(*bytes);
    Result<std::vector<std::string>> words = shell_words(comment);
    const bool is_command =
        words && words->size() > 2 && words->at(0) == "flaneur" && words->at(1) == "render";
    if (!is_command)
        return Error{excerpt(path) +
                     " holds no command that draws it; pictures that F12 writes in `flaneur view` do."};
    words->erase(words->begin(), words->begin() + 2);
    if (has_option(*words, k_like))
        return Error{excerpt(path) + " holds a command with --like in it, which leads to another picture."};
    return words;
}

Result<std::vector<std::string>> words_like(const std::vector<std::string>& words) {
    const std::string path = picture_of_like(words);
    if (path.empty()) return words;
    Result<std::vector<std::string>> all = words_in_picture(path);
    if (!all) return Error{"--like " + all.error().message};
    // Options that are given several times would add up.
    std::vector<std::string_view> said, flags(k_flags.begin(), k_flags.end());
    for (const std::string& word : words)
        if (word.starts_with("--")) said.push_back(std::string_view(word).substr(0, word.find('=')));
    std::erase_if(flags, [&](std::string_view flag) {
        return std::find(said.begin(), said.end(), flag) == said.end();
    });
    *all = without_options(*all, said, flags);
    const std::array<std::string_view, 1> like = {k_like};
    for (std::string& word : without_options(words, like)) all->push_back(std::move(word));
    return all;
}

}  // namespace flaneur
