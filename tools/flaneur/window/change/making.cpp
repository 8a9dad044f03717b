#include "tools/flaneur/window/change/making.h"

#include <chrono>
#include <utility>

#include "assets/pastimes/places.h"
#include "assets/stages/platform.h"
#include "sim/pastimes/pastimes.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/design.h"

namespace flaneur {

Result<Made> make(const Order& order) {
    Made made;
    made.added = order.added;
    made.ground = order.ground;
    const bool is_other_platform = order.ground != order.ground_before;
    if (order.added == order.before && !is_other_platform) {
        made.lamps = extract_lamps(*order.city);
        return made;
    }
    if (is_other_platform) {
        Result<City> platform = build_platform(order.ground);
        if (!platform) return platform.error();
        made.bare = std::make_shared<const City>(std::move(*platform));
    }
    City city = is_other_platform ? *made.bare : *order.bare;
    if (Result<void> done = add_to_city(city, order.added); !done) return done.error();
    made.city = std::make_shared<const City>(std::move(city));
    made.changed = changed_areas(order.before, order.added);
    if (is_other_platform) made.changed.push_back(area_about(order.ground_before, order.ground));
    const Ground &ground = made.city->ground, &before = order.city->ground;
    auto mesh = rebuild_navmesh(ground, order.settings, order.mesh, before.low, before.high, made.changed,
                                order.threads);
    if (!mesh) return mesh.error();
    made.mesh = std::move(*mesh);
    auto drawn = prepare_for_upload(extract_city(*made.city));
    if (!drawn) return drawn.error();
    made.drawn = std::move(*drawn);
    if (order.with_lamps) made.lamps = extract_lamps(*made.city);
    return made;
}

void begin(Making& making, Order order) {
    making.is_lamps = order.added == order.before && order.ground == order.ground_before;
    making.coming = std::async(std::launch::async, [order = std::move(order)] { return make(order); });
}

std::optional<Result<Made>> finish(Making& making) {
    if (!is_making(making) || making.coming.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return making.coming.get();
}

Result<void> move_in(Show& show, Made made, bool holds_old) {
    if (made.city) {
        Result<void> done =
            holds_old ? hold_city(*show.renderer, *made.drawn, {}) : upload_city(*show.renderer, *made.drawn);
        if (done && holds_old) done = exchange_cities(*show.renderer);
        if (!done) return done;
        if (made.bare) show.loaded.bare = made.bare;
        show.loaded.city = made.city;
        change_ground(*show.loaded.world, std::shared_ptr<const Ground>(made.city, &made.city->ground),
                      std::move(made.mesh), made.city->destinations, made.changed);
        World& world = *show.loaded.world;
        set_places(*world.pastimes, pastime_places(*made.city), *world.navmesh, world.crowd);
        show.overlay.walkable.clear();
        show.has_lamps = false;
    }
    if (!made.lamps) return {};
    show.has_lamps = true;
    return upload_lamps(*show.renderer, *made.lamps);
}

}  // namespace flaneur
