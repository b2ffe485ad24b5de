#include "harness/cells/cell_images.h"

#include "base/image_io.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {

Image<glm::vec3> errorPicture(const Image<float>& v, const groundtruth::Reference& truth) {
    Image<glm::vec3> picture(v.width(), v.height(), glm::vec3(0.08F));
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (truth.surface[i] != groundtruth::Surface::Receiver) continue;
        const float grey = 0.25F + 0.5F * truth.visibility[i];
        const float error = v[i] - truth.visibility[i];
        const float strength = std::min(1.0F, std::abs(error) * 2); // half of full light is already full colour
        const glm::vec3 colour = error < 0 ? glm::vec3(0.9F, 0.1F, 0.1F) : glm::vec3(0.1F, 0.3F, 1.0F);
        picture[i] = (1 - strength) * glm::vec3(grey) + strength * colour;
    }
    return picture;
}

void writeCellImages(const std::filesystem::path& folder, const CellImages& images, const PictureShading& shading) {
    const Image<float>& v = images.visibility();
    const groundtruth::Reference& truth = *images.reference;
    Image<float> error(v.width(), v.height());
    for (std::size_t i = 0; i < v.size(); ++i)
        if (truth.surface[i] == groundtruth::Surface::Receiver) error[i] = v[i] - truth.visibility[i];
    writeExr(folder / "visibility.exr", {{"V", &v}});
    writeExr(folder / "reference.exr", {{"V", &truth.visibility}});
    writeExr(folder / "error.exr", {{"error", &error}});
    for (const auto& [frame, visibility] : images.frames)
        if (images.frames.size() > 1) writeExr(folder / fmt::format("frame-{}.exr", frame), {{"V", &visibility}});
    writePng(folder / "visibility.png", v);
    writePng(folder / "reference.png", truth.visibility);
    writePng(folder / "error.png", errorPicture(v, truth));
    writePng(folder / "visibility-shaded.png", shadedPicture(shading, v));
    writePng(folder / "reference-shaded.png", shadedPicture(shading, truth.visibility));
}

std::string fileName(const std::string& variant) {
    std::string name = variant;
    std::replace(name.begin(), name.end(), ':', '_');
    return name;
}

} // namespace shadowbench
