#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <thread>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {
namespace {

TEST(Printable, LeavesWordsAndWritesOutControls) {
    EXPECT_EQ(printable("plain: caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x9a\xb6"),
              "plain: caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x9a\xb6");
    EXPECT_EQ(printable("a\x1b[2J\a\nb\r\t\x7f"), "a\\x1b[2J\\x07\\x0ab\\x0d\\x09\\x7f");
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J"),
              "\\xc2\\x9b"
              "2J")
        << "a control sequence in one character";
    EXPECT_EQ(printable("a\u202eb\u2066\u200f\u061c\u2028"),
              "a\\xe2\\x80\\xaeb\\xe2\\x81\\xa6\\xe2\\x80\\x8f\\xd8\\x9c\\xe2\\x80\\xa8")
        << "what is shown from right to left";
    EXPECT_EQ(printable("\u200d\u2030\u061b\u206a"), "\u200d\u2030\u061b\u206a");
    // No UTF-8: cut short, overlong, alone.
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");
    EXPECT_EQ(printable("\x9b"
                        "1"),
              "\\x9b"
              "1");
}

std::string said_by(const std::function<int()>& program, int expected) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(run_guarded(program), expected);
    return testing::internal::GetCapturedStderr();
}

TEST(Guarded, TellsWhatNobodyCaught) {
    EXPECT_EQ(said_by([] { return 7; }, 7), "");
    EXPECT_EQ(said_by([]() -> int { throw std::bad_alloc(); }, 1).find("flaneur: There is not enough memory"),
              0u);
    EXPECT_NE(said_by([]() -> int { throw std::runtime_error("a\nb"); }, 1).find("(a\\x0ab)."),
              std::string::npos);
    EXPECT_NE(said_by([]() -> int { throw 3; }, 1).find("made a mistake"), std::string::npos);
}

TEST(GuardedDeathTest, TellsOfOtherThreadsToo) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    auto program = [] {
        std::thread([] { throw std::bad_alloc(); }).join();
        return 0;
    };
    EXPECT_EXIT(run_guarded(program), testing::ExitedWithCode(1), "flaneur: There is not enough memory");
}

}  // namespace
}  // namespace flaneur
