#include "site/made_file.h"

#include "base/files.h"

namespace shadowbench::site {

void writeMade(const std::filesystem::path& file, std::string_view content) { writeFileUnflushed(file, content); }

} // namespace shadowbench::site
