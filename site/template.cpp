#include "site/template.h"

#include "base/error.h"
#include "embedded_site_files.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {

std::string_view embeddedFile(std::string_view path) {
    const auto files = embedded::site_files();
    const auto found = std::ranges::find(files, path, &embedded::File::path);
    if (found == files.end()) throw InternalError(fmt::format("making pages: the program has no file \"{}\"", path));
    return found->text;
}

std::string render(std::string_view name, const Data& data) {
    kainjow::mustache::mustache page{std::string(embeddedFile(fmt::format("templates/{}", name)))};
    const std::string text = page.render(data);
    if (!page.is_valid()) throw InternalError(fmt::format("making pages: template {}: {}", name, page.error_message()));
    return text;
}

} // namespace shadowbench::site
