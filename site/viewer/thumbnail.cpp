#include "site/viewer/thumbnail.h"

#include "base/image_io.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/kept_images.h"
#include "site/names.h"
#include "site/viewer/cell_data.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

constexpr int thumbnailSide = 144;                                   // pixels: as wide as the first page shows it, and sharp
constexpr int cardWidth = 1200, cardHeight = 630, cardPicture = 384; // what hosts of links ask for
constexpr glm::vec3 cardGround(0.08F, 0.09F, 0.1F);

/// The middle square of a picture, each pixel the mean of those that it covers; never larger than it is.
Image<glm::vec3> square(const Image<glm::vec3>& from, int side) {
    const int all = std::min(from.width(), from.height()), made = std::min(side, all);
    const int x0 = (from.width() - all) / 2, y0 = (from.height() - all) / 2;
    Image<glm::vec3> result(made, made);
    for (int y = 0; y < made; ++y)
        for (int x = 0; x < made; ++x) {
            glm::vec3 sum(0);
            int count = 0;
            for (int v = y * all / made; v < (y + 1) * all / made; ++v)
                for (int u = x * all / made; u < (x + 1) * all / made; ++u, ++count) sum += from(x0 + u, y0 + v);
            result(x, y) = sum / static_cast<float>(count);
        }
    return result;
}

struct CellFiles {
    Image<float> v;
    KeptTruth truth;
};

CellFiles filesOf(const Record& record, const fs::path& images) {
    const std::string truth = truthOf(record, keptTruths(images, record.scene));
    return {readChannel(cellFolder(images, record.scene, record.variant) / "visibility.exr", "V"),
            readTruth(truthFile(images, record.scene, truth))};
}

/// The scene in mid-walk, of a technique of levels of detail.
Image<glm::vec3> frameOf(const fs::path& file) {
    const std::array channels{readChannel(file, 0), readChannel(file, 1), readChannel(file, 2)};
    Image<glm::vec3> picture(channels[0].width(), channels[0].height());
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = {channels[0][i], channels[1][i], channels[2][i]};
    return picture;
}

} // namespace

std::string thumbnail(const Record& record, const fs::path& images, const SiteWriter& site) {
    if (images.empty() || !isFolderName(record.scene) || !isFolderName(fileName(record.variant))) return "";
    const std::string address = fmt::format("pictures/thumbnail-{}.png", slug(record.technique));
    const fs::path frame = cellFolder(images, record.scene, record.variant) / "frame.png";
    std::error_code ignored;
    if (hasCell(record, images)) {
        const CellFiles cell = filesOf(record, images);
        if (!cell.v.sameSize(cell.truth.visibility)) return "";
        writePng(site.folder() / address, square(visibilityPicture(cell.v, cell.truth), thumbnailSide));
    } else if (isLevelOfDetail(record) && fs::is_regular_file(frame, ignored)) {
        writePng(site.folder() / address, square(frameOf(frame), thumbnailSide));
    } else {
        return "";
    }
    return address;
}

void writeCard(const Record& record, const fs::path& images, const SiteWriter& site) {
    const CellFiles cell = filesOf(record, images);
    if (!cell.v.sameSize(cell.truth.visibility)) return;
    const std::array pictures{visibilityPicture(cell.truth.visibility, cell.truth), visibilityPicture(cell.v, cell.truth),
                              differencePicture(cell.v, cell.truth)};
    Image<glm::vec3> card(cardWidth, cardHeight);
    for (std::size_t i = 0; i < card.size(); ++i) card[i] = cardGround;
    for (int i = 0; i < 3; ++i) {
        const Image<glm::vec3> picture = square(pictures[static_cast<std::size_t>(i)], cardPicture);
        const int left = (2 * i + 1) * cardWidth / 6 - picture.width() / 2, top = (cardHeight - picture.height()) / 2;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x) card(left + x, top + y) = picture(x, y);
    }
    writePng(site.folder() / "assets/card.png", card);
}

} // namespace shadowbench::site
