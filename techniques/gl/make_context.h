// The two ways to a context, for techniques/gl/context.cpp.
#pragma once

#include "techniques/gl/context.h"
#include "techniques/gl/library.h"

#include <memory>

namespace shadowbench::gl {

/// The libraries, opened when they are first asked for.
const Library& osMesaLibrary();
const Library& eglLibrary();

/// Both throw Inconclusive, saying what to install, where no OpenGL 4.5 can be had that way.
std::unique_ptr<Context> makeOsMesaContext(const ContextOptions& options);
/// `software`: not on a graphics processor, even if there is one.
std::unique_ptr<Context> makeEglContext(const ContextOptions& options, bool software);

/// Mesa reads these environment variables when it makes a context; they fix the code that is generated, hence the image and
/// the instruction count. The process keeps the memory that it frees from then on.
void fixRasteriser(const ContextOptions& options);

} // namespace shadowbench::gl
