// What the programs that make seeds share: each is called with a folder, and fills it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

// The folder that the program is to fill; ends it where there is none.
inline std::filesystem::path seeds_folder(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << argv[0] << " FOLDER\n";
        std::exit(1);
    }
    std::filesystem::create_directories(argv[1]);
    return argv[1];
}

template <class Bytes>
void write_seed(const std::filesystem::path& path, const Bytes& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(std::data(bytes)), std::streamsize(std::size(bytes)));
    if (!file) {
        std::cerr << "Cannot write " << path << "\n";
        std::exit(1);
    }
}
