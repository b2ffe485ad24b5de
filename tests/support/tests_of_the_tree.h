// The tests that the tree has: for data that names tests.
#pragma once

#include "base/files.h"

#include <filesystem>
#include <regex>
#include <set>
#include <string>

namespace shadowbench {

/// "Suite.Name" of every test, as its source has it.
inline std::set<std::string> testsOfTheTree() {
    static const std::regex macro(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    std::set<std::string> names;
    for (const std::filesystem::directory_entry& file :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SOURCE_FOLDER) / "tests")) {
        if (!file.path().filename().string().ends_with("_test.cpp")) continue;
        const std::string text = readFile(file.path());
        for (std::sregex_iterator at(text.begin(), text.end(), macro), end; at != end; ++at)
            names.insert((*at)[1].str() + "." + (*at)[2].str());
    }
    return names;
}

} // namespace shadowbench
