#include "techniques/folder/built_in.h"

#include "base/error.h"
#include "embedded_technique_rows.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {

std::vector<std::string> builtInPlaces() {
    std::vector<std::string> places;
    for (const embedded::File& row : embedded::technique_rows())
        places.emplace_back(row.path.substr(0, row.path.rfind('/')));
    return places;
}

std::string builtInText(const std::string& place) {
    const auto rows = embedded::technique_rows();
    const auto row = std::ranges::find(rows, place + "/technique.toml", &embedded::File::path);
    if (row == rows.end())
        throw InternalError(fmt::format("the catalogue names techniques/{}, which has no technique.toml", place));
    return std::string(row->text);
}

TechniqueFolder builtInFolder(const std::string& place) {
    TechniqueFolder folder = parseTechniqueFolder(builtInText(place), place, gl::embeddedShaders(place));
    folder.entry.id.erase(0, folderPrefix.size());
    folder.entry.digest.clear(); // the program's own hash holds its files
    return folder;
}

} // namespace shadowbench::techniques
