// What each pixel asks of the maps (shared/maps/tile_choice.h, Demand). Surfaces that face away from the light ask for nothing and are
// dark.
#include "gl/receiver.glsl"
#include "gl/tangents.glsl"
#include "shared/maps/cube_side.glsl"
#ifdef DISCONTINUITY
#include "shared/maps/depth_atlas.glsl"

uniform float discontinuity;  // share of a pixel's weight that it has only for an edge beside it
#endif

uniform mat4 planeFromWorld[6];  // x, y and depth in [0, 1] over the plane (shared/light_views/light_planes.h)
uniform int planes;              // 1, or the six sides of a cube around the light
uniform vec4 light;              // homogeneous
uniform sampler2D normals;
uniform mat4 clipFromWorld;  // camera
uniform float most;          // pixels along a map's side, at most: they grow without end where the light grazes a surface

layout(location = 0) out vec4 demand;  // plane + x, y, pixels along x and y (0: asks for nothing)
layout(location = 1) out float visibility;

const float averted = -0.005;  // cosine: what the 16 bits of a normal leave uncertain

/// Change of x, y, z over w along the tangent `t` of the surface at the point that `transform` takes to `h`.
vec3 along(mat4 transform, vec4 h, vec3 t) {
    vec4 d = transform * vec4(t, 0.0);
    return (d.xyz - h.xyz / h.w * d.w) / h.w;
}

#ifdef DISCONTINUITY
/// Length of shadow edge, in pixels, to be expected in this pixel from depth discontinuities of the map; the surface's depth changes by
/// `slope` over the plane. An edge may run wherever the nine texels around the point are not all lit or all shadowed: in a band three
/// texels wide.
float edgeInPixel(int plane, vec3 world, vec2 slope, vec2 pixels) {
    vec4 h = atlasFromWorld[plane] * vec4(world, 1.0);
    vec3 at = h.xyz / h.w;
    vec4 inner = innerTiles[plane];
    vec2 texel = 1.0 / vec2(textureSize(depthAtlas, 0));
    vec2 texelOfPlane = texel / (inner.zw - inner.xy + texel);
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 offset = vec2(x, y);
            vec2 tap = clamp(at.xy + offset * texel, inner.xy, inner.zw);
            lit += texture(depthAtlas, vec3(tap, min(at.z + dot(slope * texelOfPlane, offset), 1.0)));
        }
    if (lit < 0.5 || lit > 8.5) return 0.0;
    return 1.0 / max(1.0, 3.0 * length(pixels * texelOfPlane));
}
#endif

void main() {
    demand = vec4(0.0);
    visibility = 1.0;
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    if (!receiver.seen) return;
    vec3 normal = texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz;
    if (dot(normal, normalize(light.xyz - light.w * receiver.position)) < averted) {
        visibility = 0.0;
        return;
    }

    int plane = planes == 1 ? 0 : sideOf(receiver.position - light.xyz);
    Tangents t = tangentsOf(normal);
    vec4 inImage = clipFromWorld * vec4(receiver.position, 1.0);
    vec4 inPlane = planeFromWorld[plane] * vec4(receiver.position, 1.0);
    vec2 viewport = 0.5 * vec2(textureSize(positions, 0));  // pixels of a unit of clip space
    mat2 pixelOfSurface = mat2(viewport * along(clipFromWorld, inImage, t.u).xy, viewport * along(clipFromWorld, inImage, t.v).xy);
    vec3 du = along(planeFromWorld[plane], inPlane, t.u), dv = along(planeFromWorld[plane], inPlane, t.v);
    float determinant = du.x * dv.y - du.y * dv.x;

    vec2 pixels = vec2(most);
    vec2 slope = vec2(0.0);
    if (abs(determinant) > 1e-7 * length(du.xy) * length(dv.xy)) {
        mat2 surfaceOfPlane = mat2(dv.y, -du.y, -dv.x, du.x) / determinant;
        mat2 pixelOfPlane = pixelOfSurface * surfaceOfPlane;
        pixels = min(vec2(length(pixelOfPlane[0]), length(pixelOfPlane[1])), most);
        slope = vec2(du.z, dv.z) * surfaceOfPlane;
    }
#ifdef DISCONTINUITY
    pixels *= mix(1.0, edgeInPixel(plane, receiver.position, slope, pixels), discontinuity);
#endif
    vec2 at = clamp(inPlane.xy / inPlane.w, 0.0, 1.0 - 1.0 / 1048576.0);  // the plane's number leaves 20 bits
    demand = vec4(at.x + float(plane), at.y, max(pixels, 1e-20));
}
