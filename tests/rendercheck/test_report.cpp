#include <gtest/gtest.h>

#include "tests/rendercheck/drawing.h"
#include "tools/rendercheck/references/device.h"
#include "tools/rendercheck/references/references.h"
#include "tools/rendercheck/report/report.h"

namespace flaneur {
namespace {

// The same Mesa and LLVM draw the same pixels with vectors of any width.
TEST(DriverKey, SaysWhatDecidesThePixels) {
    EXPECT_EQ(driver_key("llvmpipe (LLVM 15.0.6, 256 bits)", "Mesa 22.3.6 (LLVM 15.0.6)"),
              "llvmpipe-mesa-22.3.6-llvm-15.0.6");
    EXPECT_EQ(driver_key("llvmpipe (LLVM 15.0.6, 128 bits)", "Mesa 22.3.6 (LLVM 15.0.6)"),
              "llvmpipe-mesa-22.3.6-llvm-15.0.6");
    EXPECT_EQ(driver_key("NVIDIA GeForce RTX 3060/PCIe", "535.104.05"),
              "nvidia-geforce-rtx-3060-pcie-535.104.05");
    EXPECT_EQ(driver_key("../../etc", ""), "etc");
    EXPECT_EQ(driver_key("", ""), "unknown");
}

TEST(DriverKey, DriversComeBackAsTheyWereTold) {
    const std::vector<VulkanDriver> drivers{{"a b", "c", "d (e)", "a-b-d-e"}, {"f", "", "", "f"}};
    const std::vector<VulkanDriver> read = read_drivers(told_drivers(drivers));
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].info, "d (e)");
    EXPECT_EQ(choose_driver(read, "A B")->key, "a-b-d-e");
    EXPECT_FALSE(choose_driver(read, "z"));
}

TEST(Report, TheWorstComesFirst) {
    SuiteCase cases[3];
    std::vector<CaseResult> results(3);
    for (size_t n = 0; n < 3; ++n) {
        cases[n].name = std::string(1, static_cast<char>('a' + n));
        results[n].one = &cases[n];
        results[n].status = n == 0 ? CaseStatus::passed : CaseStatus::regression;
        results[n].pictures.resize(1);
        results[n].pictures[0].judgement.passes = n == 0;
        results[n].pictures[0].judgement.mean_flip = 0.1 * static_cast<double>(n);
    }
    CheckReport report{"s.json", "k", "", "rendercheck run s.json", &results, 1};
    const std::string page = html_report(report);
    EXPECT_LT(page.find("id=\"c\""), page.find("id=\"b\""));
    EXPECT_LT(page.find("id=\"b\""), page.find("<li>a</li>"));
    EXPECT_EQ(told_sum(results), "1 of 3 cases pass; 2 differ from their references.");
}

// Control characters of what was printed reach neither XML nor a terminal.
TEST(Report, WhatWasPrintedSteersNothing) {
    SuiteCase one;
    one.name = "a";
    std::vector<CaseResult> results(1);
    results[0].one = &one;
    results[0].status = CaseStatus::failed;
    results[0].line = "It said \"<&>\" | and\nmore.";
    results[0].log = "\x1b[31mred\x07 <b>";
    CheckReport report{"s.json", "k", "", "c", &results, 1};
    EXPECT_EQ(junit_report(report).find('\x1b'), std::string::npos);
    EXPECT_NE(junit_report(report).find("&quot;&lt;&amp;&gt;&quot;"), std::string::npos);
    EXPECT_EQ(told_case(report, results[0]).find('\x1b'), std::string::npos);
    EXPECT_EQ(html_report(report).find("<b>"), std::string::npos);
    EXPECT_EQ(github_marks(report).find("\nmore"), std::string::npos);
}

TEST(Report, SmallDifferencesCanBeSeen) {
    const std::vector<uint8_t> shown = difference_picture({0, 1, 255});
    EXPECT_EQ(shown[0], 0);
    EXPECT_GE(shown[4], 60);
    EXPECT_EQ(shown[8], 255);
    EXPECT_EQ(flip_picture({1})[0], 252);
}

TEST(References, HashesTellPixelsAndSizes) {
    CheckedPicture one = street(), other = street();
    EXPECT_EQ(pixel_hash(one), pixel_hash(other));
    pixel(other, 7, 7)[2] ^= 1;
    EXPECT_NE(pixel_hash(one), pixel_hash(other));
    other = one;
    std::swap(other.width, other.height);
    EXPECT_NE(pixel_hash(one), pixel_hash(other));
}

}  // namespace
}  // namespace flaneur
