#include "harness/cells/lod_reference.h"

#include "base/hash.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::lod {
namespace {

std::string contentOf(const std::vector<metrics::ColourImage>& pictures) {
    Hasher128 hash;
    for (const metrics::ColourImage& picture : pictures) hash.add(picture.data(), picture.size() * sizeof(glm::u8vec3));
    return hash.digest().text();
}

} // namespace

LodReference drawReference(LodStage& stage, int frames, const Progress& progress) {
    const techniques::Variant full = techniques::parseVariant("lod-full");
    const auto technique = full.entry->makeLod(full.parameters);
    LodReference reference;
    for (int frame = 0; frame < frames; ++frame) {
        progress(static_cast<double>(frame) / frames, fmt::format("reference of frame {} of {}", frame + 1, frames));
        stage.show(frame);
        gl::WorkMeter meter;
        stage.render(*technique);
        reference.work.push_back(meter.finish());
        reference.pictures.push_back(stage.picture());
        reference.masks.push_back(stage.transitionMask());
        const metrics::ColourImage& picture = reference.pictures.back();
        const Image<unsigned>& mask = reference.masks.back();
        reference.change.push_back(
            frame == 0 ? 0 : metrics::meanChange(picture, reference.pictures[reference.change.size() - 1]));
        reference.speckle += metrics::speckle(picture, mask);
        reference.maskPixels += static_cast<std::size_t>(std::ranges::count_if(mask, [](unsigned id) { return id != 0; }));
        reference.transitions.push_back(stage.shown().inTransition());
    }
    reference.content = contentOf(reference.pictures);
    reference.busiest =
        static_cast<std::size_t>(std::ranges::max_element(reference.transitions) - reference.transitions.begin());
    return reference;
}

} // namespace shadowbench::lod
