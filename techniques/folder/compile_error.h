// What is said of a technique folder's shader that does not compile or link.
#pragma once

#include "techniques/folder/description.h"
#include "techniques/gl/program.h"

#include <string>

namespace shadowbench::techniques {

/// The first error of the compiler's or the linker's `log` as one line, with file and line where there is one, in words of
/// the folder; then near matches of a name that is not there, and the types of parameters where types do not go together.
std::string compileError(const TechniqueFolder& folder, const FolderPass& pass, const gl::Defines& defines,
                         const std::string& log);

} // namespace shadowbench::techniques
