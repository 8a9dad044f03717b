#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/rendercheck/report/page.h"
#include "tools/rendercheck/report/report.h"

namespace flaneur {
namespace {

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr const char* k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve(bytes.size() * 4 / 3 + 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = uint32_t{bytes[i]} << 16;
        if (i + 1 < bytes.size()) word |= uint32_t{bytes[i + 1]} << 8;
        if (i + 2 < bytes.size()) word |= bytes[i + 2];
        for (int n = 0; n < 4; ++n)
            out += i + static_cast<size_t>(n) > bytes.size() ? '=' : k_letters[word >> (18 - 6 * n) & 63];
    }
    return out;
}

// Pictures as large as a screen are shown smaller, so that the page stays one that a browser opens.
std::string image(const std::string& what, const std::vector<uint8_t>& rgba, const CheckedPicture& size) {
    const Result<std::vector<uint8_t>> png = write_png(rgba, size.width, size.height);
    if (!png) return "";
    return "<figure class=\"" + what + "\"><div class=\"frame\"><img alt=\"" + what +
           "\" src=\"data:image/png;base64," + base64(*png) + "\"></div><figcaption>" + what +
           "</figcaption></figure>\n";
}

std::string pictures_of(const PictureResult& result) {
    if (!result.picture) return "";
    const CheckedPicture& picture = *result.picture;
    std::string out = "<div class=\"set\" style=\"--w:" + std::to_string(picture.width) +
                      ";--h:" + std::to_string(picture.height) + "\"><p class=\"name\">" +
                      html_text(result.name) + ", " + told_size(picture) + "</p>\n";
    const bool is_comparable = result.other && !result.judgement.differences.empty();
    if (result.other)
        out +=
            "<p class=\"tools\"><label><input type=\"checkbox\" class=\"blink\"> blink</label> "
            "<label>slide <input type=\"range\" class=\"slide\" min=\"0\" max=\"100\" value=\"50\"></label> "
            "<button class=\"fit\">whole picture</button> <span class=\"at\"></span></p>\n";
    out += "<div class=\"row\">\n";
    if (result.other)
        out +=
            "<figure class=\"both\"><div class=\"frame\"></div><figcaption>left of the line new, right of it "
            "reference</figcaption></figure>\n";
    out += image("new", picture.rgba, picture);
    if (result.other) out += image("reference", result.other->rgba, *result.other);
    if (is_comparable) {
        out += image("difference", difference_picture(result.judgement.differences), picture);
        out += image("flip", flip_picture(result.judgement.flip), picture);
    }
    out += "</div>\n";
    if (is_comparable) {
        out += "<script type=\"application/json\" class=\"boxes\">[";
        for (size_t n = 0; n < result.judgement.boxes.size(); ++n) {
            const PixelBox& box = result.judgement.boxes[n].box;
            char text[80];
            std::snprintf(text, sizeof text, "%s[%d,%d,%d,%d]", n ? "," : "", box.left, box.top, box.width,
                          box.height);
            out += text;
        }
        out += "]</script>\n";
    }
    return out + "</div>\n";
}

std::string case_of(const CheckReport& report, const CaseResult& result) {
    std::string out = "<section class=\"case\" id=\"" + html_text(result.one->name) +
                      "\"><h2><span class=\"status\">" + told_status(result.status) + "</span> " +
                      html_text(result.one->name) + "</h2>\n<p>" + html_text(result.line) + "</p>\n";
    if (!result.details.empty()) {
        out += "<ul>";
        for (const std::string& detail : result.details)
            if (detail != result.line) out += "<li>" + html_text(detail) + "</li>";
        out += "</ul>\n";
    }
    for (const PictureResult& picture : result.pictures)
        if (!picture.judgement.passes || !picture.has_reference || result.status == CaseStatus::flaky)
            out += pictures_of(picture);
    if (result.reproduce.empty()) return out + "</section>\n";
    out += "<details><summary>Commands and output</summary><p>By hand</p><pre>" +
           html_text(result.reproduce) + "</pre><p>Again</p><pre>" +
           html_text(report.command + " --filter " + result.one->name) + "</pre>";
    if (result.status == CaseStatus::regression || result.status == CaseStatus::missing)
        out += "<p>If it is right</p><pre>" +
               html_text(report.command + " --filter " + result.one->name + " --bless") + "</pre>";
    if (!result.log.empty()) out += "<p>It printed</p><pre>" + html_text(result.log) + "</pre>";
    return out + "</details></section>\n";
}

}  // namespace

std::string html_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 32 || c == '\n' || c == '\t')
            out += c;
    }
    return out;
}

std::vector<uint8_t> difference_picture(const std::vector<float>& differences) {
    std::vector<uint8_t> out;
    out.reserve(differences.size() * 4);
    for (const float difference : differences) {
        // One 255th is grey already, and 64 of them are white.
        const float light =
            difference > 0 ? std::min(0.25f + 0.75f * std::log2(std::max(difference, 1.0f)) / 6, 1.0f) : 0.0f;
        const auto v = static_cast<uint8_t>(std::lround(light * 255));
        out.insert(out.end(), {v, v, v, 255});
    }
    return out;
}

std::vector<uint8_t> flip_picture(const std::vector<float>& errors) {
    // Magma of matplotlib, at sixths.
    constexpr float k_magma[7][3] = {{0, 0, 4},     {39, 18, 87},    {100, 26, 128}, {163, 48, 126},
                                     {226, 84, 98}, {252, 155, 109}, {252, 253, 191}};
    std::vector<uint8_t> out;
    out.reserve(errors.size() * 4);
    for (const float error : errors) {
        const float at = std::clamp(error, 0.0f, 1.0f) * 6;
        const auto low = std::min(static_cast<size_t>(at), size_t{5});
        const float share = at - static_cast<float>(low);
        for (size_t c = 0; c < 3; ++c)
            out.push_back(static_cast<uint8_t>(
                std::lround(k_magma[low][c] + (k_magma[low + 1][c] - k_magma[low][c]) * share)));
        out.push_back(255);
    }
    return out;
}

std::string html_report(const CheckReport& report) {
    std::vector<const CaseResult*> sorted;
    for (const CaseResult& result : *report.results) sorted.push_back(&result);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const CaseResult* a, const CaseResult* b) { return badness(*a) > badness(*b); });
    std::string out = k_page_head;
    out += "<header><h1>" + html_text(told_sum(*report.results)) + "</h1><p>" + html_text(report.suite) +
           ", references of " + html_text(report.key) +
           (report.device.empty() ? "" : ", drawn by " + html_text(report.device)) +
           ". The wheel zooms all pictures of a case together, dragging moves them, keys 1 to 9 go to the "
           "boxes that "
           "changed, b blinks.</p></header>\n";
    std::string passed;
    for (const CaseResult* result : sorted) {
        if (result->status != CaseStatus::passed)
            out += case_of(report, *result);
        else
            passed += "<li>" + html_text(result->one->name) + "</li>";
    }
    if (!passed.empty()) out += "<section><h2>Pass</h2><ul class=\"passed\">" + passed + "</ul></section>\n";
    return out + k_page_end;
}

}  // namespace flaneur
