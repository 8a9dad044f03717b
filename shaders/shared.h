// Every struct and constant that CPU and GPU share. Included by GLSL and by C++ (through renderer/shared.h,
// which maps the GLSL names to GLM's).
#ifndef FLANEUR_SHADERS_SHARED_H
#define FLANEUR_SHADERS_SHARED_H

#ifdef __cplusplus
#define FLANEUR_CONST inline constexpr
#else
#define FLANEUR_CONST const
#endif

FLANEUR_CONST int k_palette_joints =
    28;                         // joint transforms of one walker: of its body, and of what hangs on it
FLANEUR_CONST int k_tints = 7;  // none, skin, hair, top, bottom, shoes, accent

// One joint: a point v of the mesh (bind pose, scaled) goes to rotate(rotation, v) + translation in the
// world.
struct JointTransform {
    vec4 rotation;     // unit quaternion, vector part first
    vec4 translation;  // metres; w unused
};

// One walker as the vertex shader sees it.
struct WalkerInstance {
    uint palette;         // first of its joint transforms
    float scale;          // of the mesh before skinning
    uint tints[k_tints];  // sRGB, R in the lowest byte; indexed by a vertex's tint, [0] is white
    uint hidden;          // the renderer's own: pixels of each 4x4 that it is not drawn in, a bit each
};

// Impostors: pictures of people baked from their meshes in so many phases of a walk and standing, seen from
// so many sides and heights. A cell holds one of them; a person's cells run by pose, height, side.
FLANEUR_CONST int k_stride_phases = 8;
FLANEUR_CONST int k_stride_poses = k_stride_phases + 1;  // the last one stands
FLANEUR_CONST int k_impostor_sides = 16;                 // about the vertical, 0 in front, growing towards +x
FLANEUR_CONST int k_impostor_tilts = 3;                  // how far the viewer is above the horizon
FLANEUR_CONST int k_impostor_views = k_impostor_sides * k_impostor_tilts;
FLANEUR_CONST int k_person_cells = k_stride_poses * k_impostor_views;

// Sine and cosine of the tilts: 0, 22.5 and 50 degrees.
FLANEUR_CONST vec2 k_tilts[k_impostor_tilts] = {vec2(0, 1), vec2(0.38268f, 0.92388f),
                                                vec2(0.76604f, 0.64279f)};

struct ImpostorCell {
    vec4 box;  // what is seen, metres about the body's centre on the plane square to the view: left and lower
               //   end, width, height
    vec4 texels;  // where it is in the atlas: left and upper end, width, height
};

// One walker as a picture.
struct ImpostorInstance {
    vec4 place;           // centre of the body, metres; scale of the mesh
    float heading;        // yaw about +y, 0 faces +z
    uint first_cell;      // of its mesh and pose
    uint tints[k_tints];  // as WalkerInstance's
    uint hidden;          // as WalkerInstance's
    uint unused[2];
};

// What a city vertex is made of; shaders/city/ draws each by a procedure.
FLANEUR_CONST uint k_material_road = 0;
FLANEUR_CONST uint k_material_sidewalk = 1;
FLANEUR_CONST uint k_material_crossing = 2;
FLANEUR_CONST uint k_material_plaza = 3;
FLANEUR_CONST uint k_material_path = 4;
FLANEUR_CONST uint k_material_steps = 5;
FLANEUR_CONST uint k_material_grass = 6;
FLANEUR_CONST uint k_material_water = 7;
FLANEUR_CONST uint k_material_ballast = 8;   // of railways
FLANEUR_CONST uint k_material_sleepers = 9;  // and between the rails; u: metres along them
FLANEUR_CONST uint k_material_facade =
    10;  // u: metres along the wall, v: metres above its foot; windows by storey
FLANEUR_CONST uint k_material_stone = 11;  // garden walls, kerbs, risers
FLANEUR_CONST uint k_material_roof = 12;
FLANEUR_CONST uint k_material_leaves = 13;
FLANEUR_CONST uint k_material_trunk = 14;
FLANEUR_CONST uint k_material_metal = 15;   // lamps, bollards, benches
FLANEUR_CONST uint k_material_light = 16;   // heads of street lamps, which glow at night
FLANEUR_CONST uint k_material_signal = 19;  // what glows in its own colour then: traffic lights, lit signs
// A lens of a traffic light: lit by turns. u: k_lens_unit times the steps that its cycle has, and those that
// it is ahead; v: k_lens_unit times the step of its cycle from which on it is dark, and that from which on it
// is lit. All below it.
FLANEUR_CONST uint k_material_lens = 20;
FLANEUR_CONST float k_lens_unit = 4096.0f;
FLANEUR_CONST uint k_material_shade = 17;    // darkens the ground below it; u: 0 where most, 1 where it ends,
                                             //   v: how much
FLANEUR_CONST uint k_material_scenery = 18;  // u, v of a picture; extra: its layer, 0 for none

// Facades. A wall is fitted with bays about so wide, each with one window, metres.
FLANEUR_CONST float k_bay = 2.7f;
// CityVertex::extra of one, from the lowest bit on: height of its storeys, in units of so many metres;
// whether it has shop fronts; 1 + the bay of its door, or 0; its WindowKind.
FLANEUR_CONST float k_storey_unit = 0.05f;
FLANEUR_CONST uint k_storey_mask = 0x1ffu;
FLANEUR_CONST uint k_shop_shift = 9u;
FLANEUR_CONST uint k_door_shift = 10u;
FLANEUR_CONST uint k_door_mask = 15u;
FLANEUR_CONST uint k_windows_shift = 14u;

// Layers of the shadow map, two of each: one is seen, the other drawn ahead. Near, of city and people; near,
// of the city alone; far, of the city.
FLANEUR_CONST int k_near_layers = 0;
FLANEUR_CONST int k_still_layers = 2;
FLANEUR_CONST int k_far_layers = 4;
FLANEUR_CONST int k_shadow_layers = 6;

// Kinds of surfaces, by how light falls on them.
FLANEUR_CONST uint k_kind_ground = 1;  // and roofs
FLANEUR_CONST uint k_kind_wall = 2;    // mirrors the street
FLANEUR_CONST uint k_kind_thing = 3;   // trees, furniture, scenery
FLANEUR_CONST uint k_kind_person = 4;
FLANEUR_CONST uint k_kind_impostor = 5;
FLANEUR_CONST float k_most_glow = 8;  // of a surface, against its albedo

// Bindings of the one descriptor set that every pipeline uses.
FLANEUR_CONST int k_binding_frame = 0;       // FrameConstants
FLANEUR_CONST int k_binding_instances = 1;   // WalkerInstance[]
FLANEUR_CONST int k_binding_palette = 2;     // JointTransform[]
FLANEUR_CONST int k_binding_impostors = 3;   // ImpostorInstance[]
FLANEUR_CONST int k_binding_cells = 4;       // ImpostorCell[]
FLANEUR_CONST int k_binding_sky = 5;         // vec4[], the sky's light at the corners of a grid
FLANEUR_CONST int k_binding_shadow = 6;      // k_shadow_layers
FLANEUR_CONST int k_binding_textures = 7;    // base colours of people, layer 0 white
FLANEUR_CONST int k_binding_atlas = 8;       // of impostors
FLANEUR_CONST int k_binding_scenery = 9;     // pictures of the city's scenery, layer 0 white
FLANEUR_CONST int k_binding_lamps = 10;      // LampMap
FLANEUR_CONST int k_binding_colour = 11;     // of surfaces; see shaders/base/surface.glsl
FLANEUR_CONST int k_binding_surface = 12;    // what else they are
FLANEUR_CONST int k_binding_depth = 13;      // of them
FLANEUR_CONST int k_binding_occlusion = 14;  // half as wide and high as the picture, 1 where nothing is near
FLANEUR_CONST int k_binding_picture = 15;    // the picture before anti-aliasing, luma in alpha
FLANEUR_CONST int k_binding_overlay = 16;    // what is laid over it, alpha multiplied in
FLANEUR_CONST int k_binding_even_occlusion = 17;  // evened out
FLANEUR_CONST int k_binding_letters = 18;         // of panels
FLANEUR_CONST int k_bindings = 19;

// Specialisation constants.
FLANEUR_CONST int k_constant_textured = 0;  // whether people have textures
FLANEUR_CONST int k_constant_smooth = 1;    // whether edges are smoothed
FLANEUR_CONST int k_constant_clamp = 2;  // whether shaders clamp the depth of shadows, as the device does not
FLANEUR_CONST int k_constants = 3;

// What the views for work paint instead of light: a push constant.
FLANEUR_CONST uint k_paint_normals = 0;
FLANEUR_CONST uint k_paint_count = 1;  // a little, added for each time that a pixel is drawn
FLANEUR_CONST uint k_paint_paper = 2;  // pale, under ink
FLANEUR_CONST uint k_paint_ink = 3;    // the edges of triangles
FLANEUR_CONST uint k_paint_ghost = 4;  // seen through, but for its outline
FLANEUR_CONST uint k_paint_ids = 5;    // ids, lowest byte in red; people have them for tints

// Cells of the grid over the picture that the sky's light is known at the corners of.
FLANEUR_CONST int k_sky_columns = 40;
FLANEUR_CONST int k_sky_rows = 24;

// Smoothing of edges: from which contrast on, 0..255; how far along an edge its ends are looked for, pixels.
FLANEUR_CONST int k_least_contrast = 10;
FLANEUR_CONST int k_edge_reach = 8;

// The last joints of the legs, whose places on the ground darken it.
FLANEUR_CONST int k_left_foot = 16;
FLANEUR_CONST int k_right_foot = 20;

// What the shaders know of a frame. Light is linear sRGB, scaled so that the tone curve takes it as it is.
struct FrameConstants {
    mat4 clip_from_world;    // reversed depth, far plane at infinity
    mat4 shadow_from_world;  // to the near shadow map: u, v, depth in 0..1
    vec4 far_scale;          // far map's u, v, depth = near map's * scale + offset
    vec4 far_offset;
    vec4 shadow_texels;   // metres a texel: near, far; resolution; 1 / resolution
    vec4 shadow_layers;   // that are seen: near, still, far
    vec4 people_shadows;  // how plain people's are at d metres from the eye: x - y * d * d, within 0..1
    vec4 eye;             // metres
    vec4 ray_forward;     // the view ray through normalised device coordinates x, y is
    vec4 ray_right;       //   forward + x * right + y * down; w of forward: metres a pixel
                          //   at one metre
    vec4 ray_down;
    vec4 sun_direction;  // towards the sun, or the moon; down where neither throws shadows
    vec4 sun_light;      // what a white surface square to the sun reflects; w: its disc, against that
    vec4 ambient[3];    // of red, green, blue: what a white surface of normal n reflects of sky and ground is
                        //   dot(xyz, n) + w
    vec4 haze_towards;  // sky at the horizon towards the sun; w: haze a metre
    vec4 haze_away;     // and away from it; w: metres where haze begins
    vec4 zenith;        // sky overhead; w: steps gone by, of lenses that light by turns
    vec4 lamp_light;    // what a white surface reflects where the lamp map says 1; w: share of lit windows
    vec4 lamp_map;      // texels from the map's corner = x, z * xy + zw
    vec4 window_light;  // a lit room, seen; w: how plainly stars are seen
    vec4 screen;        // of the picture: width, height, 1 / width, 1 / height
    vec4 samples;       // of a pixel: along each edge, 1 over that; 1 over the width and height of surfaces
    vec4 way;       // 1 or 0: lamps are lit; plain light, of sun and sky, with neither shadows nor haze nor
                    // patterns;
                    //   surfaces are painted, and not lit; something is laid over the picture
    vec4 backdrop;  // where nothing is, display-ready; w: 1 if there is one, -1 if edges stay as they are
};

#endif
