#include "gate/ci_config.h"

#include "base/error.h"
#include "base/files.h"
#include "base/toml_value.h"
#include "base/words.h"
#include "harness/records/record.h"
#include "scene/load/load.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

/// A file of the tree, from its root.
fs::path fileIn(const TomlValue& value, const fs::path& root) {
    const fs::path file = fs::path(value.text()).lexically_normal();
    if (file.empty() || file.is_absolute() || *file.begin() == "..")
        value.fail(fmt::format("\"{}\" is no file of the repository; name one from its root", file.string()));
    if (!fs::is_regular_file(root / file))
        value.fail(
            fmt::format("the commit has no file {}; name one from the repository's root, and commit it", file.string()));
    return file;
}

std::string sceneIn(const TomlValue& value, const fs::path& root) {
    std::string scene = value.text();
    const std::vector<std::string> known = builtinScenes();
    if (std::ranges::find(known, scene) != known.end()) return scene;
    if (!fs::path(scene).has_extension())
        value.fail(fmt::format("there is no scene \"{}\"{}; `shadowbench list scenes` names all, and a file of the "
                               "repository is one, too",
                               scene, didYouMean(scene, known)));
    return fileIn(value, root).string();
}

std::string patternIn(const TomlValue& value) {
    std::string pattern = value.text();
    if (!pattern.starts_with(externalPrefix))
        value.fail(
            fmt::format("\"{0}\" is no row of a renderer; they are called external:ID, as in \"external:{0}\"", pattern));
    return pattern;
}

template <class Read>
auto listIn(const TomlValue& list, Read read) {
    std::vector<decltype(read(list))> values;
    for (const TomlValue& value : list.list()) values.push_back(read(value));
    if (values.empty()) list.fail("is empty; name one, or leave the key out");
    return values;
}

} // namespace

std::vector<fs::path> CiConfig::files() const {
    std::vector<fs::path> all = renderers;
    all.push_back(file);
    for (const std::string& scene : scenes)
        if (fs::path(scene).has_extension()) all.emplace_back(scene);
    return all;
}

CiConfig readCiConfig(const fs::path& root, const fs::path& file) {
    if (!fs::is_regular_file(root / file))
        throw BadInput(fmt::format("the commit has no {}; write one (docs/ci.md) and commit it", file.string()));
    CiConfig config;
    config.file = file;
    const toml::table table = parseToml(readFile(root / file), file.string());
    const TomlSource source{.file = file.string()};
    const TomlValue whole(source, "", table);
    whole.only({"build", "renderers", "scenes", "profile", "technique", "bound", "waiver"});
    config.renderers = listIn(whole.get("renderers"), [&](const TomlValue& value) { return fileIn(value, root); });
    if (const auto build = whole.find("build")) config.build = build->text();
    if (const auto scenes = whole.find("scenes"))
        config.scenes = listIn(*scenes, [&](const TomlValue& value) { return sceneIn(value, root); });
    if (const auto profile = whole.find("profile")) config.profile = profileNamed(profile->oneOf(profileNames()));
    if (const auto patterns = whole.find("technique")) config.techniques = listIn(*patterns, patternIn);
    config.judged = readJudgements(whole);
    return config;
}

} // namespace shadowbench::gate
