#include "tools/flaneur/measure/coming.h"

#include <algorithm>
#include <cstdio>

namespace flaneur {

namespace {

std::string people(uint32_t n) { return std::to_string(n) + (n == 1 ? " person" : " people"); }

SentCount sum(std::span<const SentCount> counts) {
    SentCount all;
    for (const SentCount& c : counts) {
        all.came += c.came, all.under_way += c.under_way, all.arrived += c.arrived;
        all.waiting += c.waiting, all.lost += c.lost, all.later += c.later;
    }
    return all;
}

std::string name_of(std::span<const std::string> names, size_t i) {
    return i < names.size() ? names[i] : "entry " + std::to_string(i + 1);
}

std::string told_row(const std::string& name, const SentCount& c) {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "%8u %8u %9u %8u %8u %8u %8u\n", c.came + c.waiting + c.lost,
                  c.came, c.under_way, c.arrived, c.waiting, c.lost, c.later);
    constexpr size_t k_width = 24;
    return name + std::string(name.size() < k_width ? k_width - name.size() : 1, ' ') + numbers;
}

// The first few of those who had no way.
std::string told_lost(std::span<const SentCount> sent, std::span<const std::string> names) {
    constexpr size_t k_named = 100;
    std::string named;
    size_t lost = 0;
    for (size_t i = 0; i < sent.size(); ++i) {
        if (sent[i].lost == 0) continue;
        if (lost++ < k_named) named += (named.empty() ? "" : ", ") + name_of(names, i);
    }
    if (lost > k_named) named += " and " + std::to_string(lost - k_named) + " more entries";
    return named;
}

std::string told_wandering(const ComingCount& all, const SentCount& sent) {
    const uint32_t left = all.left - sent.arrived, came = all.came - sent.came,
                   waiting = all.waiting - sent.waiting;
    if (left == 0 && came == 0) return "";
    std::string told =
        "Of those who wander " + people(left) + " left, and " + people(came) + " came in instead";
    if (waiting > 0)
        told += "; " + people(waiting) + (waiting == 1 ? " waits" : " wait") +
                " outside: where people come in, others stand";
    return told + ".\n";
}

}  // namespace

std::string told_coming(const ComingCount& all, std::span<const SentCount> sent,
                        std::span<const std::string> names) {
    const SentCount total = sum(sent);
    std::string told = told_wandering(all, total);
    if (sent.empty()) return told;
    told += "Who is sent                  due  came in under way  arrived  outside   no way    later\n";
    const size_t most = std::min(sent.size(), k_most_told);
    for (size_t i = 0; i < most; ++i) told += told_row(name_of(names, i), sent[i]);
    if (sent.size() > most)
        told += told_row(std::to_string(sent.size() - most) + " more entries", sum(sent.subspan(most)));
    if (sent.size() > 1) told += told_row("all", total);
    if (total.waiting > 0)
        told += people(total.waiting) + (total.waiting == 1 ? " waits" : " wait") +
                " outside: where they are to come in it is full.\n";
    if (total.lost > 0)
        told += people(total.lost) +
                " could not be sent: nobody walks where they are to come in or to go, or no way leads there. "
                "They are of " +
                told_lost(sent, names) + ".\n";
    return told;
}

}  // namespace flaneur
