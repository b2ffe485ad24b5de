// The technique folders of the catalogue, as they lie in the tree.
#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

namespace shadowbench {

inline std::vector<std::filesystem::path> builtInFolders() {
    namespace fs = std::filesystem;
    std::vector<fs::path> folders;
    for (const fs::directory_entry& family : fs::directory_iterator(fs::path(SOURCE_FOLDER) / "techniques"))
        if (family.is_directory())
            for (const fs::directory_entry& folder : fs::directory_iterator(family))
                if (fs::exists(folder.path() / "technique.toml")) folders.push_back(folder.path());
    std::ranges::sort(folders);
    return folders;
}

} // namespace shadowbench
