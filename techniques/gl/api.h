// The GL entry points, for .cpp files in techniques/ and gpu/ only: no GL type appears in a header. No library of OpenGL is
// linked: within this namespace each function is a pointer of the same name, which is null until a context is made
// (techniques/gl/context.h). The prototypes outside are there for their types; nothing defines them.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

namespace shadowbench {

#define GL_FUNCTION(name) extern decltype(&::name) name; // NOLINT(bugprone-macro-parentheses): no expression
#include "techniques/gl/functions.inc"
#undef GL_FUNCTION

} // namespace shadowbench
