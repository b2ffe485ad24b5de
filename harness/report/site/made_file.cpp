#include "harness/report/site/made_file.h"

#include "base/error.h"

#include <fmt/format.h>
#include <fstream>

namespace shadowbench::site {

void writeMade(const std::filesystem::path& file, std::string_view content) {
    std::error_code failed;
    std::filesystem::create_directories(file.parent_path(), failed);
    std::filesystem::path temporary = file;
    temporary += ".new";
    std::ofstream out(temporary, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (out) std::filesystem::rename(temporary, file, failed);
    if (out && !failed) return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw InternalError(
        fmt::format("writing {}: it cannot be written; is the disk full, or the folder not yours?", file.string()));
}

} // namespace shadowbench::site
