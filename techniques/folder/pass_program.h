// The shaders of a technique folder's pass as one program, and what they may declare.
#pragma once

#include "techniques/contract/parameters.h"
#include "techniques/folder/description.h"
#include "techniques/gl/program.h"

namespace shadowbench::techniques {

/// Compiled for these parameters. Throws BadInput, one line that begins with the file and the line where there is one: for
/// what does not compile or link, a uniform that nothing sets or of another type, and a target that is read while it is
/// written.
gl::Program programOf(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values);

} // namespace shadowbench::techniques
