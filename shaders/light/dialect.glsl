// The words that shaders/light/light.h is written in, for GLSL: a pixel at a time. renderer/light/sweep.cpp has them
// for many at once.
#define SHARED
#define real float
#define real3 vec3
#define truth bool

bool some(bool b) { return b; }
bool both(bool a, bool b) { return a && b; }
bool either(bool a, bool b) { return a || b; }
float select(bool b, float yes, float no) { return b ? yes : no; }
vec3 select(bool b, vec3 yes, vec3 no) { return b ? yes : no; }
float lerp(float a, float b, float t) { return a + (b - a) * t; }
vec3 lerp(vec3 a, vec3 b, float t) { return a + (b - a) * t; }
vec3 make3(float x, float y, float z) { return vec3(x, y, z); }
