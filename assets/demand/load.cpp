#include "assets/city.h"
#include "assets/demand/demand_file.h"
#include "assets/files/file.h"
#include "assets/osm/map.h"

namespace flaneur {

std::optional<Vec2> place_on_plane(const City& city, const MapPlace& place) {
    if (!city.on_earth) return std::nullopt;
    const MapPlace& middle = city.on_earth->middle;
    return projection_about(middle.longitude, middle.latitude).at(place.longitude, place.latitude);
}

Result<SentPeople> load_demand(const std::string& path, const City& city) {
    constexpr size_t k_most_bytes = 256 << 20;
    const std::string subject = "The demand " + excerpt(path) + " ";
    const Result<Bytes> bytes = read_bytes(path, k_most_bytes);
    if (!bytes) return Error{subject + bytes.error().message + "."};
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    Result<SentPeople> sent =
        has_ending(path, ".xml") ? parse_sumo_persons(text, city) : parse_demand(text, city);
    if (!sent) return Error{subject + sent.error().message + "."};
    size_t people = 0;
    for (const Sending& sending : sent->sendings) people += sending.people;
    if (people > k_most_sent)
        return Error{subject + "sends " + std::to_string(people) + " people, and there may be " +
                     std::to_string(k_most_sent) + " at most."};
    return sent;
}

}  // namespace flaneur
