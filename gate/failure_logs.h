// What programs that are not ours said before they failed.
#pragma once

#include "gate/gate.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// Of one of them, whose failure is called `what`; nothing where it said nothing.
std::optional<FailureLog> failureLog(const std::string& what, const std::filesystem::path& file);

/// Of the records that ended in an error, those with the same last lines once; `logs` as `run` leaves them
/// (harness/cells/renderer_log.h).
std::vector<FailureLog> failureLogs(const std::vector<Record>& records, const std::filesystem::path& logs);

} // namespace shadowbench::gate
