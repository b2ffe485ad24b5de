// The paraboloid map of a half space around a light, which fills the share FILLED of the tile's half width.
uniform float far;     // metres: depth 1

/// From a position in the light's frame (z along the map's axis) to x and y in [−1, 1] over the tile and depth in [0, 1]. A direction n
/// meets the tile at n.xy / (1 + n.z): rays from the light stay straight, edges bend.
vec3 paraboloid(vec3 position) {
    float distance = length(position);
    vec3 n = position / distance;
    return vec3(FILLED * n.xy / (1.0 + n.z), distance / far);
}
