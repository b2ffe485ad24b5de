// Every variant on every scene, in one table.
#pragma once

#include "harness/records/record.h"
#include "site/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::site {

/// A row a variant, a column a scene; coloured by how far each error is beyond the scene's tolerance.
Table matrixTable(const std::vector<Record>& records, const std::filesystem::path& images, const std::string& caption);

} // namespace shadowbench::site
