// A prefiltered map's mean over a pixel's footprint.
#include "filtered/footprint.glsl"

uniform sampler2DArray maps;

FilteredReceiver filteredReceiver() {
    return filteredReceiver(float(textureSize(maps, 0).x));
}

/// The stored functions of depth, averaged over kernel and footprint.
vec4 filtered(FilteredReceiver r, int layer) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < r.probes; ++i) sum += textureLod(maps, vec3(probeAt(r, i), layer), r.level);
    return sum / float(r.probes);
}
