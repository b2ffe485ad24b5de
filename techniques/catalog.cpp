#include "techniques/catalog.h"

#include "base/error.h"
#include "techniques/folder/folder_technique.h"
#include "techniques/gl/platform.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <sstream>

namespace shadowbench::techniques {

#define TECHNIQUE(name) Entry name();
#include "techniques/catalog.inc"
#undef TECHNIQUE

namespace {

constexpr const char* folderVariable = "SHADOWBENCH_TECHNIQUE_FOLDERS"; // as PATH

std::vector<std::string> chosenFolders() {
    const char* list = std::getenv(folderVariable);
    std::istringstream all(list == nullptr ? "" : list);
    std::vector<std::string> folders;
    for (std::string folder; std::getline(all, folder, ':');)
        if (!folder.empty()) folders.push_back(folder);
    return folders;
}

std::vector<Entry> allEntries() {
    std::vector<Entry> entries{
#define TECHNIQUE(name) name(),
#include "techniques/catalog.inc"
#undef TECHNIQUE
    };
    for (const std::string& folder : chosenFolders()) {
        Entry entry = folderEntry(readTechniqueFolder(folder));
        if (std::ranges::find(entries, entry.id, &Entry::id) != entries.end())
            throw BadInput(fmt::format("two technique folders have the id \"{}\"", entry.id.substr(folderPrefix.size())));
        entries.push_back(std::move(entry));
    }
    return entries;
}

} // namespace

std::span<const Entry> catalog() {
    static const std::vector<Entry> entries = allEntries();
    return entries;
}

void addTechniqueFolder(const std::filesystem::path& folder) {
    std::string all;
    for (const std::string& chosen : chosenFolders()) all += chosen + ":";
    all += std::filesystem::absolute(folder).lexically_normal().string();
    setenv(folderVariable, all.c_str(), 1);
}

std::vector<std::string> inheritedVariables() {
    std::vector<std::string> names = gl::platformVariables();
    names.emplace_back(folderVariable);
    return names;
}

} // namespace shadowbench::techniques
