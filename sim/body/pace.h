// How fast people like to walk.
#pragma once

namespace flaneur {

// The mean of what people of an age (years) and sex prefer on level ground, m/s. Those with short legs
// (metres, from hip joint to ground), children first of all, walk at the Froude number of grown people.
//
// Bohannon & Andrews, Physiotherapy 97, 2011; Alexander, "Principles of Animal Locomotion", 2003.
float usual_speed(float age, bool woman, float leg);

// What people prefer at most, so that they walk rather than run: Froude number 0.45, m/s.
float fastest_walk(float leg);

}  // namespace flaneur
