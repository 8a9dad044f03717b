#include "renderer/device/capture.h"

#if __has_include(<renderdoc_app.h>)

#include <dlfcn.h>
#include <renderdoc_app.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace flaneur {
namespace {

using Api = RENDERDOC_API_1_1_2;  // all RenderDocs since 2017 have it

// Null where RenderDoc is not here. Looked for each time: instances bring it and take it away.
const Api* find_api() {
    void* library = dlopen("librenderdoc.so", RTLD_NOW | RTLD_NOLOAD);
    if (!library) return nullptr;
    const auto get = reinterpret_cast<pRENDERDOC_GetAPI>(dlsym(library, "RENDERDOC_GetAPI"));
    void* api = nullptr;
    if (!get || get(eRENDERDOC_API_Version_1_1_2, &api) == 0) api = nullptr;
    dlclose(library);
    return static_cast<const Api*>(api);
}

// It is flaneur that asked for it, and names captures.
bool is_ours = false;

std::string last_capture(const Api& api) {
    const uint32_t count = api.GetNumCaptures();
    uint32_t length = 0;
    if (count == 0 || api.GetCapture(count - 1, nullptr, &length, nullptr) == 0) return {};
    std::string path(length, '\0');
    api.GetCapture(count - 1, path.data(), &length, nullptr);
    path.resize(std::min(path.find('\0'), path.size()));
    return path;
}

Error no_capture(const std::string& path, const std::string& why) {
    return Error{"RenderDoc wrote no capture " + path + ": " + why};
}

}  // namespace

bool has_renderdoc() { return find_api() != nullptr; }

bool has_renderdoc_started_us() { return has_renderdoc() && !is_ours; }

Error no_renderdoc() {
    return Error{
        "RenderDoc, which captures frames, is not installed: install librenderdoc, and qrenderdoc or "
        "renderdoccmd to look at captures."};
}

void quieten_renderdoc() {
    const Api* api = find_api();
    if (!api) return;
    is_ours = true;
    api->MaskOverlayBits(eRENDERDOC_Overlay_None, eRENDERDOC_Overlay_None);
    api->SetCaptureKeys(nullptr, 0);
    api->SetFocusToggleKeys(nullptr, 0);
    api->UnloadCrashHandler();
}

Result<void> begin_capture(VkInstance instance) {
    const Api* api = find_api();
    if (!api) return no_renderdoc();
    api->StartFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(instance), nullptr);
    if (api->IsFrameCapturing() == 0)
        return Error{"RenderDoc does not begin a capture: its log, in the folder /tmp/RenderDoc, says why."};
    return {};
}

Result<std::string> end_capture(VkInstance instance, const std::string& path) {
    const Api* api = find_api();
    if (!api) return no_renderdoc();
    std::error_code failed;
    const std::filesystem::path wanted = std::filesystem::absolute(path, failed);
    if (failed) return no_capture(path, failed.message() + ".");
    if (is_ours) api->SetCaptureFilePathTemplate((wanted.string() + ".part").c_str());
    const bool is_done =
        api->EndFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(instance), nullptr) != 0;
    const std::string written = is_done ? last_capture(*api) : "";
    if (written.empty() || !std::filesystem::exists(written, failed))
        return no_capture(path,
                          "is there room, and a folder that can be written to? Its log, in the folder "
                          "/tmp/RenderDoc, says more.");
    if (!is_ours) return written;
    std::filesystem::rename(written, wanted, failed);
    if (failed) return no_capture(path, failed.message() + ". It is " + written + " instead.");
    return path;
}

}  // namespace flaneur

#else  // where there is no RenderDoc, nothing else is missing

namespace flaneur {

bool has_renderdoc() { return false; }

bool has_renderdoc_started_us() { return false; }

Error no_renderdoc() {
    return Error{
        "This flaneur was built without RenderDoc, which captures frames: install librenderdoc-dev and "
        "build it anew."};
}

void quieten_renderdoc() {}

Result<void> begin_capture(VkInstance) { return no_renderdoc(); }

Result<std::string> end_capture(VkInstance, const std::string&) { return no_renderdoc(); }

}  // namespace flaneur

#endif
