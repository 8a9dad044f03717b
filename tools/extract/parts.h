// Pieces of extract_scene and extract_lamps.
#pragma once

#include "assets/city.h"
#include "renderer/scene.h"

namespace flaneur {

// Whether a facade has shop windows at its foot.
bool is_shop_front(const City& city, const Face& face);

// Appends what darkens the ground where little sky is seen from it.
void add_shades(const City& city, CityMesh& mesh);

// Appends scenery to a mesh, with its pictures.
void add_scenery(const Scenery& scenery, CityMesh& mesh);

}  // namespace flaneur
