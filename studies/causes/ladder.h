// One row's error, taken apart pixel by pixel: each experiment takes from it what is gone without its cause.
#pragma once

#include "base/image.h"
#include "studies/causes/cause.h"

#include <functional>
#include <map>

namespace shadowbench::causes {

/// The error of each pixel by cause. At every pixel the causes add up to the row's error.
using Split = std::map<Cause, Image<float>>;

class Ladder {
public:
    /// `error` ≥ 0: of the row as it is; 0 beside the receivers.
    explicit Ladder(Image<float> error);

    using CauseAt = std::function<Cause(std::size_t pixel)>;

    /// An experiment turns errors `before` into errors `after`. Of each pixel it takes what `after` has less than what is
    /// not explained yet, times the share of the fall around the pixel that is more than a reshuffle: an image that is wrong
    /// elsewhere as often as it is right here has not lost a cause. `causes` are those that the experiment can remove;
    /// `causeAt` tells which of them it was.
    void take(std::initializer_list<Cause> causes, const CauseAt& causeAt, const Image<float>& before,
              const Image<float>& after);
    void take(Cause cause, const Image<float>& before, const Image<float>& after);

    /// What is not explained is the method's.
    [[nodiscard]] Split finish() &&;

private:
    Image<float> left_; // not explained yet
    Split split_;
};

/// Of the fall from `before` to `after` in the window around each pixel, the share that is more than chance: as much falls
/// by chance as rises, give or take the root of the sum of squares of the rises. 0 where nothing falls, 1 where nothing
/// rises. The window is an eighth of the image, at least 17 pixels, a side.
Image<float> netShare(const Image<float>& before, const Image<float>& after);

} // namespace shadowbench::causes
