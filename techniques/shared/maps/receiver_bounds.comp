// Boxes, in a projective space, of the surface points that the camera's pixels see: one for each range of eye depth
// (shared/maps/receiver_bounds.h).
#include "gl/invocation.glsl"
#include "shared/maps/ordered.glsl"

uniform sampler2D positions;
uniform int rowsEach;            // pixels of an invocation: part of a column
uniform vec4 eyeDepthFromWorld; // dot with (p, 1)
uniform vec4 ranges[RANGES];    // x, y: least and greatest depth
uniform mat4 clipFromWorld;

/// For each range x, y, z at their greatest, then −x, −y, −z at theirs, in the code of ordered(); 0: no point.
layout(std430, binding = 3) buffer Extremes { uint extremes[]; };

void main() {
    ivec2 size = textureSize(positions, 0);
    int x = int(invocation()) % size.x, firstRow = int(invocation()) / size.x * rowsEach;
    const float none = -1e38;
    vec3 high[RANGES], low[RANGES]; // low: of the negated point
    for (int i = 0; i < RANGES; ++i) high[i] = low[i] = vec3(none);
    for (int y = firstRow; y < min(firstRow + rowsEach, size.y); ++y) {
        vec4 point = texelFetch(positions, ivec2(x, y), 0);
        vec4 world = vec4(point.xyz, 1.0);
        float depth = dot(eyeDepthFromWorld, world);
        vec4 h = clipFromWorld * world;
        if (point.w < 0.5 || h.w <= 0.0) continue;
        vec3 at = h.xyz / h.w;
        for (int i = 0; i < RANGES; ++i) {
            bool inside = ranges[i].x <= depth && depth <= ranges[i].y;
            high[i] = max(high[i], inside ? at : vec3(none));
            low[i] = max(low[i], inside ? -at : vec3(none));
        }
    }
    for (int i = 0; i < RANGES; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            if (high[i][axis] == none) continue;
            atomicMax(extremes[6 * i + axis], ordered(high[i][axis]));
            atomicMax(extremes[6 * i + 3 + axis], ordered(low[i][axis]));
        }
}
