#include "gate/check/check.h"

#include "base/files.h"
#include "base/limits.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "base/worker_processes.h"
#include "gate/bounds.h"
#include "gate/check/row_checks.h"
#include "harness/metrics/table.h"
#include "harness/runs/run.h"
#include "scene/load/expectations.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/folder/description.h"
#include "techniques/gl/context.h"

#include <fmt/format.h>
#include <map>
#include <memory>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using OnResult = std::function<void(const CheckResult&)>;

constexpr const char* expectationsFile = "expect.toml";

std::chrono::seconds limit() { return std::chrono::seconds(limitOf(shadowbench::Limit::CellSeconds)); }

/// A row that cannot be made at all is bad input; at the end of a range it does not hold.
void requireMade(const techniques::Entry& entry) {
    checkInOwnProcess(
        [&] {
            const auto context = gl::Context::create();
            for (const std::string& parameters : entry.variants)
                entry.make(techniques::parseParameters(parameters, entry.parameters, entry.id));
        },
        limit());
}

/// Draws each check in some process, so that a shader that hangs or crashes is a result. Whether all hold.
bool drawChecks(const std::vector<RowCheck>& checks, const OnResult& onResult) {
    std::unique_ptr<gl::Context> context; // of a worker
    std::map<std::size_t, std::string> finished;
    std::size_t next = 0;
    bool hold = true;
    const auto finish = [&](std::size_t item, std::string wrong) {
        hold = hold && wrong.empty();
        finished[item] = std::move(wrong);
        for (; finished.contains(next); ++next) onResult({checks[next].what, finished[next]});
    };
    SharedWork work;
    work.items = checks.size();
    work.work = [&](std::size_t item, const Progress&) -> std::string {
        if (!context) context = gl::Context::create({.debug = true, .shaderCache = {}}); // what GL refuses is told
        try {
            return checks[item].draw();
        } catch (const std::exception& error) {
            return error.what();
        }
    };
    work.leave = [&] { context.reset(); };
    work.finished = finish;
    work.lost = [&](std::size_t item, const std::string& how) {
        const std::string remedy = how.ends_with("was ended") ? fmt::format(": shorten its shaders' loops, or raise {}",
                                                                            variableOf(shadowbench::Limit::CellSeconds))
                                                              : "";
        finish(item, fmt::format("the process that drew it {}{}", how, remedy));
    };
    work.limit = [](std::size_t) { return limit(); };
    shareAmongProcesses(availableThreads(), work);
    return hold;
}

/// All that a run measures by itself.
std::vector<std::string> expectableMetrics() {
    std::vector<std::string> names = metrics::boundedMetrics();
    std::erase_if(names,
                  [](const std::string& name) { return metrics::boundedMetric(name)->notCompared == metrics::onDemand; });
    return names;
}

/// With the rows by the names that records have for them.
std::vector<SceneExpectations> readExpectations(const fs::path& file) {
    if (!fs::exists(file)) return {};
    std::vector<SceneExpectations> all = parseExpectations(readFile(file), file, expectableMetrics());
    for (SceneExpectations& of : all)
        for (Expectation& one : of.expectations) {
            try {
                one.technique = techniques::parseVariant(one.technique).name;
            } catch (const BadInput& error) {
                throw BadInput(fmt::format("{}: \"{}\": {}", file.string(), one.technique, error.what()));
            }
        }
    return all;
}

/// Why the row has no score.
std::string reasonOf(const std::vector<Record>& records, const Change& change) {
    for (const Record& record : records)
        if (record.variant == change.variant && !wasScored(record.status)) return record.reason;
    return change.sentence;
}

/// `expected` on its scene. Whether all hold.
bool judge(const SceneExpectations& expected, const RunOptions& options, const OnResult& onResult) {
    Scene scene = loadScene(expected.scene, Profile::Gate);
    scene.expectations = expected.expectations;
    const std::vector<Record> records = run(options).records;
    bool hold = true;
    for (const BoundRule& rule : boundsOf(scene)) {
        const Change change = judgeBounds(records, {rule}, true).front();
        const bool holds = change.direction == Direction::Same;
        onResult({fmt::format("{} on {}: {}", change.variant, change.scene, text(rule.bound)),
                  holds         ? ""
                  : change.head ? change.sentence
                                : reasonOf(records, change)});
        hold = hold && holds;
    }
    return hold;
}

bool judgeExpectations(const std::vector<SceneExpectations>& all, const fs::path& cache, const OnResult& onResult) {
    const TemporaryFolder room;
    bool hold = true;
    for (const SceneExpectations& expected : all) {
        RunOptions options;
        options.scenes = {expected.scene};
        for (const Expectation& one : expected.expectations) options.techniques.push_back(one.technique);
        options.out = room.path();
        options.cache = cache;
        options.measure.time = false;
        hold = judge(expected, options, onResult) && hold;
    }
    return hold;
}

} // namespace

ExitCode checkFolder(const fs::path& folder, const fs::path& cache, const OnResult& onResult) {
    const techniques::Entry& entry = techniques::entryNamed(techniques::readTechniqueFolder(folder).entry.id);
    const std::vector<SceneExpectations> expected = readExpectations(folder / expectationsFile);
    requireMade(entry);
    const bool sound = drawChecks(rowChecks(entry), onResult);
    const bool asExpected = judgeExpectations(expected, cache, onResult);
    return sound && asExpected ? ExitCode::Pass : ExitCode::AccuracyRegression;
}

} // namespace shadowbench::gate
