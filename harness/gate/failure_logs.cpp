#include "harness/gate/failure_logs.h"

#include "harness/cells/renderer_log.h"

#include <fmt/format.h>

namespace shadowbench::gate {

std::optional<FailureLog> failureLog(const std::string& what, const std::filesystem::path& file) {
    std::vector<std::string> lines = lastLines(file);
    if (lines.empty()) return std::nullopt;
    return FailureLog{what, file, std::move(lines)};
}

std::vector<FailureLog> failureLogs(const std::vector<Record>& records, const std::filesystem::path& logs) {
    std::vector<FailureLog> found;
    for (const Record& record : records) {
        if (record.status != Status::Error || !isExternal(record)) continue;
        const std::string what = fmt::format("{} on {}", record.variant, record.scene);
        if (auto log = failureLog(what, rendererLog(logs, record.scene, record.variant))) found.push_back(std::move(*log));
    }
    return found;
}

} // namespace shadowbench::gate
