#include "filtered/unit_depth.glsl"
#include "modern/sat-vsm/summed_moments.glsl"

out uvec2 moments;

void main() {
    moments = momentsOf(unitDepth(texelFetch(windowDepths, ivec2(gl_FragCoord.xy), 0).r));
}
