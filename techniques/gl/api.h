// The GL entry points, for .cpp files in techniques/ only: no GL type appears in a header.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
