// Whether a triangle may hide the light from a point of a box: what need not be tested for any pixel whose point lies in it.

struct Box {
    vec3 middle, halfSize;
};

/// False is certain. `lights`, homogeneous: the light is what lies between them. A triangle hides a point of the light where that is
/// beyond the triangle's plane and on the inner side of the planes through the box's point and an edge. How far it is on that side is
/// linear in the box's point and in the light's, so that it is greatest at corners of both.
bool mayHide(vec3 v0, vec3 v1, vec3 v2, Box box, vec4 lights[LIGHTS]) {
    vec3 a = v0 - box.middle, b = v1 - box.middle, c = v2 - box.middle;
    vec3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a), normal = cross(b - a, c - a);
    float longest = max(max(distance(a, b), distance(b, c)), distance(c, a));
    float farthest = max(max(length(a), length(b)), length(c)) + length(box.halfSize);
    const float rounding = 1e-5;  // of products of these lengths: far above that of floats
    float height = dot(a, normal);
    if (abs(height) <= dot(box.halfSize, abs(normal)) + rounding * farthest * farthest * longest) return true;  // the plane meets the box
    float side = sign(height);
    vec4 highest = vec4(-1.0);
    for (int i = 0; i < LIGHTS; ++i) {
        vec3 light = lights[i].xyz - lights[i].w * box.middle;
        float margin = rounding * (length(light) + lights[i].w * farthest) * farthest;
        vec3 beyond = vec3(dot(light, ab), dot(light, bc), dot(light, ca)) * side +
                      vec3(dot(box.halfSize, abs(cross(light, b - a) - lights[i].w * ab)),
                           dot(box.halfSize, abs(cross(light, c - b) - lights[i].w * bc)),
                           dot(box.halfSize, abs(cross(light, a - c) - lights[i].w * ca)));
        highest = max(highest, vec4(beyond + margin * farthest, side * dot(light - lights[i].w * a, normal) + margin * longest));
    }
    return all(greaterThanEqual(highest, vec4(0.0)));
}
