layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D depths;
writeonly uniform image2D means;

#ifdef KERNEL_WIDE
const int reach = 3;
#else
const int reach = 1;
#endif

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), last = textureSize(depths, 0) - 1;
    vec2 sum = vec2(0.0);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            float depth = texelFetch(depths, clamp(at + ivec2(x, y), ivec2(0), last), 0).r;
            sum += vec2(depth, depth * depth);
        }
    imageStore(means, at, vec4(sum / float((2 * reach + 1) * (2 * reach + 1)), 0.0, 0.0));
}
