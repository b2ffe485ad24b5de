// Golden references: hashes of a reference's images, which do not depend on file or key, and how two references differ.
#pragma once

#include "groundtruth/contract/reference.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace shadowbench::groundtruth {

/// XXH3-128 of each image's size and values, 32 hex digits. Positions are left out: ids and the scene determine them.
struct ContentHashes {
    std::string visibility, sigma, surface, id, edgeDistance;
    friend bool operator==(const ContentHashes&, const ContentHashes&) = default;
};
ContentHashes contentHashes(const Reference& reference);

/// One hash, 32 hex digits, of those images that scores are computed from: visibility, surface, ids and edge distance. σ, an
/// estimate that no score depends on, is left out.
std::string contentOf(const ContentHashes& hashes);

/// How the images of two references differ. Pixels count where the values are not equal.
struct Difference {
    bool size = false;      // of the images; nothing else is compared then
    std::size_t labels = 0; // pixels that changed between fully lit, fully shadowed and in between, or their Surface
    std::size_t ids = 0;
    struct Values {
        std::size_t pixels = 0;
        double largest = 0; // change; of pixels that are finite in both
        friend bool operator==(const Values&, const Values&) = default;
    };
    Values visibility, sigma, edgeDistance; // edgeDistance in pixels
    friend bool operator==(const Difference&, const Difference&) = default;
};
Difference difference(const Reference& before, const Reference& after);

/// "12 labels, visibility of 40 pixels by up to 0.25, edge distance of 3 pixels by up to 0.5 px"; "" where nothing differs.
std::string describe(const Difference& difference);

/// "oracle polygon → rays, exact 2 → 3, primary_mismatch 0 → 1e-05": everything but key and seconds; "" where nothing
/// differs.
std::string describeChange(const Provenance& before, const Provenance& after);

/// Writes the hashed images as one EXR: float channels V, sigma, edge_distance, surface (the number of the Surface) and id.
/// Throws InternalError when the file cannot be written or an id is above 2²⁴, which a float does not hold.
void writeGolden(const Reference& reference, const std::filesystem::path& file);

/// The inverse; no positions, no provenance. Throws BadInput when the file cannot be read or does not hold such images.
Reference readGolden(const std::filesystem::path& file);

} // namespace shadowbench::groundtruth
