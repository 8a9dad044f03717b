// What is told of who came and went.
#include <gtest/gtest.h>

#include "tools/flaneur/measure/coming.h"

namespace flaneur {
namespace {

void expect_in(const std::string& told, const char* part) {
    EXPECT_NE(told.find(part), std::string::npos) << told;
}

TEST(ToldComing, TellsThoseWhoWanderFromThoseSent) {
    EXPECT_EQ(told_coming({}, {}, {}), "");
    EXPECT_EQ(
        told_coming({.came = 3, .left = 4, .waiting = 1}, {}, {}),
        "Of those who wander 4 people left, and 3 people came in instead; 1 person waits outside: where "
        "people come in, others stand.\n");
    const SentCount sent[] = {{.came = 10, .under_way = 4, .arrived = 6, .waiting = 2, .lost = 1, .later = 7},
                              {.later = 5}};
    const std::string names[] = {"early shift", "people 2"};
    const std::string told = told_coming({.came = 13, .left = 10, .waiting = 3}, sent, names);
    expect_in(told, "Of those who wander 4 people left, and 3 people came in instead; 1 person waits");
    expect_in(told,
              "early shift                   13       10         4        6        2        1        7\n");
    expect_in(told,
              "people 2                       0        0         0        0        0        0        5\n");
    expect_in(told,
              "all                           13       10         4        6        2        1       12\n");
    expect_in(told, "2 people wait outside: where they are to come in it is full.");
    expect_in(told, "1 person could not be sent");
}

TEST(ToldComing, OfVeryManyEntriesTheFirstAndTheRest) {
    const std::vector<SentCount> sent(1000, {.came = 1, .arrived = 1});
    const std::string told = told_coming({.came = 1000, .left = 1000}, sent, {});
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1 + 20 + 1 + 1) << told;
    expect_in(told, "entry 20 ");
    expect_in(told, "980 more entries             980      980");
    expect_in(told, "all                         1000     1000");
}

TEST(ToldComing, NamesTheFirstWhoHaveNoWay) {
    std::vector<SentCount> sent(300, {.came = 1, .arrived = 1});
    for (const size_t i : {3, 40, 250}) sent[i] = {.lost = 2};
    expect_in(told_coming({.came = 297, .left = 297}, sent, {}), "They are of entry 4, entry 41, entry 251.");
    for (SentCount& one : sent) one = {.lost = 1};
    expect_in(told_coming({}, sent, {}), "entry 99, entry 100 and 200 more entries.");
}

}  // namespace
}  // namespace flaneur
