#include "python/native/native.h"

PYBIND11_MODULE(_native, module) {
    using namespace flaneur;
    module.doc() = "The compiled part of flaneur.";
    module.attr("__version__") = FLANEUR_VERSION;
    const auto refused = pybind11::register_exception<Refusal>(module, "Refused", PyExc_ValueError);
    refused.doc() = "What cannot be done, in a sentence that says why.";
    refused.attr("__module__") = "flaneur";
    add_world(module);
    auto tracks = add_tracks(module);
    add_measures(module, tracks);
}
