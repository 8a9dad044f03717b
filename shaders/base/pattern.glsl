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

float inside(vec2 x, vec2 a, vec2 b, vec2 width) {
    return between(x.x, a.x, b.x, width.x) * between(x.y, a.y, b.y, width.y);
}
