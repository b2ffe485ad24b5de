#include "groundtruth/area_comparison.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::groundtruth {

PenumbraError penumbraError(const Reference& sampled, const Reference& exact) {
    PenumbraError result;
    double squares = 0;
    for (std::size_t i = 0; i < sampled.visibility.size(); ++i) {
        if (sampled.surface[i] != Surface::Receiver || exact.surface[i] != Surface::Receiver) continue;
        const double error = static_cast<double>(sampled.visibility[i]) - static_cast<double>(exact.visibility[i]);
        const bool partial = sampled.visibility[i] > 0 && sampled.visibility[i] < 1;
        if (error == 0 && !partial) continue;
        squares += error * error;
        ++result.pixels;
    }
    if (result.pixels > 0) result.rms = std::sqrt(squares / static_cast<double>(result.pixels));
    return result;
}

void requireNearExact(const Reference& sampled, const Reference& exact) {
    constexpr double fewestPenumbraPoints = 32; // as of a certificate
    constexpr double most = 1.5; // the rms of 32 points is known to an eighth, and these may be the easier ones
    const auto& measured = sampled.provenance.measured;
    const auto penumbra = measured.find("certificate_penumbra"), rms = measured.find("certificate_rms");
    if (penumbra == measured.end() || rms == measured.end() || penumbra->second < fewestPenumbraPoints) return;
    const float bracket = *std::ranges::max_element(exact.sigma);
    const PenumbraError found = penumbraError(sampled, exact);
    if (found.rms <= most * rms->second + 0.25 / sampled.provenance.samples + static_cast<double>(bracket)) return;
    throw Inconclusive(fmt::format(
        "POV-Ray's shadows differ from the exact visible fraction by {:.5f} (rms over {} penumbra pixels), which is more "
        "than "
        "{} times the {:.5f} at the points of its certificate: nothing is scored against them; ask for more samples, and "
        "report this scene if that does not help",
        found.rms, found.pixels, most, rms->second));
}

} // namespace shadowbench::groundtruth
