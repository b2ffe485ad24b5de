#include "gate/check/scattered_errors.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::gate {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;
using Share = ErrorPlaces::Share;

constexpr float visible = 0.02F;    // more than dithering and 8 bits explain
constexpr float edgeWidth = 2;      // pixels to each side of an edge that a filter may reach
constexpr double enoughErrors = 64; // of all scenes

void add(bool isWrong, Share& share) {
    share.all += 1;
    share.wrong += isWrong ? 1 : 0;
}

/// Whether as many are wrong as a rate explains: by chance, or by a factor of 1.5, as where noise is clamped.
bool isAsOften(const Share& share, double rate) {
    const double expected = rate * share.all;
    return std::abs(share.wrong - expected) <= 4 * std::sqrt(expected) + expected / 2;
}

bool lieAtRandomOn(const ErrorPlaces& places) {
    const double rate = (places.lit.wrong + places.dark.wrong) / (places.lit.all + places.dark.all);
    return places.lit.wrong > 0 && places.dark.wrong > 0 && isAsOften(places.nearEdges, rate) &&
           isAsOften(places.lit, rate) && isAsOften(places.dark, rate) && isAsOften(places.pairs, rate * rate);
}

} // namespace

void addErrors(const Image<float>& v, const Reference& truth, ErrorPlaces& places) {
    const auto isScored = [&](int x, int y) { return truth.surface(x, y) == Surface::Receiver; };
    const auto isFar = [&](int x, int y) { return isScored(x, y) && truth.edgeDistance(x, y) > edgeWidth; };
    const auto isWrong = [&](int x, int y) { return std::abs(v(x, y) - truth.visibility(x, y)) > visible; };
    for (int y = 0; y < v.height(); ++y)
        for (int x = 0; x < v.width(); ++x) {
            if (!isScored(x, y)) continue;
            if (!isFar(x, y)) {
                add(isWrong(x, y), places.nearEdges);
                continue;
            }
            add(isWrong(x, y), truth.visibility(x, y) < 0.5F ? places.dark : places.lit);
            if (x + 1 < v.width() && isFar(x + 1, y)) add(isWrong(x, y) && isWrong(x + 1, y), places.pairs);
            if (y + 1 < v.height() && isFar(x, y + 1)) add(isWrong(x, y) && isWrong(x, y + 1), places.pairs);
        }
}

bool lieAtRandom(const std::vector<ErrorPlaces>& scenes) {
    double errors = 0;
    for (const ErrorPlaces& places : scenes) errors += places.lit.wrong + places.dark.wrong;
    return errors >= enoughErrors && std::ranges::all_of(scenes, lieAtRandomOn);
}

} // namespace shadowbench::gate
