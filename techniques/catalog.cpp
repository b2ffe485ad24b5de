#include "techniques/catalog.h"

#include "base/error.h"
#include "techniques/folder/built_in.h"
#include "techniques/folder/folder_technique.h"
#include "techniques/folder/pass_program.h"
#include "techniques/folder/unused.h"
#include "techniques/folder_passes.h"
#include "techniques/gl/platform.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <sstream>

namespace shadowbench::techniques {

#define TECHNIQUE(name) Entry name();
#define FOLDER(place)
#include "techniques/catalog.inc"
#undef FOLDER
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

struct Catalogue {
    std::map<std::string, std::map<std::string, std::string>, std::less<>> passes; // of folders, by their rows
    std::vector<Entry> entries{
#define TECHNIQUE(name) name(),
#define FOLDER(place) entryOf(builtInFolder(place)),
#include "techniques/catalog.inc"
#undef FOLDER
#undef TECHNIQUE
    };

    Catalogue() {
        for (const std::string& place : chosenFolders()) {
            TechniqueFolder folder = readTechniqueFolder(place);
            const std::string id = folder.entry.id;
            if (std::ranges::find(entries, id, &Entry::id) != entries.end())
                throw BadInput(fmt::format("two technique folders have the id \"{}\"", id.substr(folderPrefix.size())));
            entries.push_back(entryOf(std::move(folder)));
        }
    }

    Entry entryOf(TechniqueFolder folder) {
        passes.emplace(folder.entry.id, passHashes(folder));
        return folderEntry(std::move(folder));
    }
};

const Catalogue& catalogue() {
    static const Catalogue all;
    return all;
}

} // namespace

std::span<const Entry> catalog() { return catalogue().entries; }

const std::map<std::string, std::string>& drawnWith(std::string_view id) {
    static const std::map<std::string, std::string> none;
    const auto found = catalogue().passes.find(id);
    return found == catalogue().passes.end() ? none : found->second;
}

void addTechniqueFolder(const std::filesystem::path& folder) {
    std::string all;
    for (const std::string& chosen : chosenFolders()) all += chosen + ":";
    all += std::filesystem::absolute(folder).lexically_normal().string();
    setenv(folderVariable, all.c_str(), 1);
}

std::vector<std::string> unusedInFolders() {
    std::vector<std::string> lines;
    for (const std::string& place : chosenFolders())
        for (std::string& line : unusedIn(readTechniqueFolder(place))) lines.push_back(std::move(line));
    return lines;
}

std::vector<std::string> inheritedVariables() {
    std::vector<std::string> names = gl::platformVariables();
    names.emplace_back(folderVariable);
    return names;
}

} // namespace shadowbench::techniques
