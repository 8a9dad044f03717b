#include "assets/place.h"

#include <algorithm>
#include <iterator>

namespace flaneur {

// Degrees north and east.
struct Land {
    double south, north, west, east;
};

// In pieces that leave out neighbours who drive on the right.
static constexpr Land k_on_left[] = {
    {49.8, 61, -10.7, 1.8},                               // Britain and Ireland
    {35.7, 36.1, 14.1, 14.6},                             // Malta
    {34.5, 35.8, 32.2, 34.7},                             // Cyprus
    {30.5, 45.6, 129.6, 146},                             // Japan
    {24, 30.5, 122.9, 131.5},                             // and its southern islands
    {22.15, 22.5, 113.8, 114.5},                          // Hong Kong
    {5.6, 13, 98, 102.9},                                 // Thailand
    {13, 18, 98.5, 102.5},       {-11, 6.7, 95, 119.3},   // Malaysia, Singapore, Indonesia
    {-11, 4, 119.3, 155},                                 // and Papua New Guinea
    {-44, -10, 112, 154},                                 // Australia
    {-47.5, -34, 166, 179},                               // New Zealand
    {-19.3, -16, 177, 180},                               // Fiji
    {5.9, 24, 66.5, 92.5},                                // India, Bangladesh, Sri Lanka,
    {24, 28, 61.7, 92.5},                                 // Pakistan,
    {28, 30.3, 66.7, 85},                                 // Nepal
    {30.3, 35, 69.5, 79},        {-35, -17.3, 11.7, 41},  // from South Africa
    {-17.3, -8.3, 22, 41},       {-8.3, 4.6, 31, 42},     // to Kenya
    {17.7, 18.6, -78.4, -76.1},                           // Jamaica
    {20.9, 27.3, -79, -72.7},                             // the Bahamas
    {10, 13.4, -62, -59.4},                               // Trinidad, Barbados
    {1.8, 8.6, -61.4, -54},                               // Guyana, Suriname
};

bool is_driven_on_left(const MapPlace& p) {
    return std::any_of(std::begin(k_on_left), std::end(k_on_left), [&](const Land& land) {
        return p.latitude >= land.south && p.latitude <= land.north && p.longitude >= land.west &&
               p.longitude <= land.east;
    });
}

}  // namespace flaneur
