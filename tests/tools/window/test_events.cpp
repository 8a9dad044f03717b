#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <string>

#include "tools/flaneur/window/events.h"
#include "tools/flaneur/window/input.h"

namespace flaneur {
namespace {

constexpr double k_panel = 100;  // left of it all is a panel

// Pictures, between which anything may happen.
struct Pictures {
    std::deque<MouseEvent> events;
    Pointer pointer;
    Mouse mouse;
    bool is_panels = false;

    void move(double x, double y) { add_event(events, {x, y}); }
    void press(double x, double y, bool is_down, int button = GLFW_MOUSE_BUTTON_LEFT) {
        add_event(events, {x, y, button, is_down});
    }
    void draw() {
        take_events(events, pointer);
        const Mouse before = mouse;
        const bool is_on = pointer.x < k_panel;
        read_mouse(pointer, is_on, mouse);
        is_panels = is_of_panels(before, mouse, is_on);
    }
};

TEST(Hands, APressIsWhereTheCursorWasThen) {
    Pictures city;  // all of it within one picture
    city.move(50, 50), city.press(50, 50, true), city.press(50, 50, false), city.move(400, 50);
    city.draw();
    EXPECT_EQ(city.pointer.x, 50);
    EXPECT_TRUE(city.pointer.is_down[0]) << "the panel's button sees it";
    EXPECT_FALSE(city.mouse.is_held) << "the city does not";
    EXPECT_TRUE(city.is_panels);
    city.draw();
    EXPECT_EQ(city.pointer.x, 50);
    EXPECT_FALSE(city.pointer.is_down[0]);
    EXPECT_FALSE(city.mouse.has_clicked);
    city.draw();
    EXPECT_EQ(city.pointer.x, 400);
    EXPECT_FALSE(city.is_panels);
    EXPECT_TRUE(city.events.empty());
}

TEST(Hands, AClickInTheCityReachesItThoughTheCursorLeft) {
    Pictures city;
    city.move(400, 50), city.press(400, 50, true), city.press(400, 50, false), city.move(50, 50);
    city.draw();
    EXPECT_TRUE(city.mouse.is_held);
    city.draw();
    EXPECT_TRUE(city.mouse.has_clicked);
    EXPECT_EQ(city.mouse.x, 400);
    city.draw();
    EXPECT_TRUE(city.is_panels);
    EXPECT_FALSE(city.mouse.has_clicked);
}

TEST(Hands, ADragIsSeenBeforeItEnds) {
    Pictures city;
    city.press(200, 50, true), city.move(300, 50), city.move(320, 90), city.press(320, 90, false);
    city.draw();
    EXPECT_EQ(city.mouse.held_x, 200);
    city.draw();
    EXPECT_TRUE(city.mouse.is_held);
    EXPECT_EQ(city.mouse.x, 320);
    city.draw();
    EXPECT_FALSE(city.mouse.is_held);
    EXPECT_FALSE(city.mouse.has_clicked);
}

TEST(Hands, WhatAPanelHoldsIsItsUntilItIsLetGoOf) {
    Pictures city;
    city.press(50, 50, true);
    city.draw();
    city.move(400, 50);
    city.draw();
    EXPECT_FALSE(city.mouse.is_held) << "a slider that is dragged off its panel";
    EXPECT_TRUE(city.is_panels);
    city.press(400, 50, false), city.press(400, 50, true);
    city.draw(), city.draw();
    EXPECT_TRUE(city.mouse.is_held) << "pressed anew";
    city.move(50, 50);
    city.draw();
    EXPECT_TRUE(city.mouse.is_held) << "what the city holds is its over panels too";
    EXPECT_FALSE(city.is_panels);
}

TEST(Hands, TwoClicksInOnePictureAreTwo) {
    Pictures city;
    for (int click = 0; click < 2; ++click) city.press(300, 60, true), city.press(300, 60, false);
    int clicks = 0;
    for (int picture = 0; picture < 6; ++picture) city.draw(), clicks += city.mouse.has_clicked ? 1 : 0;
    EXPECT_EQ(clicks, 2);
}

// A field as ImGui has one: letters first, then a key that was not down.
std::string typed(Typing& typing, int pictures) {
    std::string field;
    int last = 0;
    for (int picture = 0; picture < pictures; ++picture) {
        const TypedNow now = take_typed(typing, true, false);
        for (const unsigned letter : now.letters) field.push_back(static_cast<char>(letter));
        if (now.key == GLFW_KEY_BACKSPACE && last != now.key) field.pop_back();
        if (now.key == GLFW_KEY_A && (now.mods & GLFW_MOD_CONTROL)) field.append("[all]");
        last = now.key;
    }
    return field;
}

TEST(Typing, KeysAndLettersKeepTheirOrder) {
    Typing typing;
    auto& waiting = typing.waiting;
    waiting = {{'a'},
               {'b'},
               {0, GLFW_KEY_BACKSPACE},
               {0, GLFW_KEY_BACKSPACE},
               {'c'},
               {0, GLFW_KEY_A, GLFW_MOD_CONTROL},
               {'d'}};
    EXPECT_EQ(typed(typing, 8), "c[all]d");
    EXPECT_TRUE(waiting.empty());
}

TEST(Typing, LettersAreNoKeysOfAField) {
    EXPECT_FALSE(edits(GLFW_KEY_A, 0)) << "else a letter would take a picture";
    EXPECT_FALSE(edits(GLFW_KEY_LEFT_SHIFT, GLFW_MOD_SHIFT));
    EXPECT_FALSE(edits(GLFW_KEY_KP_1, 0));
    EXPECT_TRUE(edits(GLFW_KEY_A, GLFW_MOD_CONTROL));
    EXPECT_TRUE(edits(GLFW_KEY_LEFT, GLFW_MOD_SHIFT));
    EXPECT_TRUE(edits(GLFW_KEY_BACKSPACE, 0));
}

TEST(Typing, WaitsForAFieldThatIsOpened) {
    Typing typing;
    typing.waiting = {{'x'}};
    EXPECT_TRUE(take_typed(typing, false, true).letters.empty());
    EXPECT_EQ(typed(typing, 1), "x");
    typing.waiting = {{'x'}};
    take_typed(typing, false, false);
    EXPECT_TRUE(typing.waiting.empty()) << "keys of the city";
    typing.waiting = {{'x'}};
    for (int picture = 0; picture < 20; ++picture) take_typed(typing, false, true);
    EXPECT_TRUE(typing.waiting.empty()) << "nobody types there";
}

}  // namespace
}  // namespace flaneur
