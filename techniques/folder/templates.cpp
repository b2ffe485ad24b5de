#include "techniques/folder/templates.h"

#include "base/error.h"
#include "base/files.h"
#include "base/words.h"
#include "embedded_technique_templates.h"
#include "techniques/folder/description.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace shadowbench::techniques {
namespace {

namespace fs = std::filesystem;

/// Its id in technique.toml, and its rows in expect.toml.
std::string withId(std::string text, const std::string& like, const std::string& id) {
    for (const auto& [quoted, other] : {std::pair(fmt::format("id = \"{}\"", like), fmt::format("id = \"{}\"", id)),
                                        std::pair(fmt::format("\"my:{}\"", like), fmt::format("\"my:{}\"", id)),
                                        std::pair(fmt::format("\"my:{}:", like), fmt::format("\"my:{}:", id))})
        for (std::size_t at = text.find(quoted); at != std::string::npos; at = text.find(quoted, at + other.size()))
            text.replace(at, quoted.size(), other);
    return text;
}

} // namespace

std::vector<std::string> folderTemplates() {
    std::vector<std::string> names;
    for (const embedded::File& file : embedded::technique_templates()) {
        std::string name(file.path.substr(0, file.path.find('/')));
        if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
    return names;
}

std::vector<fs::path> writeFromTemplate(const std::string& like, const std::string& id, const fs::path& folder) {
    const std::vector<std::string> known = folderTemplates();
    if (std::ranges::find(known, like) == known.end()) throwUnknownWord("template", like, known);
    if (!isFolderId(id)) throw BadInput(fmt::format("\"{}\" is no id: lower-case letters, digits and -, 40 at most", id));
    // Made here, so that of two that start at the same time one is refused.
    std::error_code failed;
    if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), failed);
    if (!failed && !fs::create_directory(folder, failed) && !failed)
        throw BadInput(fmt::format("there is something at {} already; name another place with --folder", folder.string()));
    if (failed)
        throw BadInput(fmt::format("cannot make the folder {}: {}; name another place with --folder", folder.string(),
                                   failed.message()));
    std::vector<fs::path> written;
    for (const embedded::File& file : embedded::technique_templates()) {
        if (!file.path.starts_with(like + "/")) continue;
        const fs::path name = file.path.substr(like.size() + 1);
        const std::string text(file.text);
        writeFile(folder / name, name.extension() == ".toml" ? withId(text, like, id) : text);
        written.push_back(folder / name);
    }
    return written;
}

} // namespace shadowbench::techniques
