// Navigation meshes once built are kept on disk.
#pragma once

#include <functional>
#include <string>

#include "sim/base/result.h"
#include "sim/navigation/navmesh.h"

namespace flaneur {

// build_navmesh(..), or what an earlier run kept of it in `folder`; keeps it there if it can. The same mesh
// either way: files are named by what of the ground and the settings the mesh is made from, and by the
// sources that make it; one that is damaged is made anew. An empty `folder` keeps nothing.
Result<NavmeshPtr> cached_navmesh(const Ground& ground, const NavmeshSettings& settings, int threads,
                                  const std::string& folder, const std::function<bool(float)>& progress = {});

}  // namespace flaneur
