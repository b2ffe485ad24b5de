#include "harness/cells/lod_images.h"

#include "base/image_io.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace shadowbench::lod {
namespace {

using metrics::ColourImage;

constexpr int cropsShown = 8, margin = 3, enlargedTo = 150; // crops, pixels, pixels

/// The pixels of an image that see one instance.
struct Seen {
    glm::ivec2 low{1 << 20}, high{-1};
    [[nodiscard]] int side() const { return std::max(high.x - low.x, high.y - low.y) + 1; }
    [[nodiscard]] glm::ivec2 centre() const { return (low + high) / 2; }
};

unsigned mostSeen(const std::vector<Image<unsigned>>& masks) {
    std::map<unsigned, std::size_t> pixels;
    for (const Image<unsigned>& mask : masks)
        for (const unsigned id : mask)
            if (id != 0) ++pixels[id];
    const auto most = std::ranges::max_element(pixels, {}, [](const auto& entry) { return entry.second; });
    return most == pixels.end() ? 0 : most->first;
}

/// By frame; only frames that see it.
std::map<int, Seen> whereSeen(const std::vector<Image<unsigned>>& masks, unsigned id) {
    std::map<int, Seen> result;
    for (std::size_t frame = 0; frame < masks.size(); ++frame)
        for (int y = 0; y < masks[frame].height(); ++y)
            for (int x = 0; x < masks[frame].width(); ++x) {
                if (masks[frame](x, y) != id) continue;
                Seen& seen = result[static_cast<int>(frame)];
                seen.low = glm::min(seen.low, glm::ivec2(x, y));
                seen.high = glm::max(seen.high, glm::ivec2(x, y));
            }
    return result;
}

void writePicture(const std::filesystem::path& file, const ColourImage& picture) {
    Image<glm::vec3> colours(picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.size(); ++i) colours[i] = glm::vec3(picture[i]) / 255.0F;
    writePng(file, colours);
}

} // namespace

std::vector<Crop> transitionCrops(const std::vector<Image<unsigned>>& masks) {
    const unsigned id = mostSeen(masks);
    if (id == 0) return {};
    const std::map<int, Seen> seen = whereSeen(masks, id);
    const glm::ivec2 size(masks.front().width(), masks.front().height());
    int side = 0;
    for (const auto& [frame, where] : seen) side = std::max(side, where.side() + 2 * margin);
    side = std::min({side, size.x, size.y});

    const int count = std::min(cropsShown, static_cast<int>(seen.size()));
    std::vector<Crop> crops;
    for (int i = 0; i < count; ++i) {
        const auto step = (2 * i + 1) * static_cast<int>(seen.size()) / (2 * count);
        const auto& [frame, where] = *std::next(seen.begin(), step);
        crops.push_back({frame, glm::clamp(where.centre() - side / 2, glm::ivec2(0), size - side), side});
    }
    return crops;
}

ColourImage strip(const std::vector<Crop>& crops, const std::map<int, ColourImage>& pictures) {
    const int side = crops.front().side, scale = std::max(1, enlargedTo / side), cell = side * scale + 2;
    ColourImage result(cell * static_cast<int>(crops.size()) - 2, side * scale, glm::u8vec3(255));
    for (std::size_t i = 0; i < crops.size(); ++i) {
        const ColourImage& picture = pictures.at(crops[i].frame);
        for (int y = 0; y < side * scale; ++y)
            for (int x = 0; x < side * scale; ++x)
                result(static_cast<int>(i) * cell + x, y) =
                    picture(crops[i].corner.x + x / scale, crops[i].corner.y + y / scale);
    }
    return result;
}

LodImages::LodImages(const LodReference& reference)
    : busiest_(static_cast<int>(reference.busiest)), crops_(transitionCrops(reference.masks)) {}

void LodImages::keep(int frame, const ColourImage& picture) {
    const bool shown = std::ranges::any_of(crops_, [&](const Crop& crop) { return crop.frame == frame; });
    if (shown || frame == busiest_) kept_.insert_or_assign(frame, picture);
}

void LodImages::write(const std::filesystem::path& folder) const {
    writePicture(folder / "frame.png", kept_.at(busiest_));
    if (!crops_.empty()) writePicture(folder / "transition.png", strip(crops_, kept_));
}

} // namespace shadowbench::lod
