#include "tools/mutants/sources.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>

namespace shadowbench::mutants {
namespace {

using Modules = std::map<std::string, std::vector<std::string>>; // folder → folders that it includes

Modules modulesOf(std::string_view layers) {
    Modules modules;
    std::istringstream text{std::string(layers)};
    for (std::string line; std::getline(text, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with('#') || colon == std::string::npos) continue;
        std::istringstream arrows(line.substr(colon + 1, line.find('|') - colon - 1));
        std::vector<std::string>& includes = modules[line.substr(0, colon)];
        for (std::string arrow; arrows >> arrow;) includes.push_back(arrow);
    }
    return modules;
}

bool isWithin(std::string_view path, std::string_view folder) {
    return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

/// The module that a file belongs to: the deepest folder; "" if it belongs to none.
std::string moduleOf(std::string_view file, const Modules& modules) {
    std::string deepest;
    for (const auto& [folder, includes] : modules)
        if (isWithin(file, folder) && folder.size() > deepest.size()) deepest = folder;
    return deepest;
}

void addWithIncludes(const std::string& module, const Modules& modules, const std::set<std::string>& without,
                     std::set<std::string>& all) {
    const auto found = modules.find(module);
    if (found == modules.end() || without.contains(module) || !all.insert(module).second) return;
    for (const std::string& included : found->second) addWithIncludes(included, modules, without, all);
}

/// The folder of a technique's variant.
std::string familyOf(const std::string& variant, const std::vector<std::string>& files, const Modules& modules) {
    const std::string inner = fmt::format("/{}/", variant.substr(0, variant.find(':')));
    for (const std::string& file : files)
        if (file.starts_with("techniques/") && file.find(inner) != std::string::npos) return moduleOf(file, modules);
    return "";
}

/// What `techniques` includes of its own folder: the families, and the contract that all have.
std::set<std::string> familiesOf(const Modules& modules) {
    std::set<std::string> families;
    for (const std::string& included : modules.at("techniques"))
        if (included.starts_with("techniques/") && included != "techniques/contract") families.insert(included);
    return families;
}

std::set<std::string> modulesOfRecords(const Mutant& mutant, const std::vector<std::string>& files, const Modules& modules) {
    std::set<std::string> all;
    addWithIncludes("harness/cells", modules, familiesOf(modules), all);
    for (const std::string& variant : mutant.techniques)
        addWithIncludes(familyOf(variant, files, modules), modules, {}, all);
    if (mutant.sweep || mutant.means == Means::Shader) addWithIncludes("studies", modules, familiesOf(modules), all);
    return all;
}

/// Tests of a folder of the harness link that folder; all others link what their top folder holds, and load scenes.
std::set<std::string> modulesOfTest(const std::string& name, const Modules& modules) {
    const std::string folder = name.substr(0, name.rfind('/'));
    const std::string tested = folder.starts_with("harness/") ? folder : folder.substr(0, folder.find('/'));
    std::set<std::string> all;
    for (const auto& [module, includes] : modules)
        if (isWithin(module, tested) || module == "scene/load") addWithIncludes(module, modules, {}, all);
    const bool unknown = std::ranges::none_of(modules, [&](const auto& m) { return isWithin(m.first, tested); });
    if (unknown)
        for (const auto& [module, includes] : modules) all.insert(module);
    return all;
}

/// Files of modules that matter which only compare records, name all techniques, or are scenes that are not run.
bool isLeftOut(const std::string& file, const Mutant& mutant) {
    constexpr std::string_view library = "scene/library/";
    if (!file.starts_with(library))
        return file.starts_with("harness/records/compare.") || file.starts_with("techniques/catalog.");
    const std::string scene = file.substr(library.size(), file.rfind('.') - library.size());
    return std::ranges::find(mutant.scenes, scene) == mutant.scenes.end() && !mutant.target.starts_with(scene + "/");
}

} // namespace

std::vector<std::string> sourcesThatMatter(const Mutant& mutant, const std::vector<std::string>& files,
                                           std::string_view layers) {
    const Modules modules = modulesOf(layers);
    const bool isTest = mutant.means == Means::Test;
    const std::set<std::string> matter =
        isTest ? modulesOfTest(mutant.target, modules) : modulesOfRecords(mutant, files, modules);
    const std::string test = fmt::format("tests/{}_test.cpp", mutant.target);
    std::vector<std::string> result;
    for (const std::string& file : files) {
        const bool ofTest = isTest && (file == test || isWithin(file, "tests/support"));
        const bool golden = mutant.means == Means::Truth && isWithin(file, "results/reference");
        const bool included = matter.contains(moduleOf(file, modules)) && (isTest || !isLeftOut(file, mutant));
        if (included || golden || ofTest) result.push_back(file);
    }
    return result;
}

} // namespace shadowbench::mutants
