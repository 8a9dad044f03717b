// What the renderer is handed, all of it plain data. SceneMeshes is uploaded once: a city, the people who
// walk in it, and its lamps. FrameInput is what moves: camera, sun, walkers. Either may be as empty as it is
// made: a scene without people is a city, a scene without anything is sky. shapes.h has simple pieces of a
// city to begin with.
//
// Metres, seconds, radians; right-handed, +y up. Triangles run counter-clockwise seen from their front, and
// only fronts are seen. Colours are sRGB, R in the lowest byte: 0xff0000ff is red.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/panels.h"
#include "renderer/shared.h"
#include "renderer/work_views.h"
#include "sim/base/levels.h"

namespace flaneur {

struct CityVertex {
    glm::vec3 position;  // metres
    uint32_t colour;     // sRGB, R in the lowest byte
    // Metres. Facade: u along the wall from its left end, v above its foot; windows are fitted to the extent
    // that vertices joined by triangles span. Crossing: u along the way people cross. Other ground: the
    // ground plane. Scenery: of its texture, which repeats. Lenses: when they are lit, see k_material_lens.
    glm::vec2 uv;
    int8_t normal[4];    // unit vector * 127; [3] unused
    uint16_t material;   // k_material_*
    uint16_t extra;      // facades: facade_extra. Scenery: 1 + index into CityMesh::textures, or 0.
    uint32_t house = 0;  // facades: any number; those of one house share their taste in windows and doors
    uint32_t id = 0;     // below 2^24, the same in all corners of a triangle: what Image::ids tells of it
};

// How a facade's windows look; at most four kinds.
enum class WindowKind : uint8_t { sash, shuttered, arched, wide };
// In place of a storey's height: a wall without windows, and one of panes from foot to top.
inline constexpr float k_no_windows = 0, k_all_glass = k_storey_unit;
// CityVertex::extra of a facade: the height of its storeys (up to 25 m, to 5 cm), whether it has shop fronts,
// and which bay the door is in, counted from u = 0 (up to the 15th; -1: none).
inline uint16_t facade_extra(float storey, bool shop, int door_bay = -1,
                             WindowKind windows = WindowKind::sash) {
    const uint32_t height = static_cast<uint32_t>(storey / k_storey_unit + 0.5f) & k_storey_mask;
    const bool has_door = door_bay >= 0 && door_bay < static_cast<int>(k_door_mask);
    const uint32_t door = has_door ? static_cast<uint32_t>(door_bay + 1) : 0;
    return static_cast<uint16_t>(height | uint32_t{shop} << k_shop_shift | door << k_door_shift |
                                 static_cast<uint32_t>(windows) << k_windows_shift);
}

struct PersonVertex {
    glm::vec3 position;  // bind pose, metres
    uint32_t colour;     // sRGB, R in the lowest byte
    glm::vec2 uv;
    int8_t normal[4];  // unit vector * 127; [3]: tint, 0..k_tints-1
    uint8_t joints[4];
    uint8_t weights[4];  // sum to 255, falling
    uint32_t texture;    // index into PersonMesh::textures, or ~0u
};

struct RgbaImage {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba;  // sRGB, rows from the top
};

// From where a triangle of the city is drawn: nearer or farther than where a metre is 25 pixels.
enum class SeenFrom : uint8_t { near, anywhere, far };

struct CityMesh {
    std::vector<CityVertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<SeenFrom> seen_from;  // one a triangle, or empty: all from anywhere
    std::vector<RgbaImage> textures;  // of scenery; nothing is seen where alpha is below a half
};

inline constexpr uint32_t k_max_lods = k_person_levels;

struct PersonMesh {
    std::vector<PersonVertex> vertices;
    std::vector<std::vector<uint32_t>>
        lods;  // triangle lists, finest first, some equal; those after k_max_lods are not drawn
    std::vector<RgbaImage> textures;
    // What impostors are baked from: k_stride_poses poses of k_palette_joints transforms each, about
    // WalkerDraw::centre, facing +z: a walk at phases 0, 1/8 .. 7/8, then standing. Empty: the mesh has no
    // impostors, and its coarsest level is drawn however far away.
    std::vector<JointTransform> strides;
    bool is_thing = false;  // no person, and never WalkerDraw::is_upright
};

// What street lamps and shop windows give at night, seen from above.
struct LampMap {
    uint32_t width = 0, height = 0;  // texels; 0: no lamps
    glm::vec2 low{0, 0};             // x and z of the corner of the first texel, metres
    float texel = 1;                 // edge, metres
    // Rows by growing z. xyz: the sum over lamps of illuminance, 1 below a street lamp, times the way to the
    // lamp; y as the ground has it, x and z as bodies a metre above it have them. w: height of the ground.
    std::vector<glm::vec4> texels;
};

struct SceneMeshes {
    CityMesh city;
    LampMap lamps;
    std::vector<PersonMesh> people;
    // The impostors of these people, as baked_impostors() in renderer.h gave them: what takes most of an
    // upload. Empty, or of another size than they are: they are baked.
    std::vector<uint32_t> impostors;
};

// A WalkerInstance::palette of one who is seen so small, if at all, that an impostor will do; see PoseNeeds.
inline constexpr uint32_t k_no_palette = ~0u;

// One walker of a frame.
struct WalkerDraw {
    glm::vec3 centre;  // of a sphere that holds the body, metres
    float radius = 1;
    uint32_t mesh = 0;  // index into SceneMeshes::people
    WalkerInstance instance;
    bool is_upright = true;  // else it is drawn as a mesh however far away
    float heading = 0;       // yaw about +y, 0 faces +z, radians
    float phase = -1;        // of the stride, [0, 1), as PersonMesh::strides has them; below 0: stands
    uint32_t id = 0;         // below 2^24: what Image::ids tells of it
    uint8_t presence = 255;  // how much of it is seen, in pixels of each 4x4: 255 all, 0 nothing
};

// The ground about a place, as a plane. There is none where the normal is zero.
struct GroundPlane {
    glm::vec3 place{0};  // metres
    glm::vec3 normal{0};
};

// The ground that a walker darkens softly: below each foot, left and right, below the body, and between the
// wheels of what it pushes.
struct GroundBelow {
    GroundPlane feet[2], body, pram;
};

struct Camera {
    glm::vec3 eye{0, 1.6f, 0};
    glm::vec3 target{0, 1.6f, 1};
    glm::vec3 up{0, 1, 0};      // what is up in the picture, unit; not the way it looks
    float vertical_fov = 0.6f;  // radians
    float near_plane = 0.1f;    // metres; the far plane is at infinity (reversed depth)
    float clear_air = 0;        // metres before the eye in which there is no haze, for maps from high above
};

struct Sun {
    glm::vec3 direction{0.4f, 0.42f, 0.8f};  // towards the sun, unit; at night below the horizon
};

// What a picture is drawn without, to see what that costs and what it does to the picture.
struct Spared {
    // Of sun or moon: nothing is drawn into their maps, and what looks there finds light.
    bool shadows = false;
    bool smoothing = false;  // of edges
    bool impostors = false;  // all people are meshes
    bool contacts = false;   // the ground below people is not darkened
    bool lamps = false;      // and lit windows, to which eyes are used all the same
};

// Everything that may change from frame to frame.
struct FrameInput {
    Camera camera;
    Sun sun;
    std::span<const WalkerDraw> walkers;
    std::span<const JointTransform> palette;    // k_palette_joints for each walker that refers to it
    std::span<const GroundBelow> grounds = {};  // in the palette's order; those beyond them darken no ground
    // For comparisons with other renderers, off-screen alone: no shadows, sky, haze or smoothing after the
    // picture is drawn, but this colour (sRGB) where nothing is.
    std::optional<glm::vec3> backdrop = {};
    bool is_finest = false;  // every walker is drawn by its finest mesh
    // Index of a walker with whom the eye goes, and who so would stay between two levels of detail: drawn by
    // one of them. ~0: nobody.
    uint32_t companion = ~0u;
    Spared without = {};
    bool skips_hidden = true;  // what walls hide is not drawn; the picture is the same either way
    // Crowd, city and sky are stages of their own rather than one, the scene, and what shaders were called
    // for is counted: slower, and the same picture.
    bool times_passes = false;
    bool wants_depths = false;  // off-screen: those of the picture too; see Image
    bool wants_ids = false;     // the same; all is drawn once more for them
    bool is_overcast = false;
    float lit_windows = 0.3f;  // share of windows with a light on in the dark
    float lens_time = 0;       // of lenses that light by turns: steps gone by; see k_material_lens
    // Views for work. What is not asked for costs nothing.
    Surfaces surfaces = Surfaces::lit;  // wireframe needs a device that can_draw_wireframe()
    PeopleColours people_colours = PeopleColours::own;
    bool are_ghosts = false;                // people are seen through, but for their outlines; not impostors
    std::span<const GizmoLine> lines = {};  // later ones over earlier ones
    std::span<const GizmoCorner> fills = {};  // three a triangle
    Panels panels = {};                       // over all of it
    // In a window, (0, 1]: the picture is drawn in this share of its pixels along each edge, and scaled up to
    // it; panels stay sharp.
    float resolution = 1;
};

}  // namespace flaneur
