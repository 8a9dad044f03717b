// Where references lie: GOLDEN/KEY/CASE.png, or GOLDEN/KEY/CASE/PICTURE.png of a case with several; its parts
// GOLDEN/KEY/CASE.parts/PART.png and .json, or PART.hash.
#pragma once

#include <string>
#include <vector>

#include "tools/rendercheck/suite/suite.h"

namespace flaneur {

// GOLDEN of a suite.
std::string golden_folder(const Suite& suite);

// Keys that there are references of.
std::vector<std::string> keys_in(const std::string& golden);

// Of the picture of this number; the ending is .png or .exr, as `file` has it, and .png where it has another.
std::string reference_path(const std::string& golden, const std::string& key, const SuiteCase& one,
                           size_t picture);
// Without an ending.
std::string part_path(const std::string& golden, const std::string& key, const SuiteCase& one,
                      const SuitePart& part);

// What is kept of a picture: of one of 8 bits its pixels alone, of deeper ones the file.
Result<std::vector<uint8_t>> kept_bytes(const CheckedPicture& picture, const std::vector<uint8_t>& file);

// 16 digits, of size and pixels.
std::string pixel_hash(const CheckedPicture& picture);

}  // namespace flaneur
