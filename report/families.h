// The families of techniques, and the one colour that each has in charts and on pages.
#pragma once

#include <span>
#include <string>

namespace shadowbench::report {

struct Family {
    const char* id;     // its folder under techniques/; "external" of other renderers, "other" of what lies in no folder
    const char* title;  // "shadow maps"
    const char* colour; // on white; site/assets/style.css has it, too, and one for dark pages
};

/// In the order in which charts and pages list them.
std::span<const Family> families();

/// The family of a technique by its id.
const Family& familyOf(const std::string& technique);

} // namespace shadowbench::report
