// The module flaneur._native: what Python has of the simulation, of trajectories and of measures. Axes are
// those of files of trajectories throughout: x to the east, y to the north, z upwards, so that x is our x, y
// is our -z and z is our y.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "assets/measures/tracks.h"
#include "assets/trajectories/trajectories.h"
#include "sim/base/result.h"

namespace flaneur {

// In Python flaneur.Refused: a sentence.
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};
template <class T>
T taken(Result<T> result) {
    if (!result) throw Refusal(result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// A column of its own memory.
template <class T>
pybind11::array_t<T> column(std::span<const T> values) {
    return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}
template <class T, class Row, class Value>
pybind11::array_t<T> column(const std::vector<Row>& rows, Value value) {
    pybind11::array_t<T> to(static_cast<pybind11::ssize_t>(rows.size()));
    T* at = to.mutable_data();
    for (const Row& row : rows) *at++ = static_cast<T>(value(row));
    return to;
}

// Trajectories and their index, which points into them: to be neither copied nor moved.
struct Tracks {
    Trajectories of;
    TrackTable table;
    Tracks() = default;
    Tracks(const Tracks&) = delete;
    Tracks& operator=(const Tracks&) = delete;
};

// While a thread loads, Ctrl-C stops it (is_stopping() in tools/flaneur/console/ending.h), and what is said
// is kept for it.
void begin_loading();
std::vector<std::string> end_loading();

void add_world(pybind11::module_& module);
pybind11::class_<Tracks> add_tracks(pybind11::module_& module);
void add_measures(pybind11::module_& module, pybind11::class_<Tracks>& tracks);

}  // namespace flaneur
