#include "harness/scene/temporary_folder.h"

#include "harness/scene/error.h"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <system_error>

namespace shadowbench {

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (error) throw Inconclusive("cannot make a temporary folder: $TMPDIR is not a folder; set it to one that exists");
    std::string name = (parent / "shadowbench-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw Inconclusive(fmt::format("cannot make a temporary folder in {}: {}; free some space or set TMPDIR",
                                       parent.string(), std::generic_category().message(errno)));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace shadowbench
