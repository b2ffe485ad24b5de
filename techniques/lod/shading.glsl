// Flat colour under one light without shadow: enough that levels differ in shading as well as in outline.
in vec3 world;
flat in vec3 surfaceColour;

uniform vec4 light;  // homogeneous position

const float ambient = 0.35;

vec3 shaded() {
    // The triangle is flat, so screen-space derivatives span its plane; right × up points towards the viewer.
    vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
    vec3 towardsLight = normalize(light.xyz - light.w * world);
    return surfaceColour * (ambient + (1.0 - ambient) * max(dot(normal, towardsLight), 0.0));
}
