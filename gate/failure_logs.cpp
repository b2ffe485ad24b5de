#include "gate/failure_logs.h"

#include "harness/cells/renderer_log.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {

std::optional<FailureLog> failureLog(const std::string& what, const std::filesystem::path& file) {
    std::vector<std::string> lines = lastLines(file);
    if (lines.empty()) return std::nullopt;
    return FailureLog{what, file, std::move(lines)};
}

std::vector<FailureLog> failureLogs(const std::vector<Record>& records, const std::filesystem::path& logs) {
    std::vector<FailureLog> found;
    std::vector<int> more; // that said the same
    for (const Record& record : records) {
        if (record.status != Status::Error || !isExternal(record)) continue;
        const std::string what = fmt::format("{} on {}", record.variant, record.scene);
        auto log = failureLog(what, rendererLog(logs, record.scene, record.variant));
        if (!log) continue;
        const auto same = std::ranges::find(found, log->lines, &FailureLog::lines);
        if (same != found.end()) {
            ++more[static_cast<std::size_t>(same - found.begin())];
            continue;
        }
        found.push_back(std::move(*log));
        more.push_back(0);
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        if (more[i] > 0) found[i].what += fmt::format(" and {} more that said the same", more[i]);
    return found;
}

} // namespace shadowbench::gate
