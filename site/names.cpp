#include "site/names.h"

#include <fmt/format.h>

namespace shadowbench::site {

std::string sceneAddress(const std::string& scene) { return fmt::format("scenes/{}.html", slug(scene)); }

std::string cellAddress(const Record& record) {
    return fmt::format("cells/{}.html#{}", slug(record.scene), slug(record.variant));
}

std::string truncate(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end; // a character stays whole
    return fmt::format("{}… ({} bytes)", text.substr(0, end), text.size());
}

} // namespace shadowbench::site
