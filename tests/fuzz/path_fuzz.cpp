// libFuzzer's target for camera paths: any bytes are a path that is written as it was read, or are refused in
// a short sentence.
#include <cstdlib>
#include <string_view>

#include "assets/camera_path.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    const auto path = parse_path({reinterpret_cast<const char*>(data), size});
    if (!path) {
        const std::string& message = path.error().message;
        if (message.size() > 500) std::abort();
        for (char c : message)
            if (static_cast<unsigned char>(c) < 0x20) std::abort();
        return 0;
    }
    if (path->keys.empty() || path->keys.size() > k_most_keys) std::abort();
    for (size_t i = 1; i < path->keys.size(); ++i)
        if (!(path->keys[i].time > path->keys[i - 1].time)) std::abort();
    const std::string text = path_text(*path);
    const auto again = parse_path(text);
    if (!again || path_text(*again) != text) std::abort();
    return 0;
}
