// Anti-aliasing after Lottes' FXAA 3.11 (NVIDIA 2009), quality path, by whole pixels alone. Written once for GLSL and
// for C++; whoever includes it has
//   int luma_at(int x, int y)  of a pixel of the picture before, 0..255

// The neighbour that a pixel takes something of, and how much.
struct Smoothing {
    int x, y;
    float share;
};

// Where the mean across an edge leaves the edge's, from a pixel on along it: twice by how much.
struct EdgeEnd {
    int steps, off;
};

int distance_between(int a, int b) { return abs(a - b); }

Smoothing smoothing_at(int x, int y, int width, int height) {
    Smoothing taken;
    taken.x = x, taken.y = y, taken.share = 0.0f;
    // Pixels of the picture's border stay as they are.
    if (x < 1 || y < 1 || x > width - 2 || y > height - 2) return taken;
    int m = luma_at(x, y), n = luma_at(x, y - 1), s = luma_at(x, y + 1), w = luma_at(x - 1, y), e = luma_at(x + 1, y);
    int high = max(m, max(max(n, s), max(w, e))), low = min(m, min(min(n, s), min(w, e)));
    int contrast = high - low;
    if (contrast <= max(k_least_contrast, high >> 3)) return taken;
    bool is_level = distance_between(n + s, 2 * m) > distance_between(w + e, 2 * m);  // the edge runs left to right
    int before = is_level ? n : w, after = is_level ? s : e;
    bool is_before = distance_between(before, m) >= distance_between(after, m);
    int to = is_before ? -1 : 1;
    int across_x = is_level ? 0 : to, across_y = is_level ? to : 0;
    int other = is_before ? before : after;
    int edge = m + other, change = distance_between(other, m);

    EdgeEnd first, second;
    second.steps = 0, second.off = 0;
    first = second;
    for (int side = 0; side < 2; ++side) {
        int ahead = side == 0 ? -1 : 1;
        int along_x = is_level ? ahead : 0, along_y = is_level ? 0 : ahead;
        int border = is_level ? (side == 0 ? x : width - 1 - x) : (side == 0 ? y : height - 1 - y);
        int reach = min(k_edge_reach, border), i = 0, off = 0;
        while (i < reach && 2 * abs(off) < change) {
            ++i;
            int px = x + i * along_x, py = y + i * along_y;
            off = luma_at(px, py) + luma_at(px + across_x, py + across_y) - edge;
        }
        second.steps = i, second.off = off;
        if (side == 0) first = second;
    }
    bool is_first = first.steps < second.steps;
    float nearest = float(is_first ? first.steps : second.steps), span = float(first.steps + second.steps);
    bool is_inside = (m < other) != ((is_first ? first.off : second.off) < 0);  // not beyond the edge's end
    float share = is_inside ? 0.5f - nearest / span : 0.0f;

    // Specks: as much as the pixel differs from its neighbourhood.
    float speck = min(float(distance_between(n + s + w + e, 4 * m)) * 0.25f / float(contrast), 1.0f);
    speck = speck * speck * (3.0f - 2.0f * speck);
    taken.x = x + across_x, taken.y = y + across_y;
    taken.share = max(share, speck * speck * 0.5f);
    return taken;
}
