#include "base/error.h"
#include "embedded_builtin_scenes.h"
#include "scene/load/load.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench {
namespace {

/// Hard shadows before soft ones before level of detail.
constexpr std::array<std::string_view, 5> kStandardScenes{"dueling-frusta", "overlapping-occluders", "simple", "windmills",
                                                          "trees"};

std::size_t rank(std::string_view id) {
    return static_cast<std::size_t>(std::find(kStandardScenes.begin(), kStandardScenes.end(), id) - kStandardScenes.begin());
}

std::string_view stem(std::string_view path) { return path.substr(0, path.rfind('.')); }

} // namespace

std::vector<std::string> standardScenes() { return {kStandardScenes.begin(), kStandardScenes.end()}; }

std::vector<std::string> builtinScenes() {
    std::vector<std::string> ids;
    for (const embedded::File& file : embedded::builtin_scenes()) ids.emplace_back(stem(file.path));
    std::sort(ids.begin(), ids.end(), [](const std::string& a, const std::string& b) {
        return std::pair(rank(a), std::string_view(a)) < std::pair(rank(b), std::string_view(b));
    });
    return ids;
}

std::string_view builtinSceneText(const std::string& id) {
    for (const embedded::File& file : embedded::builtin_scenes())
        if (stem(file.path) == id) return file.text;
    throw BadInput(fmt::format("there is no built-in scene \"{}\"", id));
}

} // namespace shadowbench
