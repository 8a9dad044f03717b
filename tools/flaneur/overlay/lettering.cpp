#include "tools/flaneur/overlay/lettering.h"

#include <algorithm>
#include <array>

namespace flaneur {

namespace {

// Strokes of the letters from '!' to '~', apart by spaces: points as two digits, x to the right and y up. The
// base line lies at 2, capitals reach 8, small letters 6, tails 0.
constexpr std::array<const char*, '~' - '!' + 1> k_letters = {
    "0804 0202",                         // !
    "0806 1816",                         // "
    "1218 3238 0444 0646",               // #
    "473818070615354443321203 2921",     // $
    "0248 0818170708 3343423233",        // %
    "4207081827160403122244",            // &
    "0806",                              // '
    "18070312",                          // (
    "08171302",                          // )
    "0446 0644 2327",                    // *
    "0444 2226",                         // +
    "1201",                              // ,
    "0434",                              // -
    "0203131202",                        // .
    "0248",                              // /
    "123243473818070312",                // 0
    "071812 0222",                       // 1
    "07183847460242",                    // 2
    "07183847463525 354443321203",       // 3
    "32380444",                          // 4
    "480805354443321203",                // 5
    "4738180703123243443505",            // 6
    "084812",                            // 7
    "15060718384746351504031232434435",  // 8
    "0312324347381807061545",            // 9
    "0303 0606",                         // :
    "1201 1515",                         // ;
    "360432",                            // <
    "0333 0535",                         // =
    "063402",                            // >
    "07183847362524 2222",               // ?
    "34251403 0312324347381807",         // @
    "022842 1434",                       // A
    "02083847463505 3544433202",         // B
    "4738180703123243",                  // C
    "02082846442202",                    // D
    "48080242 0535",                     // E
    "480802 0535",                       // F
    "47381807031232434525",              // G
    "0208 4248 0545",                    // H
    "0222 1218 0828",                    // I
    "3833221203",                        // J
    "0208 480542",                       // K
    "080242",                            // L
    "0208254842",                        // M
    "02084248",                          // N
    "123243473818070312",                // O
    "02083847463505",                    // P
    "123243473818070312 2441",           // Q
    "02083847463505 2542",               // R
    "473818070615354443321203",          // S
    "0848 2822",                         // T
    "080312324348",                      // U
    "082248",                            // V
    "0812253248",                        // W
    "0248 0842",                         // X
    "082548 2522",                       // Y
    "08480242",                          // Z
    "18080212",                          // [
    "0842",                              // backslash
    "08181202",                          // ]
    "062846",                            // ^
    "0141",                              // _
    "0817",                              // `
    "3632 3526160503122233",             // a
    "0802 0516263533221203",             // b
    "3526160503122233",                  // c
    "3832 3526160503122233",             // d
    "04343526160503122233",              // e
    "28171612 0626",                     // f
    "3631201001 3526160503122233",       // g
    "0802 0516263532",                   // h
    "0602 0808",                         // i
    "161100 1818",                       // j
    "0802 3604 1532",                    // k
    "0802",                              // l
    "0602 05162522 25364542",            // m
    "0602 0516263532",                   // n
    "160503122233352616",                // o
    "0600 0516263533221203",             // p
    "3630 3526160503122233",             // q
    "0602 051626",                       // r
    "35261605142433221203",              // s
    "18132232 0626",                     // t
    "0603122233 3632",                   // u
    "062246",                            // v
    "0612253246",                        // w
    "0236 0632",                         // x
    "0622 4610",                         // y
    "06360232",                          // z
    "28171605141322",                    // {
    "0800",                              // |
    "081716251413 1302",                 // }
    "05163445",                          // ~
};
constexpr const char* k_box = "0208484202";
constexpr float k_capital = 6;  // units
constexpr float k_between = 1.7f, k_space = 3.4f;
constexpr uint32_t k_edge = 0x9018140fu;

const char* strokes_of(char c) {
    return c > ' ' && c <= '~' ? k_letters[static_cast<size_t>(c - '!')] : k_box;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Calls `use(from, to)` for each stroke, in units from the base line's left end, y down; returns the letter's
// width.
template <class Use>
float for_strokes(const char* strokes, Use&& use) {
    float width = 0;
    bool is_down = false;
    glm::vec2 before(0);
    for (const char* c = strokes; *c;) {
        if (!is_digit(c[0]) || !is_digit(c[1])) {
            is_down = false;
            ++c;
            continue;
        }
        const glm::vec2 at(static_cast<float>(c[0] - '0'), static_cast<float>('2' - c[1]));
        if (is_down) use(before, at);
        before = at;
        is_down = true;
        width = std::max(width, at.x);
        c += 2;
    }
    return width;
}

template <class Use>
float lay_out(std::string_view text, float unit, Use&& use) {
    float x = 0;
    for (char c : text) {
        if (c == ' ') {
            x += k_space * unit;
            continue;
        }
        const float width = for_strokes(strokes_of(c), [&](glm::vec2 from, glm::vec2 to) {
            use(glm::vec2(x, 0) + from * unit, glm::vec2(x, 0) + to * unit);
        });
        x += (width + k_between) * unit;
    }
    return std::max(x - k_between * unit, 0.0f);
}

}  // namespace

void add_text(std::vector<GizmoLine>& lines, const TextPlace& where, std::string_view text, uint32_t colour,
              float height) {
    const float unit = height / k_capital, ink = std::max(1.3f, 0.13f * height);
    for (bool is_edge : {true, false}) {
        GizmoLine line{.a = where.anchor, .b = where.anchor, .place = where.place};
        line.pixels = is_edge ? ink + 2.5f : ink;
        line.colour = is_edge ? k_edge : colour;
        lay_out(text, unit, [&](glm::vec2 from, glm::vec2 to) {
            line.shift_a = where.shift + from;
            line.shift_b = where.shift + to;
            lines.push_back(line);
        });
    }
}

float text_width(std::string_view text, float height) {
    return lay_out(text, height / k_capital, [](glm::vec2, glm::vec2) {});
}

}  // namespace flaneur
