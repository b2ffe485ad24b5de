// What renderers that are not ours said when they failed: `run` keeps it in `logs` beside the records.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench {

/// <logs>/<scene>/<variant>.txt
std::filesystem::path rendererLog(const std::filesystem::path& logs, const std::string& scene, const std::string& variant);

/// The last lines of a log, as many as a person reads at once, without control characters; none where there is no such file.
std::vector<std::string> lastLines(const std::filesystem::path& log);

} // namespace shadowbench
