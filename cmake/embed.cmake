# cmake -DOUT=header.h -DNAME=k_array "-DFILES=a.json;b.json" -P embed.cmake
# Writes a header with the files' texts, sorted by name: `inline constexpr EmbeddedFile NAME[]`.
list(SORT FILES)
set(entries "")
foreach(file IN LISTS FILES)
    get_filename_component(stem ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${stem}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#pragma once

#include <string_view>

namespace flaneur {

struct EmbeddedFile {
    std::string_view name, text;
};
inline constexpr EmbeddedFile @NAME@[] = {
@entries@};

}  // namespace flaneur
]])
