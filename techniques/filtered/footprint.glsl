// Where a receiver lies in a prefiltered map, and the pixel's footprint there. The footprint is that of the receiver's
// plane, so that it does not jump where another surface begins in the image; long ones are read at several places along
// their longer axis, as anisotropic hardware filters do.
#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform mat4 imageFromWorld;      // pixels
uniform vec4 unitDepthFromWorld;  // 0 at the map's near and 1 at its far distance

const int mostProbes = 8;

struct FilteredReceiver {
    vec2 at;      // position in the map
    float depth;  // in [0, 1]
    vec2 axis;    // longer axis of the pixel's footprint, in the map
    int probes;   // places along it
    float level;  // of the mipmaps
    bool known;   // false: background, or where the map holds nothing
};

/// How a projected point moves while its original moves along the tangents u and v.
mat2 projectedTangents(mat4 projection, vec3 world, vec3 u, vec3 v) {
    vec4 h = projection * vec4(world, 1.0);
    vec4 hu = projection * vec4(u, 0.0);
    vec4 hv = projection * vec4(v, 0.0);
    vec2 at = h.xy / h.w;
    return mat2((hu.xy - at * hu.w) / h.w, (hv.xy - at * hv.w) / h.w);
}

/// Movement in the map per pixel of the image along its x and y.
mat2 footprint(vec3 world, vec3 normal) {
    Tangents t = tangentsOf(normal);
    mat2 image = projectedTangents(imageFromWorld, world, t.u, t.v);
    if (abs(determinant(image)) < 1e-6) return mat2(0.0);  // seen edge-on
    return projectedTangents(mapFromWorld, world, t.u, t.v) * inverse(image);
}

/// Change of unit depth along the receiver's plane per unit of map x and y; zero where the plane is seen edge-on.
vec2 planeSlope(vec3 world, vec3 normal) {
    Tangents t = tangentsOf(normal);
    mat2 tangents = projectedTangents(mapFromWorld, world, t.u, t.v);
    if (abs(determinant(tangents)) < 1e-12) return vec2(0.0);
    return vec2(dot(unitDepthFromWorld.xyz, t.u), dot(unitDepthFromWorld.xyz, t.v)) * inverse(tangents);
}

/// In a map of `texels` per side.
FilteredReceiver filteredReceiver(float texels) {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    float depth = clamp(dot(unitDepthFromWorld, vec4(receiver.position, 1.0)), 0.0, 1.0);
    FilteredReceiver r = FilteredReceiver(point.at.xy, depth, vec2(0.0), 1, 0.0, receiver.seen && !point.behind);
    r.known = r.known && all(greaterThanEqual(r.at, vec2(0.0))) && all(lessThanEqual(r.at, vec2(1.0)));
    if (!r.known) return r;

    vec3 normal = normalAt(gl_FragCoord.xy);
    mat2 perPixel = footprint(receiver.position, normal);
    float along = texels * max(length(perPixel[0]), length(perPixel[1]));
    if (along <= 1.0) return r;  // magnified
    float across = texels * texels * abs(determinant(perPixel)) / along;
    r.axis = length(perPixel[0]) > length(perPixel[1]) ? perPixel[0] : perPixel[1];
    r.probes = clamp(int(ceil(along / max(across, 1.0))), 1, mostProbes);
    r.level = max(log2(along / float(r.probes)), 0.0);
    return r;
}

/// One of the places that it is read at.
vec2 probeAt(FilteredReceiver r, int probe) {
    return r.at + ((float(probe) + 0.5) / float(r.probes) - 0.5) * r.axis;
}

/// What a map with mipmaps stores, averaged over the footprint.
vec4 filtered(sampler2D map, FilteredReceiver r) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < r.probes; ++i) sum += textureLod(map, probeAt(r, i), r.level);
    return sum / float(r.probes);
}
