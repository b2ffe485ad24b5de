#include "base/error.h"
#include "harness/metrics/frames.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::metrics {
namespace {

constexpr double relativeAgreement = 2e-3;
constexpr double absoluteAgreement = 1e-4; // metres

bool hitsAgree(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye, std::size_t pixel) {
    if (truth.id[pixel] != drawn.id[pixel]) return false;
    if (truth.surface[pixel] == groundtruth::Surface::Background) return true;
    const double exact = glm::distance(glm::dvec3(truth.position[pixel]), eye);
    const double rasterised = glm::distance(glm::dvec3(drawn.position[pixel]), eye);
    return std::abs(rasterised - exact) <= relativeAgreement * exact + absoluteAgreement; // false for a NaN
}

} // namespace

Mask receiverMask(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye) {
    if (!drawn.id.sameSize(truth.id) || !drawn.position.sameSize(truth.id) || !truth.surface.sameSize(truth.id) ||
        !truth.position.sameSize(truth.id))
        throw InternalError("masking receivers of a truth and a drawing of different sizes; render both at one size");

    Mask mask{Image<std::uint8_t>(truth.id.width(), truth.id.height()), 0, 0};
    std::size_t disagreeing = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (!hitsAgree(truth, drawn, eye, i)) {
            ++disagreeing;
            continue;
        }
        if (truth.surface[i] != groundtruth::Surface::Receiver) continue;
        mask.scored[i] = 1;
        ++mask.count;
    }
    if (!truth.id.empty()) mask.primaryMismatch = static_cast<double>(disagreeing) / static_cast<double>(truth.id.size());
    return mask;
}

} // namespace shadowbench::metrics
