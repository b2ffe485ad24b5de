// Depth before all triangles where a cell has no pixels, so that no fragment is shaded there.
#include "modern/frustum-traced/lists.glsl"

uniform int view;

void main() {
    gl_FragDepth = counts[cellIndex(view, ivec2(gl_FragCoord.xy))] == 0u ? 0.0 : 1.0;
}
