// The share of the light's irradiance that reaches a pixel, interpolated between the points of its triangle
// (techniques/environment/surface_points.h).
layout(std430, binding = 0) readonly buffer Surfaces { uint surfaces[]; };  // of each: first patch, sides, mirrored
struct Patch {
    vec3 origin;
    uint firstRow;
    vec3 along;
    uint steps;
    vec3 up;
};
layout(std430, binding = 1) readonly buffer Patches { Patch patches[]; };
layout(std430, binding = 2) readonly buffer Rows { uvec2 rows[]; };  // first point, steps
layout(std430, binding = 3) readonly buffer Irradiance { float irradiance[]; };  // of each point
layout(std430, binding = 4) readonly buffer Unshadowed { float unshadowed[]; };  // of each patch

in vec3 world;
flat in uint surfaceId;

out float visibility;

/// Irradiance at a share of the way along a row.
float alongRow(uint row, float share) {
    uvec2 points = rows[row];
    float at = clamp(share, 0.0, 1.0) * float(points.y);
    uint left = min(uint(at), points.y - min(points.y, 1u));
    uint right = min(left + 1u, points.y);
    return mix(irradiance[points.x + left], irradiance[points.x + right], at - float(left));
}

float irradianceAt(Patch patch_, vec3 fromOrigin) {
    float up = clamp(dot(patch_.up, fromOrigin), 0.0, 1.0);
    float share = dot(patch_.along, fromOrigin) / max(1.0 - up, 1e-6);
    float at = up * float(patch_.steps);
    uint lower = min(uint(at), patch_.steps - min(patch_.steps, 1u));
    uint upper = min(lower + 1u, patch_.steps);
    return mix(alongRow(patch_.firstRow + lower, share), alongRow(patch_.firstRow + upper, share), at - float(lower));
}

void main() {
    uint sides = surfaces[3u * surfaceId + 1u];
    uint side = (gl_FrontFacing ? 0u : 1u) ^ surfaces[3u * surfaceId + 2u];
    visibility = 0.0;
    if (side >= sides) return;  // the inner side of a closed body
    uint number = surfaces[3u * surfaceId] + sides * uint(gl_PrimitiveID) + side;
    Patch patch_ = patches[number];
    if (unshadowed[number] > 0.0) visibility = clamp(irradianceAt(patch_, world - patch_.origin) / unshadowed[number], 0.0, 1.0);
}
