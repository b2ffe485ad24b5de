// Names of parametrised tests: letters, digits and underscores only.
#pragma once

#include <algorithm>
#include <cctype>
#include <gtest/gtest.h>
#include <string>

namespace shadowbench {

inline std::string testName(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
}

/// Of tests over scenes or variants.
inline std::string nameOfText(const testing::TestParamInfo<std::string>& tested) { return testName(tested.param); }

} // namespace shadowbench
