// Levels of service by density: J. J. Fruin, Pedestrian Planning and Design, 1971, and for walkways and
// stairs Designing for Pedestrians: A Level-of-Service Concept, Highway Research Record 355, 1971. He tells
// square feet a person, from which a level begins.
#pragma once

#include <cstdint>

namespace flaneur {

enum class ServiceOf : uint8_t { walkway, stairs, queue };

// People to a square metre up to which it is A, B, C, D and E; beyond the last it is F.
//   walkways  35, 25, 15, 10 and 5 square feet a person
//   stairs    20, 15, 10, 7 and 4
//   queues    13, 10, 7, 3 and 2
inline constexpr float k_fruin_densities[] = {0.31f, 0.43f, 0.72f, 1.08f, 2.15f};
inline constexpr float k_fruin_stairs[] = {0.54f, 0.72f, 1.08f, 1.54f, 2.69f};
inline constexpr float k_fruin_queues[] = {0.83f, 1.08f, 1.54f, 3.59f, 5.38f};
inline constexpr int k_service_levels = 6;

// 0: A .. 5: F
inline int fruin_level(float density, ServiceOf of = ServiceOf::walkway) {
    const float* most = of == ServiceOf::walkway  ? k_fruin_densities
                        : of == ServiceOf::stairs ? k_fruin_stairs
                                                  : k_fruin_queues;
    int level = 0;
    while (level < k_service_levels - 1 && density > most[level]) ++level;
    return level;
}

}  // namespace flaneur
