// A contact sheet of people, drawn by the renderer.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "assets/character.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

// Someone to be shown.
struct Sitter {
    Character character;
    std::array<uint32_t, k_tint_count> tints;  // of skin, hair and clothes
    std::string caption;
};

// The file for a sheet of so many people. Refuses, at once, what would be too large or cannot be written.
Result<PartFilePtr> open_sheet(const PeopleOptions& people, size_t count);

// Shows each in a cell: with its arms held out, from ahead, beside a step of its walk,
// half from the side; all at one scale, or each as large as fits. Close: two views of the face instead. All
// turned by PeopleOptions::turn.
Result<void> draw_sheet(PartFilePtr file, const std::vector<Sitter>& sitters, bool one_scale,
                        const Options& options);

}  // namespace flaneur
