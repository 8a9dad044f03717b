#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tools/flaneur/window/layout.h"

namespace flaneur {
namespace {

constexpr glm::vec2 k_windows[] = {{640, 480}, {1280, 720}, {2560, 1440}};
// As large as they are at scale 1: a room, figures of a comparison, the card of a walker, two legends.
constexpr glm::vec2 k_whole[] = {{400, 900}, {280, 190}, {330, 230}, {210, 330}};

struct Box {
    std::string name;
    glm::vec2 low, high;
};
bool is_apart(const Box& a, const Box& b) {
    constexpr float k_slack = 0.01f;
    return a.high.x <= b.low.x + k_slack || b.high.x <= a.low.x + k_slack || a.high.y <= b.low.y + k_slack ||
           b.high.y <= a.low.y + k_slack;
}

// All panels of a window, `shown` by their bits.
PanelWish wish_of(glm::vec2 window, float scale, unsigned shown) {
    PanelWish wish;
    wish.window = window, wish.scale = std::min(scale, most_scale(window));
    wish.bar_foot = 44 * wish.scale, wish.tabs_foot = 73 * wish.scale;
    for (size_t i = 0; i < k_sides; ++i) {
        wish.is_shown[i] = (shown >> i & 1) != 0;
        if (!wish.is_shown[i]) continue;
        wish.whole[i] = glm::min(k_whole[i] * wish.scale, window - 10.0f * wish.scale);
        wish.chosen = static_cast<SidePanel>(i);
    }
    wish.state = glm::vec2(150, 33) * wish.scale;
    return wish;
}

std::vector<Box> boxes_of(const PanelWish& wish, const PanelPlan& plan) {
    const float foot = plan.has_tabs ? wish.tabs_foot : wish.bar_foot;
    std::vector<Box> boxes = {{"bar", {plan.edge, plan.edge}, {wish.window.x - plan.edge, foot}},
                              {"timeline", {plan.edge, plan.timeline_top}, wish.window - plan.edge}};
    for (size_t i = 0; i < k_sides; ++i) {
        const PanelPlace& place = plan.sides[i];
        if (!place.is_there) continue;
        const glm::vec2 size = glm::min(wish.whole[i], place.most), low = place.at - place.pivot * size;
        boxes.push_back({"panel " + std::to_string(i), low, low + size});
    }
    if (plan.has_state)
        boxes.push_back(
            {"state", {plan.edge, plan.row_foot - wish.state.y}, {plan.edge + wish.state.x, plan.row_foot}});
    if (plan.has_map)
        boxes.push_back({"map",
                         glm::vec2(wish.window.x - plan.edge, plan.row_foot) - wish.map,
                         {wish.window.x - plan.edge, plan.row_foot}});
    if (wish.note.x > 0)
        boxes.push_back({"note",
                         {(wish.window.x - wish.note.x) / 2, plan.row_foot - wish.note.y},
                         {(wish.window.x + wish.note.x) / 2, plan.row_foot}});
    if (wish.film.x > 0)
        boxes.push_back({"film",
                         {(wish.window.x - wish.film.x) / 2, plan.film_top},
                         {(wish.window.x + wish.film.x) / 2, plan.film_top + wish.film.y}});
    return boxes;
}

void expect_calm(const PanelWish& wish) {
    const PanelPlan plan = plan_panels(wish);
    const std::vector<Box> boxes = boxes_of(wish, plan);
    for (size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_GE(std::min(boxes[i].low.x, boxes[i].low.y), 0) << boxes[i].name;
        EXPECT_LE(boxes[i].high.x, wish.window.x) << boxes[i].name;
        EXPECT_LE(boxes[i].high.y, wish.window.y) << boxes[i].name;
        for (size_t k = 0; k < i; ++k)
            EXPECT_TRUE(is_apart(boxes[i], boxes[k])) << boxes[i].name << " covers " << boxes[k].name;
    }
    for (size_t i = 0; i < k_sides; ++i) {
        const bool is_reached = plan.sides[i].is_there || plan.has_tabs;
        EXPECT_TRUE(!wish.is_shown[i] || is_reached) << "panel " << i << " is nowhere";
        const float high = plan.sides[i].is_there ? plan.sides[i].most.y : 1e9f;
        EXPECT_GE(high, 40 * wish.scale) << "panel " << i;
    }
}

TEST(Layout, NoPanelCoversAnother) {
    for (const glm::vec2 window : k_windows)
        for (const float scale : {1.0f, 1.5f, 2.0f, 3.0f})
            for (unsigned shown = 0; shown < 1u << k_sides; ++shown)
                for (unsigned told = 0; told < 8; ++told) {
                    PanelWish wish = wish_of(window, scale, shown);
                    if (told & 1) wish.map = glm::vec2(220, 55) * wish.scale;
                    if (told & 2) wish.film = glm::vec2(270, 33) * wish.scale;
                    if (told & 4) wish.note = glm::vec2(276, 33) * wish.scale;
                    SCOPED_TRACE(testing::Message() << window.x << "x" << window.y << " at " << scale
                                                    << ", shown " << shown << ", told " << told);
                    expect_calm(wish);
                }
}

TEST(Layout, TabsAreForWhereThereIsNoRoom) {
    EXPECT_FALSE(plan_panels(wish_of({1280, 720}, 1, 0b0111)).has_tabs);
    EXPECT_FALSE(plan_panels(wish_of({2560, 1440}, 2, 0b0111)).has_tabs);
    EXPECT_TRUE(plan_panels(wish_of({1280, 720}, 3, 0b0111)).has_tabs);
    EXPECT_FALSE(plan_panels(wish_of({1280, 720}, 3, 0b0001)).has_tabs) << "one alone scrolls";
}

TEST(Layout, WhatIsPointedAtGivesWay) {
    PanelWish wish = wish_of({640, 480}, 1, 0b0101);
    EXPECT_TRUE(plan_panels(wish).has_tabs);
    wish.is_glimpse = true;
    const PanelPlan plan = plan_panels(wish);
    EXPECT_FALSE(plan.has_tabs);
    EXPECT_TRUE(plan.sides[0].is_there);
    EXPECT_FALSE(plan.sides[2].is_there);
}

TEST(Layout, ANoteThatComesAndGoesMovesNoPanelIntoTabs) {
    PanelWish wish = wish_of({1280, 720}, 1, 0b1110);
    wish.whole[3].y = 720 - 44 - 10 - wish.whole[1].y - wish.whole[2].y - 20 - 46 - 10 - 34 - 10 - 10;
    EXPECT_FALSE(plan_panels(wish).has_tabs);
    wish.note = {400, 90};
    EXPECT_FALSE(plan_panels(wish).has_tabs);
    expect_calm(wish);
}

TEST(Layout, LettersAreNoLargerThanTheWindowHasRoomFor) {
    EXPECT_EQ(most_scale({1280, 720}), 3);
    EXPECT_EQ(most_scale({640, 480}), 2);
    EXPECT_EQ(most_scale({100, 100}), 1);
}

TEST(Layout, OnePanelAtATimeIsBetweenTwoHalves) {
    for (const glm::vec2 window : {glm::vec2(1280, 720), glm::vec2(2560, 1440)})
        for (const float scale : {1.0f, 1.5f})
            for (unsigned shown = 1; shown < 16; ++shown) {
                PanelWish wish = wish_of(window, scale, shown);
                wish.is_between = true;
                const PanelPlan plan = plan_panels(wish);
                expect_calm(wish);
                for (size_t i = 0; i < k_sides; ++i) {
                    if (!plan.sides[i].is_there) continue;
                    EXPECT_EQ(static_cast<SidePanel>(i), wish.chosen);
                    const float wide = std::min(wish.whole[i].x, plan.sides[i].most.x);
                    EXPECT_GT((window.x - wide) / 2, 0.32f * window.x)
                        << "the middles of both halves are free";
                    EXPECT_EQ(plan.sides[i].at.x - plan.sides[i].pivot.x * wide, (window.x - wide) / 2);
                }
            }
}

}  // namespace
}  // namespace flaneur
