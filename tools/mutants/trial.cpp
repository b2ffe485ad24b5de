#include "tools/mutants/trial.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "groundtruth/store/cache.h"
#include "tools/mutants/sources.h"
#include "tools/mutants/tool.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::mutants {
namespace {

std::string hashOf(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += word + '\0';
    return fmt::format("{:016x}", hash64(all));
}

/// Records and figures are kept as they are; what has none, as the sentence.
void write(const std::filesystem::path& file, const Trial& trial) {
    if (!trial.shaders.shaders.empty())
        writeFile(file, shaders::toLines(trial.shaders));
    else if (trial.refused.empty() && !trial.records.empty())
        writeRecords(file, trial.records);
    else
        writeFile(file, fmt::format("refused: {}\n", trial.refused));
}

Trial read(const std::filesystem::path& file, const Mutant& mutant) {
    constexpr std::string_view heading = "refused: ";
    const std::string text = readFile(file);
    const bool isRefused = text.starts_with(heading);
    if (!isRefused && mutant.means == Means::Shader) return {{}, "", shaders::readLines(file)};
    if (!isRefused) return {readRecords(file), ""};
    return {{}, text.substr(heading.size(), text.size() - heading.size() - 1)};
}

/// Folder and executable of the tests that a test of CTest belongs to.
std::string testTarget(const std::string& test) {
    std::string target = fmt::format("test_{}", test.substr(0, test.rfind('/')));
    std::ranges::replace(target, '/', '_');
    return target;
}

/// Truths that a fault may have touched must not reach the references that other runs share.
bool mayTouchTruths(const Mutant& mutant) {
    const std::string file = mutant.file.string();
    return file.starts_with("groundtruth/") || file.starts_with("scene/") || file.starts_with("base/");
}

} // namespace

Trials::Trials(const TreeCopy& tree, std::filesystem::path kept)
    : tree_(tree), kept_(std::move(kept)), layers_(tree.read("cmake/layers.txt")) {}

std::string Trials::key(const Mutant& mutant) const {
    std::vector<std::string> words = arguments(mutant);
    std::ranges::copy(mutant.byChance, std::back_inserter(words));
    for (const std::string& source : sourcesThatMatter(mutant, tree_.files(), layers_))
        words.insert(words.end(), {source, tree_.read(source)});
    return hashOf(words);
}

std::filesystem::path Trials::baseFile(const Mutant& mutant) const {
    return kept_ / fmt::format("base-{}.jsonl", key(mutant));
}

std::filesystem::path Trials::file(const Mutant& mutant) const {
    const std::string source = tree_.read(mutant.file);
    return kept_ /
           fmt::format("{}-{}.jsonl", mutant.id, hashOf({key(mutant), mutant.file.string(), planted(mutant, source)}));
}

bool Trials::hasBase(const Mutant& mutant) const { return std::filesystem::exists(baseFile(mutant)); }
bool Trials::has(const Mutant& mutant) const { return std::filesystem::exists(file(mutant)); }
Trial Trials::base(const Mutant& mutant) const { return read(baseFile(mutant), mutant); }
Trial Trials::of(const Mutant& mutant) const { return read(file(mutant), mutant); }

void Trials::makeBase(const Mutant& mutant) const {
    const Trial trial = run(mutant);
    if (!trial.refused.empty())
        throw InternalError(fmt::format("mutant {}: without the fault {}", mutant.id, trial.refused));
    write(baseFile(mutant), trial);
}

void Trials::make(const Mutant& mutant) const {
    const std::filesystem::path result = file(mutant); // named by the tree without the fault
    const PlantedFault fault(tree_, mutant.file, planted(mutant, tree_.read(mutant.file)));
    write(result, run(mutant));
}

Trial Trials::run(const Mutant& mutant) const {
    if (mutant.makesRecords()) return runProgram(mutant);
    if (mutant.means == Means::Shader) return runShaderCost(mutant);
    ToolResult result;
    if (mutant.means == Means::Test) {
        tree_.build(testTarget(mutant.target));
        result = tryTool("ctest",
                         {"--test-dir", "build/release", "-R", fmt::format("^{}$", mutant.target), "--no-tests=error",
                          "--output-on-failure"},
                         tree_.folder());
    } else {
        tree_.build("shadowbench");
        result = tryTool(tree_.program(), arguments(mutant), tree_.folder());
    }
    return {{}, result.succeeded ? "" : fmt::format("{} failed: {}", mutant.target, result.complaint())};
}

Trial Trials::runShaderCost(const Mutant& mutant) const {
    tree_.build("shadowbench");
    const std::filesystem::path out = tree_.folder() / "running", file = out / "shader-cost.jsonl";
    std::filesystem::remove_all(out);
    std::vector<std::string> words = arguments(mutant);
    words.insert(words.end(), {"--out", out.string(), "--cache", groundtruth::defaultCacheFolder().string()});
    const ToolResult result = tryTool(tree_.program(), words, tree_.folder());
    if (!result.succeeded) return {{}, result.complaint()};
    return {{}, "", shaders::readLines(file)};
}

Trial Trials::runProgram(const Mutant& mutant) const {
    tree_.build("shadowbench");
    const std::filesystem::path out = tree_.folder() / "running", own = tree_.folder() / "references";
    std::filesystem::remove_all(own);
    const std::filesystem::path cache = mayTouchTruths(mutant) ? own : groundtruth::defaultCacheFolder();
    Trial trial;
    const std::uint32_t seeds = mutant.byChance.empty() ? 1 : gate::seedsOfChance;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        std::filesystem::remove_all(out);
        std::vector<std::string> words = arguments(mutant);
        words.insert(words.end(), {"--seed", std::to_string(seed), "--out", out.string(), "--cache", cache.string()});
        const ToolResult result = tryTool(tree_.program(), words, tree_.folder());
        const std::filesystem::path file = out / (mutant.sweep ? "sweep.jsonl" : "results.jsonl");
        if (!std::filesystem::exists(file))
            return {{}, result.succeeded ? "the program left no records" : result.complaint()};
        for (Record& record : readRecords(file)) // cells in error among them
            if (seed == 1 ||
                std::ranges::find(mutant.byChance, record.scene + " " + record.variant) != mutant.byChance.end())
                trial.records.push_back(std::move(record));
    }
    return trial;
}

} // namespace shadowbench::mutants
