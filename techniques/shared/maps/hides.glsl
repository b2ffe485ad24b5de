// Whether a triangle hides a light from a point. The corners are taken relative to the point, so that what is computed is small where the
// decision is close.

/// `light` is homogeneous: w = 0 is a direction towards the light. A triangle whose plane is closer to `point` than `slack` does not
/// hide anything from it: the point lies on it.
bool hides(vec3 v0, vec3 v1, vec3 v2, vec3 point, vec4 light, float slack) {
    vec3 a = v0 - point, b = v1 - point, c = v2 - point;
    vec3 ray = light.xyz - light.w * point;
    precise float ab = dot(ray, cross(a, b)), bc = dot(ray, cross(b, c)), ca = dot(ray, cross(c, a));
    if (min(ab, min(bc, ca)) < 0.0 && max(ab, max(bc, ca)) > 0.0) return false;  // the ray's line passes beside it
    vec3 normal = cross(b - a, c - a);
    float height = dot(a, normal);
    if (abs(height) <= slack * length(normal)) return false;
    float along = ab + bc + ca;  // = ray · normal: the ray meets the plane at height / along of its length
    return along != 0.0 && height / along > 0.0 && (light.w == 0.0 || height / along < 1.0);
}
