// Anti-aliasing after Lottes' FXAA 3.11 (NVIDIA 2009), quality path, by whole pixels alone, in the words of
// light.h. Whoever includes it has `frame` and
//   real luma_near(int x, int y)  of the picture before, 0..255, of the pixel so far right and down of the
//   one at hand

// Of which neighbour a pixel takes something, and how much.
struct Smoothing {
    truth is_level;  // the one above or below, else the one to the left or right
    real to;         // -1 or 1
    real share;
};

// Where the mean across an edge leaves the edge's, from a pixel on along it: twice by how much.
struct EdgeEnd {
    real steps, off;
};

SHARED EdgeEnd end_of_edge(int ahead, truth is_level, real to, real edge, real change, real reach) {
    EdgeEnd end;
    end.steps = real(0.0f), end.off = real(0.0f);
    for (int i = 1; i <= k_edge_reach; ++i) {
        truth goes_on = both(real(float(i)) <= reach, abs(end.off) * real(2.0f) < change);
        if (!some(goes_on)) break;
        int by = i * ahead;
        truth is_before = to < real(0.0f);
        real level = luma_near(by, 0) + select(is_before, luma_near(by, -1), luma_near(by, 1));
        real upright = luma_near(0, by) + select(is_before, luma_near(-1, by), luma_near(1, by));
        end.steps = select(goes_on, real(float(i)), end.steps);
        end.off = select(goes_on, select(is_level, level, upright) - edge, end.off);
    }
    return end;
}

// x, y: of the pixel. The picture's border stays as it is.
SHARED Smoothing smoothing_at(real x, real y) {
    real one = real(1.0f), nothing = real(0.0f);
    real m = luma_near(0, 0), n = luma_near(0, -1), s = luma_near(0, 1), w = luma_near(-1, 0),
         e = luma_near(1, 0);
    real high = max(m, max(max(n, s), max(w, e))), low = min(m, min(min(n, s), min(w, e)));
    real contrast = high - low;
    real right = real(frame.screen.x) - one - x, below = real(frame.screen.y) - one - y;
    truth is_edge = both(contrast > max(real(float(k_least_contrast)), floor(high * real(0.125f))),
                         min(min(x, y), min(right, below)) > nothing);
    Smoothing taken;
    taken.is_level = abs(n + s - (m + m)) > abs(w + e - (m + m));  // the edge runs left to right
    taken.to = one, taken.share = nothing;
    if (!some(is_edge)) return taken;
    real before = select(taken.is_level, n, w), after = select(taken.is_level, s, e);
    truth is_before = abs(before - m) >= abs(after - m);
    taken.to = select(is_before, real(-1.0f), one);
    real other = select(is_before, before, after);
    real edge = m + other, change = select(is_edge, abs(other - m), nothing);
    EdgeEnd back = end_of_edge(-1, taken.is_level, taken.to, edge, change, select(taken.is_level, x, y));
    EdgeEnd on = end_of_edge(1, taken.is_level, taken.to, edge, change, select(taken.is_level, right, below));
    truth is_back = back.steps < on.steps;
    real nearest = select(is_back, back.steps, on.steps), off = select(is_back, back.off, on.off);
    // Not beyond the edge's end, where both lie on one side of the mean.
    real side = select(m < other, real(-1.0f), one), end_side = select(off < nothing, real(-1.0f), one);
    real share =
        select(side * end_side < nothing, real(0.5f) - nearest / max(back.steps + on.steps, one), nothing);

    // Specks: as much as the pixel differs from its neighbourhood.
    real speck = min(abs(n + s + w + e - m * real(4.0f)) * real(0.25f) / max(contrast, one), one);
    speck = speck * speck * (real(3.0f) - real(2.0f) * speck);
    taken.share = select(is_edge, max(share, speck * speck * real(0.5f)), nothing);
    return taken;
}
