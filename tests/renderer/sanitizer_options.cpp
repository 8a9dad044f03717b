// Mesa and the validation layer leave memory behind when they are unloaded, which the leak sanitizer cannot
// tell from ours. Vulkan objects that are left behind are reported by the validation layer, and fail the
// test.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
