// The map of a logarithmic perspective shadow map: LogView of log_view.h.
uniform mat4 planeFromWorld;
uniform vec2 slopes;  // x / v at the map's left rim, and from there to its right one
uniform vec2 warp;    // v at its lower rim, and the logarithm of how many times that v is at its upper one

/// Where a point of the light's plane lies in the map.
vec2 onMap(vec2 at) {
    return vec2((at.x / at.y - slopes.x) / slopes.y, log(at.y / warp.x) / warp.y);
}

/// And back.
vec2 onPlane(vec2 map) {
    float v = warp.x * exp(warp.y * map.y);
    return vec2((slopes.x + slopes.y * map.x) * v, v);
}
