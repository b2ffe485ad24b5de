#include "harness/report/site/names.h"

#include <fmt/format.h>

namespace shadowbench::site {
namespace {

constexpr std::size_t longestShown = 160;

} // namespace

std::string sceneAddress(const std::string& scene) { return fmt::format("scenes/{}.html", slug(scene)); }

std::string cellAddress(const Record& record) {
    return fmt::format("cells/{}.html#{}", slug(record.scene), slug(record.variant));
}

std::string shown(const std::string& name) {
    if (name.size() <= longestShown) return name;
    std::size_t end = longestShown;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end; // a character stays whole
    return fmt::format("{}… ({} bytes)", name.substr(0, end), name.size());
}

} // namespace shadowbench::site
