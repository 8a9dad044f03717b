// Procedural detail that fades into its average where it is finer than a pixel.

// A number of 0..1 for each pair of numbers, and for each whole place.
float hash(uvec2 c) {
    uint h = c.x * 0x9e3779b1u ^ c.y * 0x85ebca77u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    return float(h >> 8) * (1.0 / 16777216.0);
}
float hash(vec2 cell) { return hash(uvec2(ivec2(cell))); }

// Like a sine of so many turns, by parabolas.
float wave(float turns) {
    float x = fract(turns) * 2.0 - 1.0;
    return 4.0 * x * (1.0 - abs(x));
}

// How much of a pixel, `width` wide about x, lies between a and b.
float between(float x, float a, float b, float width) {
    float inverse = 1.0 / width;
    return saturate((x - a) * inverse + 0.5) - saturate((x - b) * inverse + 0.5);
}

// From 0 to 1 in each whole step of x.
float rising(float x, float width) {
    float at = fract(x), inverse = 1.0 / width;
    float seen = at - saturate((at - 1.0) * inverse + 0.5) + saturate(0.5 - at * inverse);
    return mix(seen, 0.5, saturate(2.0 * width - 1.0));
}

// How wide a pixel is along either coordinate.
vec2 pixel_widths(vec2 at) {
    vec2 right = dFdx(at), down = dFdy(at);
    return max(sqrt(right * right + down * down), vec2(1e-4));
}

float inside(vec2 x, vec2 a, vec2 b, vec2 width) {
    return between(x.x, a.x, b.x, width.x) * between(x.y, a.y, b.y, width.y);
}
