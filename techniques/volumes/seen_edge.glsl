// An edge as a surface point sees it before the light's plane (course, "Transform the Silhouette Edge to Projection Space").
uniform mat4 unitLightFromWorld;  // unitLightFromWorld() of volumes/penumbra_wedges.h

/// Ends of the edge, projected from the point onto the light's plane, in homogeneous coordinates: (x, y) / z, where the light is [−1, 1]²,
/// or the disk within. z is the height above the point, towards the light.
struct SeenEdge {
    vec3 from, to;
    float lightHeight;  // above the point
    float up;           // along the z axis of the light, 1 or −1
};

SeenEdge seenEdge(vec3 from, vec3 to, vec3 point) {
    vec3 p = (unitLightFromWorld * vec4(point, 1.0)).xyz;
    float up = p.z > 0.0 ? -1.0 : 1.0, height = abs(p.z);
    // Relative to the point: what is computed is small for an edge close by.
    vec3 a = mat3(unitLightFromWorld) * (from - point), b = mat3(unitLightFromWorld) * (to - point);
    a.z *= up;
    b.z *= up;
    return SeenEdge(vec3(p.xy * a.z + a.xy * height, a.z), vec3(p.xy * b.z + b.xy * height, b.z), height, up);
}

/// Where along the edge, 0 to 1, the part begins and ends that lies between the point and the light's plane and is seen before the square
/// [−1, 1]²: none where it ends before it begins.
vec2 partBeforeSquare(SeenEdge edge) {
    vec4 a = vec4(edge.from.z - edge.from.xy, edge.from.z + edge.from.xy), b = vec4(edge.to.z - edge.to.xy, edge.to.z + edge.to.xy);
    float c = edge.lightHeight - edge.from.z, d = edge.lightHeight - edge.to.z;
    vec4 crossing = a / (a - b);
    vec4 low = mix(vec4(0.0), crossing, lessThan(a, vec4(0.0))), high = mix(vec4(1.0), crossing, lessThan(b, vec4(0.0)));
    vec2 part = vec2(max(max(low.x, low.y), max(low.z, low.w)), min(min(high.x, high.y), min(high.z, high.w)));
    if (c < 0.0) part.x = max(part.x, c / (c - d));
    if (d < 0.0) part.y = min(part.y, c / (c - d));
    bool beside = any(lessThan(max(a, b), vec4(0.0))) || max(c, d) < 0.0;
    return beside ? vec2(1.0, 0.0) : part;
}
