#include "tools/flaneur/plot/svg_pieces.h"

#include <cstdio>

namespace flaneur {

std::string printed(const char* pattern, double a, double b, double c, double d) {
    char text[256];
    std::snprintf(text, sizeof text, pattern, a, b, c, d);
    return text;
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= ' ' && c != '\x7f') out += c;
        }
    }
    return out;
}

std::string svg_begin(double width, double height, std::string_view style) {
    std::string svg = printed(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
        "width=\"%.0f\" height=\"%.0f\">\n",
        width, height, width, height);
    svg.append("<style>text{font-family:'Helvetica Neue',Arial,sans-serif;fill:#333}");
    svg.append(style).append("</style>\n");
    return svg + printed("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", width, height);
}

std::string svg_label(double x, double y, std::string_view classes, std::string_view text) {
    std::string label = printed("<text x=\"%.1f\" y=\"%.1f\" class=\"", x, y);
    return label.append(classes).append("\">").append(escaped(text)).append("</text>\n");
}

double grid_step(double span) {
    double step = 1;
    for (int i = 0; span / step > 5; ++i) step *= i % 3 == 1 ? 2.5 : 2;  // 1, 2, 5, 10 ..
    return step;
}

}  // namespace flaneur
