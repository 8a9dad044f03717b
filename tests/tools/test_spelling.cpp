#include <gtest/gtest.h>

#include "tools/flaneur/options/spelling.h"

namespace flaneur {
namespace {

TEST(Spelling, CountsErrors) {
    EXPECT_EQ(typing_errors("render", "render"), 0u);
    EXPECT_EQ(typing_errors("rendr", "render"), 1u);
    EXPECT_EQ(typing_errors("rendeer", "render"), 1u);
    EXPECT_EQ(typing_errors("rander", "render"), 1u);
    EXPECT_EQ(typing_errors("redner", "render"), 1u) << "swapped";
    EXPECT_EQ(typing_errors("", "sim"), 3u);
    EXPECT_EQ(typing_errors("kitten", "sitting"), 3u);
}

TEST(Spelling, SuggestsWhatIsNear) {
    std::vector<std::string> commands{"view", "render", "sim", "people"};
    EXPECT_EQ(did_you_mean("rendr", commands), " Did you mean render?");
    EXPECT_EQ(did_you_mean("peolpe", commands), " Did you mean people?");
    EXPECT_EQ(did_you_mean("sin", commands), " Did you mean sim?");
    EXPECT_EQ(did_you_mean("fly", commands), "");
    EXPECT_EQ(did_you_mean("", commands), "");
    EXPECT_EQ(did_you_mean(std::string(1'000'000, 'r'), commands), "");
}

}  // namespace
}  // namespace flaneur
