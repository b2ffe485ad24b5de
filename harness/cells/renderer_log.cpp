#include "harness/cells/renderer_log.h"

#include "base/files.h"
#include "base/one_line.h"
#include "harness/cells/kept_images.h"

#include <algorithm>
#include <sstream>

namespace shadowbench {

std::filesystem::path rendererLog(const std::filesystem::path& logs, const std::string& scene, const std::string& variant) {
    return cellFolder(logs, scene, variant) += ".txt";
}

std::vector<std::string> lastLines(const std::filesystem::path& log) {
    constexpr std::size_t most = 20;
    if (!std::filesystem::exists(log)) return {};
    std::vector<std::string> lines;
    std::istringstream text(readFile(log));
    for (std::string line; std::getline(text, line);) lines.push_back(std::move(line));
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(std::min(lines.size(), most)));
    for (std::string& line : lines) line = onOneLine(std::move(line));
    return lines;
}

} // namespace shadowbench
