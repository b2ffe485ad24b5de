// How far several oracles agree on one frame, pixel by pixel.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <cstddef>
#include <string>
#include <vector>

namespace shadowbench::groundtruth {

/// Two oracles on the receiver pixels that both can label.
struct Agreement {
    std::string a, b;                  // "polygon", "rays", …
    std::string pixelsCompared;        // which: "planar receivers", …
    std::size_t pixels = 0;            // compared
    std::size_t differing = 0;         // of them, with contradicting answers; those on an edge for either apart
    std::size_t onEdge = 0;            // of them, exactly on a shadow edge for both
    std::size_t onOneEdge = 0;         // for one of them only
    double secondsA = 0, secondsB = 0; // wall time each took on these pixels, preparing the scene apart
};

/// Every comparison of oracles that applies to the request's light and receivers; its own oracle does not matter. Empty
/// where none does. Throws what the oracles throw.
///
/// polygon and rays (point and directional lights): the labels on all planar receivers that enough pixels see
/// (hard::ExactScene::planarReceivers). plan and polygon (plan-view scenes): the labels on those that are horizontal.
std::vector<Agreement> oracleAgreement(const Request& request, const Progress& progress = {});

/// Throws Inconclusive, naming a pixel, where `compared` is not 0 and two exact oracles have contradicting labels: one of
/// them is wrong. Pixels that either finds on an edge do not count.
void requireSameLabels(const Reference& a, const Reference& b, const Image<std::uint8_t>& compared);

/// Counts `pixels`, `differing`, `onEdge` and `onOneEdge` where `compared` is not 0. Labels are exact: Receiver or OnEdge
/// and 0 or 1.
void countLabels(const Reference& a, const Reference& b, const Image<std::uint8_t>& compared, Agreement& agreement);

} // namespace shadowbench::groundtruth
