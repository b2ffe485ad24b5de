// On which side of a hard shadow's border a point lies. One expression for all shaders, so that what a quad counts and what a wedge adds
// never disagree.

/// Whether the plane through an edge and `middle`, the light's, has `point` on the side of the edge's layers. The edge is taken relative to
/// the point, so that what is computed is small where the decision is close.
bool onHiddenSide(vec3 from, vec3 to, vec3 middle, vec3 point) {
    precise float side = dot(middle - point, cross(from - point, to - point));
    return side > 0.0;
}
