#include "groundtruth/povray/uncertainty.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::groundtruth::povray {
namespace {

/// Calls `visit(x, y)` for the pixels of the surface at (cx, cy) in the (2·radius + 1)² window around it, itself included.
template <typename Visit>
void forWindow(const Image<std::uint32_t>& id, int cx, int cy, int radius, const Visit& visit) {
    for (int y = std::max(0, cy - radius); y <= std::min(id.height() - 1, cy + radius); ++y)
        for (int x = std::max(0, cx - radius); x <= std::min(id.width() - 1, cx + radius); ++x)
            if (id(x, y) == id(cx, cy)) visit(x, y);
}

double square(double value) { return value * value; }

/// The mean over `many` + `rest` samples is `all`, that over the first `many` is `first`: the mean over the rest.
double restOf(double all, double first, int many, int rest) { return all + (all - first) * many / rest; }

} // namespace

Image<std::uint8_t> unresolvedPixels(const Image<float>& visible, const Image<std::uint32_t>& id) {
    Image<std::uint8_t> result(visible.width(), visible.height());
    for (int y = 0; y < visible.height(); ++y) {
        for (int x = 0; x < visible.width(); ++x) {
            if (id(x, y) == 0) continue;
            const float here = visible(x, y);
            bool resolved = here == 0 || here == 1;
            forWindow(id, x, y, 1, [&](int nx, int ny) { resolved = resolved && visible(nx, ny) == here; });
            result(x, y) = resolved ? 0 : 1;
        }
    }
    return result;
}

Image<float> samplingUncertainty(const Render& image, const Image<std::uint32_t>& id, int samples) {
    const Image<std::uint8_t> unresolved = unresolvedPixels(image.visible, id);
    const SampleParts parts = sampleParts(samples);
    const double rounding = 1.0 / (12.0 * samples * samples);
    Image<float> sigma(id.width(), id.height());
    for (int y = 0; y < id.height(); ++y) {
        for (int x = 0; x < id.width(); ++x) {
            if (unresolved(x, y) == 0) continue;
            double halves = 0, quarters = 0;
            int count = 0;
            forWindow(id, x, y, 2, [&](int nx, int ny) {
                if (unresolved(nx, ny) == 0) return;
                const double quarter = image.firstQuarter(nx, ny), half = image.firstHalf(nx, ny);
                const int many = parts.firstQuarter + parts.secondQuarter;
                halves += square(half - restOf(image.visible(nx, ny), half, many, parts.secondHalf));
                quarters += square(quarter - restOf(half, quarter, parts.firstQuarter, parts.secondQuarter));
                ++count;
            });
            sigma(x, y) = static_cast<float>(std::sqrt(std::max(halves / 4, quarters / 8) / count + rounding));
        }
    }
    return sigma;
}

} // namespace shadowbench::groundtruth::povray
