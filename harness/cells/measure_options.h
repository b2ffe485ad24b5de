// What a caller chooses about the measuring of a cell, of either kind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace shadowbench {

class ExternalTechniques;

struct MeasureOptions {
    std::uint32_t seed = 1;
    int seeds = 1;                // from it on; with two or more the error of what depends on the seed is split
    int views = 1;                // still views of the scene: its own, and others by a rule (changed_scene.h)
    bool neighbours = false;      // each row again with its map, and with the image, a fortieth larger
    bool time = true;             // wall time
    std::filesystem::path images; // folder of what is kept for pages (harness/cells/kept_images.h); empty: nothing is
    bool pictures = false;        // for people, too: visibility, reference and error as EXR and PNG
    bool otherScreen = false;     // costs by pass on an image of another size, too
    std::shared_ptr<const ExternalTechniques> external{}; // that may be among the techniques; null: none

    /// Whether clocks decide a figure.
    [[nodiscard]] bool timed() const { return time || otherScreen; }
};

} // namespace shadowbench
