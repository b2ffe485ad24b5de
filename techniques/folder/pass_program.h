// The shaders of a technique folder's pass as one program, and what they may declare.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/folder/description.h"
#include "techniques/gl/program.h"

#include <map>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

/// Compiled for these parameters, of which the light has as many `views`. Throws BadInput, one line that begins with the
/// file and the line where there is one: for what does not compile or link, a uniform that nothing sets or of another type,
/// and a target that is read while it is written.
gl::Program programOf(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values, int views);

/// Whether a uniform of this type is stored into.
bool isImage(std::string_view type);

/// Hashes of all that passes draw with but parameters: their shaders with what these include, and their state; by their
/// names.
std::map<std::string, std::string> passHashes(const TechniqueFolder& folder);

} // namespace shadowbench::techniques
