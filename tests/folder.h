// A folder of a test's own, which goes when the test ends.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace flaneur {

struct TestFolder {
    std::filesystem::path path;

    TestFolder() : path(std::filesystem::temp_directory_path() / "flaneur-test-XXXXXX") {
        std::string name = path.string();
        path = mkdtemp(name.data());
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    // The path of something in it.
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    // Makes a file of it, and gives its path.
    std::string write(const std::string& name, std::string_view content) const {
        std::ofstream(path / name, std::ios::binary) << content;
        return *this / name;
    }
};

}  // namespace flaneur
