// The quad that shows a walker's picture. To be included after impostor.glsl.

struct Quad {
    vec3 place;       // of a corner
    vec2 texel;       // of the atlas
    vec2 side, tilt;  // that the picture was taken from, in the world: sines and cosines
};

const vec2 k_corners[6] = {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1)};
const float k_tilt_borders[k_impostor_tilts - 1] = {0.19509, 0.59131};  // sines half-way between k_tilts
const float k_side_angle = 6.2831853 / float(k_impostor_sides);
const float k_depth = 0.35;  // metres from front to back for each metre of height, of a body in mid-stride

// How high a body looks from a tilt, for each metre.
float height_from(vec2 tilt) { return tilt.y + k_depth * tilt.x; }

// The picture taken nearest to the way towards the viewer, leaning away from the viewer by half its tilt, so that head
// and feet are not far from where they would be, and as high as the body looks from the viewer's own tilt.
Quad quad_of(ImpostorInstance walker, vec3 to_viewer, int corner) {
    float across = max(length(to_viewer.xz), 1e-6);
    vec2 towards = across > 1e-5 ? to_viewer.xz / across : vec2(0, 1);
    vec2 tilt = normalize(vec2(max(to_viewer.y, 0.0), across));
    int level = int(tilt.x > k_tilt_borders[0]) + int(tilt.x > k_tilt_borders[1]);
    int side = int(round((atan(towards.x, towards.y) - walker.heading) / k_side_angle)) & (k_impostor_sides - 1);
    ImpostorCell cell = cells[walker.first_cell + level * k_impostor_sides + side];
    float turn = float(side) * k_side_angle + walker.heading;

    Quad quad;
    quad.side = vec2(sin(turn), cos(turn));
    quad.tilt = k_tilts[level];
    vec2 at = k_corners[corner];
    quad.texel = cell.texels.xy + vec2(at.x, 1.0 - at.y) * cell.texels.zw;
    vec2 metres = (cell.box.xy + at * cell.box.zw) * walker.place.w;
    vec2 lean = normalize(vec2(quad.tilt.x, 1.0 + quad.tilt.y));  // half the tilt
    float stretch = height_from(tilt) / (height_from(quad.tilt) * dot(lean, tilt));
    vec3 up = vec3(-lean.x * towards.x, lean.y, -lean.x * towards.y) * stretch;
    quad.place = walker.place.xyz + metres.y * up + metres.x * vec3(towards.y, 0, -towards.x);
    return quad;
}
