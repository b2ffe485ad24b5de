// A map of depth alone, read as linear depth (shared/maps/linearised_map.h).
uniform sampler2D windowDepths;  // in [0, 1]; 1 where nothing is in the way, and beside the map
uniform vec4 linearisation;

const float nothingInTheWay = 1e30;

float linearised(float window, vec4 by) {
    // 1 − z is exact for z in [½, 1]; the same terms in another order would lose the last bits of far depths.
    precise float reciprocal = (1.0 - window) + by.z * window;
    return (by.x + by.y * window) / reciprocal + by.w;
}

float linearised(float window) {
    return linearised(window, linearisation);
}

/// Metres along the light's axis of a window depth.
float linearDepth(float window) {
    return window < 1.0 ? linearised(window) : nothingInTheWay;
}

float linearDepthAt(vec2 at) {
    return linearDepth(texture(windowDepths, at).r);
}
