/// Side through which a direction from the light leaves a cube around it: cubeSide() of shared/light_views/cube_view.h.
int sideOf(vec3 direction) {
    vec3 size = abs(direction);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
}
