#include "tools/mutants/mutant.h"

#include "base/error.h"
#include "base/files.h"
#include "base/toml_value.h"
#include "scene/load/load.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

namespace shadowbench::mutants {
namespace {

using gate::Class;

constexpr std::array classes{Class::Labels, Class::FalseShadow, Class::Leak,       Class::Edge,        Class::Penumbra,
                             Class::Colour, Class::Flicker,     Class::BreakPoint, Class::Instructions};

Class classNamed(const TomlValue& value) {
    std::vector<std::string> names;
    for (const Class c : classes) names.emplace_back(name(c));
    const std::string word = value.oneOf(names);
    return *std::ranges::find_if(classes, [&](Class c) { return name(c) == word; });
}

std::vector<std::string> texts(const TomlValue& value) {
    std::vector<std::string> result;
    for (const TomlValue& member : value.list()) result.push_back(member.text());
    return result;
}

Sweep readSweep(const TomlValue& value) {
    value.only({"axis", "values"});
    Sweep sweep{value.get("axis").text(), {}};
    for (const TomlValue& member : value.get("values").list()) sweep.values.push_back(member.number());
    return sweep;
}

Mutant readMutant(const TomlValue& value) {
    value.only({"id", "what", "file", "find", "replace", "techniques", "scenes", "sweep", "class", "survives"});
    Mutant mutant;
    mutant.id = value.get("id").text();
    mutant.what = value.get("what").text();
    mutant.file = value.get("file").text();
    mutant.find = value.get("find").text();
    mutant.replace = value.get("replace").text();
    if (mutant.find.empty()) value.get("find").fail("is empty");
    mutant.techniques = texts(value.get("techniques"));
    if (mutant.techniques.empty()) value.get("techniques").fail("names no technique");
    if (const auto scenes = value.find("scenes")) mutant.scenes = texts(*scenes);
    if (const auto sweep = value.find("sweep")) mutant.sweep = readSweep(*sweep);
    if (mutant.sweep && mutant.scenes.size() != 1) value.get("sweep").fail("needs exactly one scene");
    mutant.expected = classNamed(value.get("class"));
    if (const auto survives = value.find("survives")) mutant.survives = survives->text();
    return mutant;
}

} // namespace

std::vector<Mutant> readMutants(const std::filesystem::path& file) {
    const TomlSource source{file.string()};
    const toml::table table = parseToml(readFile(file), source.file);
    const TomlValue root(source, "", table);
    root.only({"mutant"});
    std::vector<Mutant> mutants;
    for (const TomlValue& value : root.get("mutant").list()) {
        Mutant mutant = readMutant(value);
        if (std::ranges::find(mutants, mutant.id, &Mutant::id) != mutants.end())
            value.get("id").fail(fmt::format("there are two of \"{}\"", mutant.id));
        mutants.push_back(std::move(mutant));
    }
    return mutants;
}

std::vector<Mutant> onTheGatesScenes(std::vector<Mutant> mutants, const gate::Watchlist& watchlist) {
    for (Mutant& mutant : mutants) {
        if (!mutant.scenes.empty()) continue;
        mutant.scenes = standardScenes();
        for (const gate::Watch& watch : watchlist.scenes)
            if (std::ranges::all_of(mutant.techniques, [&](const std::string& t) { return watch.covers(t); }))
                mutant.scenes.push_back(watch.scene);
    }
    return mutants;
}

std::vector<Mutant> matching(const std::vector<Mutant>& mutants, const std::vector<std::string>& globs) {
    const auto matches = [](const std::string& glob, const Mutant& mutant) {
        return fnmatch(glob.c_str(), mutant.id.c_str(), 0) == 0;
    };
    for (const std::string& glob : globs)
        if (std::ranges::none_of(mutants, [&](const Mutant& m) { return matches(glob, m); }))
            throw BadInput(fmt::format("no mutant is called \"{}\"; --list shows all", glob));
    std::vector<Mutant> chosen;
    for (const Mutant& mutant : mutants)
        if (globs.empty() || std::ranges::any_of(globs, [&](const std::string& glob) { return matches(glob, mutant); }))
            chosen.push_back(mutant);
    return chosen;
}

std::string planted(const Mutant& mutant, std::string_view source) {
    const std::size_t at = source.find(mutant.find);
    if (at == std::string_view::npos)
        throw BadInput(fmt::format("mutant {}: its text is no longer in {}", mutant.id, mutant.file.string()));
    if (source.find(mutant.find, at + 1) != std::string_view::npos)
        throw BadInput(fmt::format("mutant {}: its text is in {} more than once", mutant.id, mutant.file.string()));
    std::string result(source);
    return result.replace(at, mutant.find.size(), mutant.replace);
}

std::vector<std::string> arguments(const Mutant& mutant) {
    std::vector<std::string> words{mutant.sweep ? "sweep" : "run", "--quiet"};
    for (const std::string& technique : mutant.techniques) words.insert(words.end(), {"--technique", technique});
    for (const std::string& scene : mutant.scenes) words.insert(words.end(), {"--scene", scene});
    if (mutant.sweep)
        words.insert(words.end(),
                     {"--axis", mutant.sweep->axis, "--values", fmt::format("{}", fmt::join(mutant.sweep->values, ","))});
    else
        words.insert(words.end(), {"--cost", mutant.isSlowdown() ? "instructions" : "none"});
    return words;
}

} // namespace shadowbench::mutants
