#include "gl/half.glsl"

/// On its way into the targets.
vec4 rounded(vec4 moments) {
#if defined(FORMAT_RG16F) || defined(FORMAT_RGBA16F)
    return toHalf(moments);
#else
    return moments;
#endif
}
