// Pictures of a walk for people: the frame with most transitions, and one instance through its transition.
#pragma once

#include "harness/cells/lod_reference.h"

#include <filesystem>
#include <map>
#include <vector>

namespace shadowbench::lod {

/// Where the instance whose transition most pixels see is in some frames of that transition, evenly spaced in time; squares
/// of one size. Empty where no pixel sees one.
struct Crop {
    int frame;
    glm::ivec2 corner; // upper left, pixels
    int side;
};
std::vector<Crop> transitionCrops(const std::vector<Image<unsigned>>& masks);

/// The crops side by side, enlarged in whole steps to about 150 pixels each. `pictures` by frame holds every crop's.
metrics::ColourImage strip(const std::vector<Crop>& crops, const std::map<int, metrics::ColourImage>& pictures);

/// Collects the pictures that a cell leaves and writes frame.png and, if there is one, transition.png.
class LodImages {
public:
    explicit LodImages(const LodReference& reference);
    void keep(int frame, const metrics::ColourImage& picture);
    void write(const std::filesystem::path& folder) const;

private:
    int busiest_;
    std::vector<Crop> crops_;
    std::map<int, metrics::ColourImage> kept_;
};

} // namespace shadowbench::lod
