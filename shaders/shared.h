// Every struct and constant that CPU and GPU share. Included by GLSL and by C++ (through renderer/shared.h, which
// maps the GLSL names to GLM's).
#ifndef FLANEUR_SHADERS_SHARED_H
#define FLANEUR_SHADERS_SHARED_H

#ifdef __cplusplus
#define FLANEUR_CONST inline constexpr
#else
#define FLANEUR_CONST const
#endif

FLANEUR_CONST int k_palette_joints = 22;  // joint transforms of one walker
FLANEUR_CONST int k_tints = 7;            // none, skin, hair, top, bottom, shoes, accent

// One joint: a point v of the mesh (bind pose, scaled) goes to rotate(rotation, v) + translation in the world.
struct JointTransform {
    vec4 rotation;     // unit quaternion, vector part first
    vec4 translation;  // metres; w unused
};

// One walker as the vertex shader sees it.
struct WalkerInstance {
    uint palette;          // first of its joint transforms
    float scale;           // of the mesh before skinning
    uint fade;             // unused, 0
    uint tints[9];         // sRGB, R in the lowest byte; indexed by a vertex's tint, [0] is white
};

// What a city vertex is made of; city.frag draws each by a procedure.
FLANEUR_CONST uint k_material_road = 0;
FLANEUR_CONST uint k_material_sidewalk = 1;
FLANEUR_CONST uint k_material_crossing = 2;
FLANEUR_CONST uint k_material_plaza = 3;
FLANEUR_CONST uint k_material_path = 4;
FLANEUR_CONST uint k_material_steps = 5;
FLANEUR_CONST uint k_material_grass = 6;
FLANEUR_CONST uint k_material_water = 7;
FLANEUR_CONST uint k_material_facade = 8;   // u: metres along the wall, v: metres above its foot; windows by storey
FLANEUR_CONST uint k_material_stone = 9;    // garden walls, kerbs, risers
FLANEUR_CONST uint k_material_roof = 10;
FLANEUR_CONST uint k_material_leaves = 11;
FLANEUR_CONST uint k_material_trunk = 12;
FLANEUR_CONST uint k_material_metal = 13;   // lamps, bollards, benches

#endif
