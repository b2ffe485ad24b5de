#include "techniques/folder/built_in.h"

#include "base/error.h"
#include "embedded_technique_rows.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {

TechniqueFolder builtInFolder(const std::string& place) {
    const auto rows = embedded::technique_rows();
    const auto row = std::ranges::find(rows, place + "/technique.toml", &embedded::File::path);
    if (row == rows.end())
        throw InternalError(fmt::format("the catalogue names techniques/{}, which has no technique.toml", place));
    TechniqueFolder folder = parseTechniqueFolder(std::string(row->text), place, gl::embeddedShaders(place));
    folder.entry.id.erase(0, folderPrefix.size());
    folder.entry.digest.clear(); // the program's own hash holds its files
    return folder;
}

} // namespace shadowbench::techniques
