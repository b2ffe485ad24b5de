#include "techniques/folder/vocabulary.h"

#include "techniques/folder/inputs.h"

#include <algorithm>
#include <cctype>

namespace shadowbench::techniques {

std::vector<std::string> uniformNames(const TechniqueFolder& folder) {
    std::vector<std::string> names;
    for (const FolderInput& input : folderInputs()) names.emplace_back(input.name);
    for (const FolderPattern& pattern : folder.patterns) names.push_back(pattern.name);
    for (const FolderTarget& target : folder.targets) {
        names.push_back(target.name);
        if (target.history) names.push_back(std::string(historyPrefix) + target.name);
    }
    return names;
}

std::set<std::string> namesIn(std::string_view glsl) {
    const auto isOfName = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    std::set<std::string> names;
    while (!glsl.empty()) {
        std::size_t length = 1;
        if (glsl.starts_with("//"))
            length = std::min(glsl.find('\n'), glsl.size());
        else if (glsl.starts_with("/*"))
            length = std::min(glsl.find("*/", 2), glsl.size() - 2) + 2;
        else if (isOfName(glsl.front())) {
            length = static_cast<std::size_t>(std::ranges::find_if_not(glsl, isOfName) - glsl.begin());
            if (std::isdigit(static_cast<unsigned char>(glsl.front())) == 0) names.emplace(glsl.substr(0, length));
        }
        glsl.remove_prefix(length);
    }
    return names;
}

} // namespace shadowbench::techniques
