#include "studies/causes/ladder.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::causes {
namespace {

/// Sums over all rectangles from the corner of an image: exact for labels, and as good as doubles for others.
class SummedAreas {
public:
    explicit SummedAreas(const Image<float>& image) : sums_(image.width() + 1, image.height() + 1) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                sums_(x + 1, y + 1) = image(x, y) + sums_(x, y + 1) + sums_(x + 1, y) - sums_(x, y);
    }

    /// Over the square around a pixel, as far as it lies in the image.
    [[nodiscard]] double around(int x, int y, int radius) const {
        const int left = std::max(x - radius, 0), right = std::min(x + radius + 1, sums_.width() - 1);
        const int top = std::max(y - radius, 0), bottom = std::min(y + radius + 1, sums_.height() - 1);
        return sums_(right, bottom) - sums_(left, bottom) - sums_(right, top) + sums_(left, top);
    }

private:
    Image<double> sums_;
};

Image<float> falls(const Image<float>& from, const Image<float>& to) {
    Image<float> result(from.width(), from.height());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::max(0.0F, from[i] - to[i]);
    return result;
}

Image<float> squares(Image<float> image) {
    for (float& value : image) value *= value;
    return image;
}

} // namespace

Image<float> netShare(const Image<float>& before, const Image<float>& after) {
    constexpr int least = 8; // enough pixels that a reshuffle's falls and rises are about as many
    const int radius = std::max(least, std::max(before.width(), before.height()) / 16);
    const Image<float> rises = falls(after, before);
    const SummedAreas fallen(falls(before, after)), risen(rises), noise(squares(rises));
    Image<float> share(before.width(), before.height());
    for (int y = 0; y < share.height(); ++y)
        for (int x = 0; x < share.width(); ++x) {
            const double fall = fallen.around(x, y, radius);
            const double chance = risen.around(x, y, radius) + std::sqrt(noise.around(x, y, radius));
            if (fall > 0) share(x, y) = static_cast<float>(std::max(0.0, 1 - chance / fall));
        }
    return share;
}

Ladder::Ladder(Image<float> error) : left_(std::move(error)) {}

void Ladder::take(std::initializer_list<Cause> causes, const CauseAt& causeAt, const Image<float>& before,
                  const Image<float>& after) {
    for (const Cause cause : causes) split_.try_emplace(cause, left_.width(), left_.height());
    const Image<float> share = netShare(before, after);
    for (std::size_t i = 0; i < left_.size(); ++i) {
        const float taken = share[i] * std::max(0.0F, left_[i] - after[i]);
        if (taken == 0) continue;
        split_.at(causeAt(i))[i] += taken;
        left_[i] -= taken;
    }
}

void Ladder::take(Cause cause, const Image<float>& before, const Image<float>& after) {
    take(
        {cause}, [cause](std::size_t) { return cause; }, before, after);
}

Split Ladder::finish() && {
    split_.insert_or_assign(Cause::Method, std::move(left_));
    return std::move(split_);
}

} // namespace shadowbench::causes
