#include "renderer/device/names.h"

namespace flaneur {

void name_object(const Device& device, VkObjectType type, uint64_t handle, const std::string& name) {
    if (!device.has_labels) return;
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    vkSetDebugUtilsObjectNameEXT(device.handle, &info);  // names are for people: nothing hangs on them
}

}  // namespace flaneur
