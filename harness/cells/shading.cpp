#include "harness/cells/shading.h"

#include "base/error.h"
#include "base/srgb.h"
#include "scene/sky_sampler.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <map>

namespace shadowbench {
namespace {

/// The irradiance that surfaces get from an environment that nothing hides.
class Unshadowed {
public:
    explicit Unshadowed(const EnvironmentLight& light) {
        constexpr int side = 32; // more change no shade that an eye tells apart
        const SkySampler sampler(light);
        for (std::size_t part = 0; part < sampler.parts(); ++part)
            for (int i = 0; i < side * side; ++i)
                directions_.push_back(sampler.at(part, (glm::dvec2(i % side, i / side) + 0.5) / double(side)));
    }

    /// Triangles have a normal each, so there are few.
    double on(const glm::vec3& normal) {
        const auto [found, isNew] = known_.try_emplace({normal.x, normal.y, normal.z}, 0);
        if (isNew)
            for (const SkyDirection& direction : directions_)
                found->second += direction.irradiance * irradianceWeight(direction.towards, normal);
        return found->second;
    }

private:
    std::vector<SkyDirection> directions_;
    std::map<std::array<float, 3>, double> known_;
};

Image<float> irradianceShares(const EnvironmentLight& light, const metrics::Drawn& drawn, const Image<glm::vec3>& normals) {
    Unshadowed unshadowed(light);
    Image<float> shares(normals.width(), normals.height());
    for (std::size_t i = 0; i < shares.size(); ++i)
        if (drawn.id[i] != 0) shares[i] = static_cast<float>(unshadowed.on(normals[i]));
    const float most = *std::ranges::max_element(shares);
    if (most > 0)
        for (float& share : shares) share /= most;
    return shares;
}

/// 0 of black, which stays black.
float timesAmbient(const glm::vec3& direct, const glm::vec3& ambient) {
    const float most = std::max({ambient.x, ambient.y, ambient.z});
    return most > 0 ? std::max({direct.x, direct.y, direct.z}) / most : 0;
}

} // namespace

PictureShading pictureShading(const Snapshot& snapshot, const metrics::Drawn& drawn, const Image<glm::vec3>& normals) {
    const metrics::Shading shading = metrics::shading(snapshot, drawn, normals);
    PictureShading result{shading.ambient, Image<float>(drawn.id.width(), drawn.id.height())};
    const Light& light = snapshot.light;
    const auto shares = light.isEnvironment() ? irradianceShares(*light.environment, drawn, normals) : Image<float>();
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        if (drawn.id[i] == 0)
            result.ambient[i] = metrics::shownBackground;
        else if (light.isEnvironment())
            result.direct[i] = shares[i] * (1 - metrics::ambientShare) / metrics::ambientShare;
        else
            result.direct[i] = timesAmbient(shading.direct[i], shading.ambient[i]);
    }
    return result;
}

PictureShading pictureShading(SceneFrames& frames) {
    frames.show(frames.scored());
    return pictureShading(frames.stage().shown(), frames.drawn(), frames.stage().normals());
}

Image<glm::vec3> shadedPicture(const PictureShading& shading, const Image<float>& v) {
    if (!v.sameSize(shading.direct)) throw InternalError("shading a picture of another size; draw both at one size");
    Image<glm::vec3> picture = shading.ambient;
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] = forScreen((1 + std::clamp(v[i], 0.0F, 1.0F) * shading.direct[i]) * picture[i]);
    return picture;
}

} // namespace shadowbench
