// What of an error is the same for every seed, and what is noise.
#include "base/error.h"
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace shadowbench::metrics {

std::optional<SeedErrors> seedErrors(const SeedFrames& frames) {
    const auto count = static_cast<double>(frames.images.size());
    if (count < 2 || frames.mask.count == 0) return {};
    for (const Image<float>& image : frames.images) requireComparable({image, frames.truth, frames.mask});
    double errors = 0, squares = 0, variances = 0;
    for (std::size_t i = 0; i < frames.mask.scored.size(); ++i) {
        if (!frames.mask.scored[i]) continue;
        double mean = 0, around = 0;
        for (const Image<float>& image : frames.images) mean += (image[i] - frames.truth.visibility[i]) / count;
        for (const Image<float>& image : frames.images) {
            const double error = image[i] - frames.truth.visibility[i];
            squares += error * error / count;
            around += (error - mean) * (error - mean);
        }
        errors += mean;
        variances += around / (count - 1);
    }
    const auto pixels = static_cast<double>(frames.mask.count);
    SeedErrors result;
    result.rmse = std::sqrt(squares / pixels);
    result.bias = errors / pixels;
    result.noise = std::sqrt(variances / pixels);
    result.systematic = std::sqrt(std::max(0.0, (squares - variances) / pixels));
    return result;
}

MeanInterval meanInterval(const std::vector<double>& samples) {
    if (std::ranges::all_of(samples, [&](double sample) { return sample == samples.front(); }))
        return {samples.front(), 0}; // not what rounding leaves of it
    const auto count = static_cast<double>(samples.size());
    double sum = 0, around = 0;
    for (const double sample : samples) sum += sample;
    const double mean = sum / count;
    for (const double sample : samples) around += (sample - mean) * (sample - mean);
    const boost::math::students_t student(count - 1);
    return {mean, boost::math::quantile(student, 0.975) * std::sqrt(around / (count - 1) / count)};
}

} // namespace shadowbench::metrics
