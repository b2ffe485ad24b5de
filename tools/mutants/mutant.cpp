#include "tools/mutants/mutant.h"

#include "base/error.h"
#include "base/files.h"
#include "base/toml_value.h"
#include "scene/load/load.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

namespace shadowbench::mutants {
namespace {

using gate::Class;

constexpr std::array classes{Class::Labels,   Class::FalseShadow,  Class::Leak,    Class::Edge,
                             Class::Penumbra, Class::Colour,       Class::Flicker, Class::BreakPoint,
                             Class::Work,     Class::Instructions, Class::Status};

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

/// `detected_by`: "gate", "refusal", "shader", "truth:SCENE/TRUTH" or "test:NAME".
void readMeans(const TomlValue& value, Mutant& mutant) {
    const std::string text = value.text();
    const std::string word = text.substr(0, text.find(':'));
    if (word.size() < text.size()) mutant.target = text.substr(word.size() + 1);
    const auto targets = std::ranges::count(mutant.target, '/');
    if (text == "gate")
        mutant.means = Means::Gate;
    else if (text == "refusal")
        mutant.means = Means::Refusal;
    else if (text == "shader")
        mutant.means = Means::Shader;
    else if (word == "truth" && (targets == 1 || targets == 2))
        mutant.means = Means::Truth;
    else if (word == "test" && targets > 0)
        mutant.means = Means::Test;
    else
        value.fail(R"(expected "gate", "refusal", "shader", "truth:SCENE/TRUTH", "truth:SCENE/TRUTH/FRAME" or "test:NAME")");
}

void readTechniques(const TomlValue& value, Mutant& mutant) {
    mutant.techniques = texts(value.get("techniques"));
    if (mutant.techniques.empty()) value.get("techniques").fail("names no technique");
}

/// Techniques and pass of a mutant that its shaders detect.
void readShader(const TomlValue& value, Mutant& mutant) {
    readTechniques(value, mutant);
    if (mutant.benign) return;
    mutant.expected = Class::Shader;
    mutant.pass = value.get("pass").text();
}

/// Techniques, scenes and class of a mutant that records detect.
void readCells(const TomlValue& value, Mutant& mutant) {
    readTechniques(value, mutant);
    if (const auto scenes = value.find("scenes")) mutant.scenes = texts(*scenes);
    if (const auto sweep = value.find("sweep")) mutant.sweep = readSweep(*sweep);
    if (mutant.sweep && mutant.scenes.size() != 1) value.get("sweep").fail("needs exactly one scene");
    if (mutant.means == Means::Gate && !mutant.benign) mutant.expected = classNamed(value.get("class"));
}

Mutant readMutant(const TomlValue& value) {
    Mutant mutant;
    if (const auto benign = value.find("benign")) mutant.benign = benign->boolean();
    if (const auto means = value.find("detected_by")) readMeans(*means, mutant);
    std::vector<std::string> known{"id", "what", "file", "find", "replace", "benign", "detected_by", "survives"};
    if (mutant.makesRecords()) known.insert(known.end(), {"techniques", "scenes", "sweep"});
    if (mutant.means == Means::Gate && !mutant.benign) known.emplace_back("class");
    if (mutant.means == Means::Shader) known.emplace_back("techniques");
    if (mutant.means == Means::Shader && !mutant.benign) known.emplace_back("pass");
    value.only(known);
    mutant.id = value.get("id").text();
    mutant.what = value.get("what").text();
    mutant.file = value.get("file").text();
    mutant.find = value.get("find").text();
    mutant.replace = value.get("replace").text();
    if (mutant.find.empty()) value.get("find").fail("is empty");
    if (mutant.makesRecords()) readCells(value, mutant);
    if (mutant.means == Means::Shader) readShader(value, mutant);
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

std::vector<Mutant> onTheGatesScenes(std::vector<Mutant> mutants, const gate::GateConfig& config) {
    for (Mutant& mutant : mutants) {
        if (!mutant.makesRecords()) continue;
        if (mutant.scenes.empty()) {
            mutant.scenes = standardScenes();
            for (const gate::GateRule& rule : config.scenes)
                if (std::ranges::all_of(mutant.techniques, [&](const std::string& t) { return rule.covers(t); }))
                    mutant.scenes.push_back(rule.scene);
        }
        if (mutant.isSlowdown() || mutant.sweep) continue;
        for (const std::string& scene : mutant.scenes)
            for (const std::string& variant : mutant.techniques)
                if (config.isByChance(scene, variant)) mutant.byChance.push_back(scene + " " + variant);
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

std::vector<Mutant> shardOf(const std::vector<Mutant>& mutants, const std::string& shard) {
    std::size_t index = 0, count = 0;
    const char* const end = shard.data() + shard.size();
    const auto first = std::from_chars(shard.data(), end, index);
    const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = slash ? std::from_chars(first.ptr + 1, end, count) : first;
    if (!slash || second.ec != std::errc() || second.ptr != end || index < 1 || index > count)
        throw BadInput(fmt::format("\"{}\" is no shard: give its number and how many there are, such as 2/3", shard));
    std::vector<Mutant> chosen;
    for (std::size_t i = index - 1; i < mutants.size(); i += count) chosen.push_back(mutants[i]);
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

std::string expectedText(const Mutant& mutant) {
    if (mutant.benign) return "nothing";
    switch (mutant.means) {
    case Means::Gate:
    case Means::Shader:
        return std::string(name(*mutant.expected));
    case Means::Refusal:
        return "refusal";
    case Means::Truth:
        return fmt::format("truth:{}", mutant.target);
    case Means::Test:
        return fmt::format("test:{}", mutant.target);
    }
    return "";
}

std::vector<std::string> arguments(const Mutant& mutant) {
    if (mutant.means == Means::Test) return {"test", mutant.target};
    if (mutant.means == Means::Truth) {
        const std::size_t scene = mutant.target.find('/'), truth = mutant.target.find('/', scene + 1);
        std::vector<std::string> words{"reference",
                                       "--verify",
                                       "--quiet",
                                       "--scene",
                                       mutant.target.substr(0, scene),
                                       "--truth",
                                       mutant.target.substr(scene + 1, truth - scene - 1)};
        if (truth != std::string::npos) words.insert(words.end(), {"--frame", mutant.target.substr(truth + 1)});
        return words;
    }
    const bool isShader = mutant.means == Means::Shader;
    std::vector<std::string> words{isShader ? "shader-cost" : mutant.sweep ? "sweep" : "run", "--quiet"};
    for (const std::string& technique : mutant.techniques) words.insert(words.end(), {"--technique", technique});
    if (isShader) return words;
    for (const std::string& scene : mutant.scenes) words.insert(words.end(), {"--scene", scene});
    if (mutant.sweep)
        words.insert(words.end(),
                     {"--axis", mutant.sweep->axis, "--values", fmt::format("{}", fmt::join(mutant.sweep->values, ","))});
    else
        words.insert(words.end(), {"--cost", mutant.isSlowdown() ? "instructions" : "none"});
    return words;
}

} // namespace shadowbench::mutants
