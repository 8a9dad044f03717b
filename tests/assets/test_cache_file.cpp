#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>

#include "assets/cache/cache_file.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

// A variable of the environment, as it was when the test ends.
struct Variable {
    std::string name, before;
    bool was_set;
    Variable(const char* n, const char* value) : name(n), was_set(getenv(n) != nullptr) {
        if (was_set) before = getenv(n);
        value ? setenv(n, value, 1) : unsetenv(n);
    }
    ~Variable() { was_set ? setenv(name.c_str(), before.c_str(), 1) : unsetenv(name.c_str()); }
};

TEST(CacheFile, LiesWhereTheEnvironmentSays) {
    auto folder = [](const char* cache, const char* home, const char* most = nullptr) {
        Variable a("XDG_CACHE_HOME", cache), b("HOME", home), c("FLANEUR_CACHE_MAX", most);
        return cache_folder();
    };
    EXPECT_EQ(folder("/caches", "/home/me"), "/caches/flaneur");
    EXPECT_EQ(folder("caches", "/home/me"), "/home/me/.cache/flaneur") << "only absolute ones count";
    EXPECT_EQ(folder("", "/home/me"), "/home/me/.cache/flaneur");
    EXPECT_EQ(folder(nullptr, "/home/me"), "/home/me/.cache/flaneur");
    EXPECT_EQ(folder(nullptr, nullptr), "");
    EXPECT_EQ(folder(nullptr, ""), "");
    EXPECT_EQ(folder("/caches", "/home/me", "0"), "") << "a cache of nothing";
}

TEST(CacheFile, IsBoundedByAGibibyteOrWhatIsSaid) {
    auto limit = [](const char* said) {
        Variable most("FLANEUR_CACHE_MAX", said);
        return cache_limit();
    };
    EXPECT_EQ(limit(nullptr), uint64_t{1} << 30);
    EXPECT_EQ(limit("2"), uint64_t{2} << 20);
    EXPECT_EQ(limit("0"), 0u);
    for (const char* nonsense : {"", "much", "-1", "1.5", "3 GB"})
        EXPECT_EQ(limit(nonsense), uint64_t{1} << 30) << "and the program refuses it";
    EXPECT_EQ(limit("18446744073709551615"), uint64_t{1} << 40);
}

TEST(CacheFile, IsForItsOwnerAlone) {
    TestFolder folder;
    auto perms = [](const std::string& path) { return fs::status(path).permissions() & fs::perms(0777); };
    std::string inner = folder / "a/b/flaneur", path = kept_path(inner, "person", 1);
    keep(path, 1, "somebody");
    EXPECT_EQ(perms(path), fs::perms(0600));
    EXPECT_EQ(perms(inner), fs::perms(0700));
    fs::permissions(inner, fs::perms(0755));  // as earlier versions made it
    keep(path, 1, "somebody");
    EXPECT_EQ(perms(inner), fs::perms(0700));
    EXPECT_EQ(read_kept(path, 1, 100), "somebody");
    EXPECT_FALSE(read_kept(path, 2, 100)) << "another key";
    EXPECT_FALSE(read_kept(path, 1, 3)) << "too long";
}

TEST(CacheFile, WhatWasUsedLeastRecentlyGoes) {
    TestFolder folder;
    std::string text(1000, 'x');
    std::vector<std::string> paths;
    for (uint64_t key = 0; key < 5; ++key) {
        paths.push_back(kept_path(folder.path.string(), key % 2 ? "person" : "navmesh", key));
        keep(paths[key], key, text, 1 << 20);
        fs::last_write_time(paths[key], fs::file_time_type::clock::now() - std::chrono::hours(24 - key));
    }
    std::string stranger = folder.write("letter", text);
    std::string part = folder.write("person-0.1-1.part", text),
                young = folder.write("person-1.1-1.part", text);
    fs::last_write_time(part, fs::file_time_type::clock::now() - std::chrono::hours(2));
    EXPECT_EQ(cache_status(folder.path.string())->files, 7u);
    ASSERT_TRUE(read_kept(paths[0], 0, 2000)) << "used again";
    std::string last = kept_path(folder.path.string(), "person", 9);
    keep(last, 9, text, 5000);
    for (const std::string& path : {paths[0], paths[4], last, stranger, young})
        EXPECT_TRUE(fs::exists(path)) << path;
    for (const std::string& path : {paths[1], paths[2], paths[3], part})
        EXPECT_FALSE(fs::exists(path)) << path;
    EXPECT_LE(cache_status(folder.path.string())->bytes, 5000u);

    keep(kept_path(folder.path.string(), "person", 10), 10, std::string(6000, 'x'), 5000);
    EXPECT_TRUE(fs::exists(last)) << "what would never fit drives nobody out";

    Result<CacheStatus> removed = clear_cache(folder.path.string());
    ASSERT_TRUE(removed);
    EXPECT_EQ(removed->files, 4u);
    EXPECT_EQ(cache_status(folder.path.string())->files, 0u);
    EXPECT_TRUE(fs::exists(stranger));
    EXPECT_EQ(clear_cache(folder / "nowhere")->files, 0u);
}

TEST(CacheFile, WhereNothingCanBeKeptNothingIs) {
    TestFolder folder;
    for (const std::string& nowhere :
         {std::string("/proc/none"), std::string("/dev/null/x"), folder.write("file", "")}) {
        std::string path = kept_path(nowhere, "person", 1);
        keep(path, 1, "somebody");
        EXPECT_FALSE(read_kept(path, 1, 100));
        EXPECT_EQ(cache_status(nowhere)->files, 0u);
    }
}

}  // namespace
}  // namespace flaneur
