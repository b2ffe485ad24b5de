// A pixel's surface point against a map of linear depth and what is drawn over it (bindOutlineReceiver of soft/outline_geometry.h).
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"
#include "shared/maps/linearised_map.glsl"

uniform sampler2D normals;
uniform mat4 lightFromWorld;    // metres right, up and away from the light's plane
uniform vec2 texel;             // its width and height in the light's image, the plane at unit distance
uniform vec2 bias;              // of the receiver's depth: in slopes per texel, and in metres

struct OutlineReceiver {
    vec2 at;         // in [0, 1] over the map
    float depth;     // metres from the light's plane
    float perTexel;  // how much deeper the receiver's plane is a texel away in x and in y
    float blocker;   // the map's depth
    bool unseen;     // background, or behind the light
};

OutlineReceiver outlineReceiver() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    vec3 p = (lightFromWorld * vec4(receiver.position, 1.0)).xyz;
    vec3 n = mat3(lightFromWorld) * normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    // The plane dot(n, q) = dot(n, p) has depth dot(n, p) / dot(n, (x, y, 1)) at (x, y) of the light's image.
    float slope = p.z * p.z / max(abs(dot(n, p)), 1e-9);
    return OutlineReceiver(point.at.xy, p.z, slope * dot(abs(n.xy), texel), linearDepthAt(point.at.xy),
                         !receiver.seen || point.behind);
}

/// What the receiver's depth may differ from the map's where both are of one plane: the map has it half a texel away at most.
float slack(OutlineReceiver r) {
    return 0.5 * bias.x * r.perTexel + bias.y;
}

bool blocked(OutlineReceiver r) {
    return r.depth > r.blocker + slack(r);
}

/// Whether the receiver is what its texel sees, so that what is drawn over the map was computed for it.
bool isForemost(OutlineReceiver r) {
    return r.depth >= r.blocker - slack(r) - 0.5 * r.perTexel;
}
