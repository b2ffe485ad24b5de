// Percentage-closer filtering around a receiver (Reeves, Salesin, Cook 1987), shared by what filters a shadow map's tests.
#include "shared/maps/light_space.glsl"

/// Share of kernel × kernel tests that pass. `slope` is the depth of the receiver's plane per unit of map x and y, so that each tap is
/// compared with the plane beside the receiver; zero compares all of them with the receiver's own depth.
float percentageCloser(sampler2DShadow map, MapPoint point, vec2 slope, int kernel) {
    if (point.behind) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(map, 0));
    float passed = 0.0;
    for (int y = 0; y < kernel; ++y)
        for (int x = 0; x < kernel; ++x) {
            vec2 offset = (vec2(x, y) - 0.5 * float(kernel - 1)) * texel;
            passed += texture(map, point.at + vec3(offset, dot(slope, offset)));
        }
    return passed / float(kernel * kernel);
}
