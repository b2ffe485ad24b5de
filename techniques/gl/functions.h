// Fills the pointers of techniques/gl/api.h.
#pragma once

#include <functional>
#include <string>

namespace shadowbench::gl {

/// Sets each function to what `find` returns for its name. Throws Inconclusive naming `library` and a function that it
/// lacks.
void loadFunctions(const std::string& library, const std::function<void*(const char* name)>& find);

} // namespace shadowbench::gl
