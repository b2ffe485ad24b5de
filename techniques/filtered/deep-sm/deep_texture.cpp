#include "techniques/filtered/deep-sm/deep_texture.h"

#include "base/error.h"

#include <algorithm>

namespace shadowbench::techniques {

void buildDeepTexture(const Image<float>& depths, int samples, float error, DeepTexture& deep) {
    if (depths.width() != depths.height() || depths.width() % samples != 0)
        throw InternalError("a deep shadow map's depths are no square of whole texels");
    const int side = depths.width() / samples;
    deep.first.clear();
    deep.nodes.clear();
    std::vector<float> hits;
    Transmittance exact;
    for (int y = side - 1; y >= 0; --y)
        for (int x = 0; x < side; ++x) {
            hits.clear();
            for (int j = 0; j < samples; ++j)
                for (int i = 0; i < samples; ++i) {
                    const float depth = depths(x * samples + i, y * samples + j);
                    if (depth < 1) hits.push_back(depth);
                }
            std::sort(hits.begin(), hits.end());
            gatherSteps(hits, samples * samples, exact);
            deep.first.push_back(static_cast<std::uint32_t>(deep.nodes.size()));
            compress(exact, error, deep.nodes);
        }
    deep.first.push_back(static_cast<std::uint32_t>(deep.nodes.size()));
}

} // namespace shadowbench::techniques
