#include "tools/rendercheck/verdict/boxes.h"

#include <algorithm>
#include <cstdint>

namespace flaneur {

int densest_window(const std::vector<float>& differences, int width, float limit, int side, PixelBox& where) {
    const int height = static_cast<int>(differences.size()) / width;
    const int across = std::min(side, width), down = std::min(side, height);
    // How many lie above and left of each corner of pixels.
    const auto stride = static_cast<size_t>(width) + 1;
    std::vector<int> sums(stride * (static_cast<size_t>(height) + 1), 0);
    auto at = [&](int x, int y) -> int& {
        return sums[static_cast<size_t>(y) * stride + static_cast<size_t>(x)];
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_beyond =
                differences[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] >
                limit;
            at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + (is_beyond ? 1 : 0);
        }
    int most = 0;
    where = {0, 0, across, down};
    for (int y = 0; y + down <= height; ++y)
        for (int x = 0; x + across <= width; ++x) {
            const int count = at(x + across, y + down) - at(x, y + down) - at(x + across, y) + at(x, y);
            if (count > most) most = count, where.left = x, where.top = y;
        }
    return most;
}

std::vector<ChangedBox> changed_boxes(const std::vector<float>& differences, int width, float limit,
                                      size_t& more) {
    constexpr int k_tile = 8;
    constexpr size_t k_most = 24;
    const int height = static_cast<int>(differences.size()) / width;
    const int across = (width + k_tile - 1) / k_tile, down = (height + k_tile - 1) / k_tile;
    struct TileUse {
        int left = 0, top = 0, right = -1, bottom = -1;
        size_t pixels = 0;
        bool is_taken = false;
    };
    std::vector<TileUse> tiles(static_cast<size_t>(across) * static_cast<size_t>(down));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!(differences[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] >
                  limit))
                continue;
            TileUse& tile = tiles[static_cast<size_t>(y / k_tile * across + x / k_tile)];
            if (tile.pixels++ == 0) tile.left = tile.right = x, tile.top = tile.bottom = y;
            tile.left = std::min(tile.left, x), tile.right = std::max(tile.right, x);
            tile.bottom = y;
        }
    std::vector<ChangedBox> boxes;
    std::vector<int> todo;
    for (int start = 0; start < across * down; ++start) {
        if (tiles[static_cast<size_t>(start)].pixels == 0 || tiles[static_cast<size_t>(start)].is_taken)
            continue;
        TileUse all = tiles[static_cast<size_t>(start)];
        all.pixels = 0;
        todo.assign(1, start);
        tiles[static_cast<size_t>(start)].is_taken = true;
        while (!todo.empty()) {
            const int n = todo.back();
            todo.pop_back();
            const TileUse& tile = tiles[static_cast<size_t>(n)];
            all.left = std::min(all.left, tile.left), all.right = std::max(all.right, tile.right);
            all.top = std::min(all.top, tile.top), all.bottom = std::max(all.bottom, tile.bottom);
            all.pixels += tile.pixels;
            for (int y = std::max(n / across - 1, 0); y <= std::min(n / across + 1, down - 1); ++y)
                for (int x = std::max(n % across - 1, 0); x <= std::min(n % across + 1, across - 1); ++x) {
                    TileUse& other = tiles[static_cast<size_t>(y * across + x)];
                    if (other.pixels == 0 || other.is_taken) continue;
                    other.is_taken = true;
                    todo.push_back(y * across + x);
                }
        }
        boxes.push_back(
            {{all.left, all.top, all.right - all.left + 1, all.bottom - all.top + 1}, all.pixels});
    }
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const ChangedBox& a, const ChangedBox& b) { return a.pixels > b.pixels; });
    more = boxes.size() > k_most ? boxes.size() - k_most : 0;
    boxes.resize(boxes.size() - more);
    return boxes;
}

}  // namespace flaneur
