// Where two levels of detail take turns, each is drawn in the pixels that the other leaves out.

// `hidden`: a bit for each pixel of a square of 4x4, rows one after another.
bool is_left_out(uint hidden) {
    uvec2 at = uvec2(gl_FragCoord.xy) & 3u;
    return (hidden >> (at.x | at.y << 2) & 1u) != 0u;
}
