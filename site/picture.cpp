#include "base/files.h"
#include "harness/cells/cell_images.h"
#include "harness/cells/kept_images.h"
#include "site/made_file.h"
#include "site/names.h"
#include "site/pages.h"

#include <fmt/format.h>

namespace shadowbench::site {

std::string picture(const std::filesystem::path& images, const Record& record, const std::string& name,
                    const SiteWriter& site) {
    if (images.empty() || !isFolderName(record.scene) || !isFolderName(fileName(record.variant))) return "";
    const std::filesystem::path source = cellFolder(images, record.scene, record.variant) / (name + ".png");
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(source, ignored)) return "";
    const std::string address = fmt::format("pictures/{}-{}-{}.png", slug(record.scene), slug(record.variant), name);
    writeMade(site.folder() / address, readFile(source));
    return address;
}

} // namespace shadowbench::site
