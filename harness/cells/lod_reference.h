// What all level-of-detail techniques on one scene are compared with: its walk at the finest levels, drawn once.
#pragma once

#include "base/progress.h"
#include "harness/render/lod_stage.h"
#include "techniques/gl/counters.h"

#include <string>
#include <vector>

namespace shadowbench::lod {

struct LodReference {
    std::vector<metrics::ColourImage> pictures; // by frame
    std::vector<gl::WorkCount> work;            // by frame
    std::vector<Image<unsigned>> masks;         // LodStage::transitionMask by frame
    std::vector<double> change;                 // metrics::meanChange from the frame before; 0 in frame 0
    double speckle = 0;                         // metrics::speckle over all masks
    std::size_t maskPixels = 0;                 // in all masks
    std::vector<std::size_t> transitions;       // instances in transition by frame
    std::size_t busiest = 0;                    // the frame with most of them
    std::string content;                        // hash of all pictures
};

/// Draws the whole walk of the stage's scene.
LodReference drawReference(LodStage& stage, int frames, const Progress& progress);

} // namespace shadowbench::lod
