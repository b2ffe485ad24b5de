in vec3 world;
flat in uint surfaceId;

uniform vec3 eye;

layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out uint id;
#ifdef MOTION
in vec3 previousWorld;
layout(location = 3) out vec4 previousPosition;
#endif

void main() {
    position = vec4(world, 1.0);
    // The triangle is flat, so screen-space derivatives span its plane. Right × up points towards the viewer, but where the other row of
    // pixels lies beyond the plane's horizon: there its point is behind the viewer.
    vec3 side = cross(dFdx(world), dFdy(world));
    normal = vec4(normalize(dot(side, eye - world) < 0.0 ? -side : side), 0.0);
    id = surfaceId;
#ifdef MOTION
    previousPosition = vec4(previousWorld, 1.0);
#endif
}
