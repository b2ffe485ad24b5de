#include "gate/measured_program.h"

#include "base/error.h"
#include "base/files.h"
#include "base/folder_lock.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/process.h"
#include "base/temporary_folder.h"
#include "harness/cells/environment.h"
#include "harness/measure/callgrind.h"
#include "harness/records/comparability.h"
#include "harness/runs/cell_file.h"
#include "techniques/catalog.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::chrono::hours longestStep{3};

/// What a program's records depend on beside the program.
std::string surroundings() {
    const auto context = gl::Context::create();
    const Environment e = environmentOf(context->info());
    return countingEnvironment(e) + (findProgram("valgrind") ? "\n" + timing::valgrindVersion() : "");
}

/// As a user would start it: what it calls depends on where it runs, and needs more than we do.
void asThisProcess(Command& command) {
    command.environment = ownEnvironment();
    command.cpuLimit.reset();
    command.memoryLimit.reset();
    command.openFiles.reset();
    command.fileLimit = std::numeric_limits<std::uintmax_t>::max();
    command.inherited.clear();
}

/// Of each of `programs` that run at once.
int threadsOf(int programs) { return std::max(1, availableThreads() / programs); }

/// What a step has left in `out`.
std::vector<Record> recordsIn(const fs::path& out, const Step& step) {
    if (!step.isPart()) return readRecords(out / step.records);
    std::vector<Record> records;
    for (shards::MeasuredCell& cell : shards::readCells(out)) records.push_back(std::move(cell.record));
    return records;
}

/// The exit code and the last line; `onLine` sees all of them. It is one of `programs` that run at once.
std::pair<int, std::string> runToEnd(const fs::path& program, const std::vector<std::string>& arguments,
                                     const OnLine& onLine, int programs = 1, bool callsRenderers = false) {
    const TemporaryFolder folder;
    Command command{program, arguments, folder.path()};
    command.threads = threadsOf(programs);
    command.limit = longestStep;
    command.cpuLimit = longestStep;
    command.memoryLimit = std::uintmax_t{64} << 30U; // of addresses: Valgrind reserves far more than it uses
    command.fileLimit = std::uintmax_t{1} << 30U;
    command.inherited = techniques::inheritedVariables();
    command.grace = std::chrono::seconds(10); // it is writing records and images into the cache
    if (callsRenderers) asThisProcess(command);
    std::string last;
    const Finished finished = runProcess(command, [&](std::string_view line) {
        last = line;
        onLine(line);
    });
    if (finished.timedOut) return {-1, "it took more than three hours"};
    if (finished.signal != 0) return {-1, fmt::format("it was ended by signal {}", finished.signal)};
    return {finished.exitCode, last};
}

/// Whether a line is of a program's progress ("trees 3/31  sm-uniform"), not of its results.
bool isProgress(std::string_view line) {
    const std::size_t slash = line.find('/');
    const auto digit = [&](std::size_t at) {
        return at < line.size() && std::isdigit(static_cast<unsigned char>(line[at]));
    };
    return slash != std::string_view::npos && slash > 0 && digit(slash - 1) && digit(slash + 1) && line.front() != ' ';
}

Json listOf(const fs::path& program, const std::string& what) {
    std::string text;
    const auto [code, last] =
        runToEnd(program, {"list", what, "--format", "json"}, [&](std::string_view line) { text += line; });
    Json list = Json::parse(text, nullptr, false);
    if (code != 0 || !list.is_array())
        throw Inconclusive(fmt::format("{} does not say which {} it has: {}", program.string(), what, last));
    return list;
}

/// What the program says of itself; nothing where it has no such verb.
std::optional<BuildInfo> buildOf(const fs::path& program) {
    std::string text;
    const auto [code, last] = runToEnd(program, {"policy"}, [&](std::string_view line) { text += line; });
    if (code != 0) return {};
    return buildInfoFrom(text);
}

/// "pcss:taps=32+32,map=2048" → ("taps", "32+32"), ("map", "2048").
std::vector<std::pair<std::string, std::string>> assignmentsOf(const std::string& variant) {
    std::vector<std::pair<std::string, std::string>> assignments;
    const std::size_t id = techniques::idOfVariant(variant).size();
    for (std::size_t at = variant.find(':', id); at != std::string::npos; at = variant.find(',', at + 1)) {
        const std::size_t equals = variant.find('=', at);
        assignments.emplace_back(variant.substr(at + 1, equals - at - 1),
                                 variant.substr(equals + 1, variant.find(',', equals) - equals - 1));
    }
    return assignments;
}

/// Whether a listed domain ("a|b", "1…8") has the value.
bool allows(const std::string& domain, const std::string& value) {
    constexpr std::string_view to = "…";
    if (const std::size_t at = domain.find(to); at != std::string::npos) {
        const double number = std::strtod(value.c_str(), nullptr);
        return number >= std::strtod(domain.c_str(), nullptr) &&
               number <= std::strtod(domain.c_str() + at + to.size(), nullptr);
    }
    return ("|" + domain + "|").find("|" + value + "|") != std::string::npos;
}

/// The files of a technique folder: what was measured of others is no answer.
std::string digestOf(const std::string& variant) {
    const auto entry = std::ranges::find(techniques::catalog(), techniques::idOfVariant(variant), &techniques::Entry::id);
    return entry == techniques::catalog().end() ? "" : entry->digest;
}

} // namespace

MeasuredProgram::MeasuredProgram(const fs::path& file, const fs::path& cache)
    : file_(fs::absolute(file)), cache_(fs::absolute(cache)) {
    try {
        const std::string bytes = readFile(file_);
        content_ = hash128(bytes).text();
        surroundings_ = surroundings();
        runs_ = cache_ / "gate" / hash128(bytes + surroundings_).text();
    } catch (const BadInput& error) {
        throw Inconclusive(error.what());
    }
    build_ = buildOf(file_);
    for (const Json& scene : listOf(file_, "scenes")) scenes_.push_back(scene.at("id"));
    for (const Json& technique : listOf(file_, "techniques")) {
        Technique& known = techniques_.emplace_back(Technique{technique.at("id"), {}, technique.at("variants")});
        for (const Json& parameter : technique.at("parameters"))
            known.parameters[parameter.at("name")] = parameter.at("values");
    }
}

bool MeasuredProgram::knowsVariant(const std::string& variant) const {
    const auto technique = std::ranges::find(techniques_, techniques::idOfVariant(variant), &Technique::id);
    if (technique == techniques_.end()) return false;
    return std::ranges::all_of(assignmentsOf(variant), [&](const auto& assignment) {
        const auto parameter = technique->parameters.find(assignment.first);
        return parameter != technique->parameters.end() && allows(parameter->second, assignment.second);
    });
}

bool MeasuredProgram::knowsScene(const std::string& id) const { return std::ranges::find(scenes_, id) != scenes_.end(); }

std::vector<std::string> MeasuredProgram::variants() const {
    std::vector<std::string> variants;
    for (const Technique& technique : techniques_)
        for (const std::string& parameters : technique.variants)
            variants.push_back(parameters.empty() ? technique.id : technique.id + ":" + parameters);
    return variants;
}

void MeasuredProgram::run(const Step& step, const fs::path& out, int programs, const Progress& progress) const {
    std::vector<std::string> arguments = step.arguments;
    if (step.isPart()) arguments.insert(arguments.end(), {"--jobs", std::to_string(threadsOf(programs))});
    for (const std::string& technique : step.techniques) arguments.insert(arguments.end(), {"--technique", technique});
    arguments.insert(arguments.end(), {"--out", fs::absolute(out).string(), "--cache", cache_.string()});
    const auto showProgress = [&](std::string_view line) {
        if (isProgress(line)) progress(0, line);
    };
    const auto [code, last] = runToEnd(file_, arguments, showProgress, programs, step.callsRenderers);
    if (code < 0 || code == static_cast<int>(ExitCode::Transient) || !fs::exists(out / step.records))
        throw Inconclusive(fmt::format("{} failed at {}: {}", file_.string(), step.name, last));
}

ShaderFigures MeasuredProgram::shaderFigures(const std::vector<std::string>& variants, const fs::path& out,
                                             const Progress& progress) const {
    constexpr std::string_view prefix = "shadowbench: ";
    std::vector<std::string> arguments{"shader-cost", "--out", fs::absolute(out).string(), "--cache", cache_.string()};
    for (const std::string& variant : variants)
        if (knowsVariant(variant)) arguments.insert(arguments.end(), {"--technique", variant});
    ShaderFigures figures;
    fs::remove_all(out);
    const auto [code, last] = runToEnd(file_, arguments, [&](std::string_view line) {
        if (isProgress(line)) progress(0, line);
        if (line.starts_with(prefix)) figures.errors.emplace_back(line.substr(prefix.size()));
    });
    figures.code = code < 0 ? ExitCode::Internal : static_cast<ExitCode>(code);
    figures.last = last.starts_with(prefix) ? last.substr(prefix.size()) : last;
    if (const fs::path file = out / "shader-cost.jsonl"; fs::exists(file)) figures.file = file;
    return figures;
}

std::vector<Record> Measured::records() const {
    std::vector<Record> all;
    for (const std::vector<Record>& step : ofSteps) all.insert(all.end(), step.begin(), step.end());
    return all;
}

std::string Step::place() const { return fmt::format("{}\n{}\n{}", name, fmt::join(arguments, "\n"), inputs); }

std::map<std::string, std::vector<Record>> byTechnique(const std::vector<Record>& records) {
    std::map<std::string, std::vector<Record>> all;
    for (const Record& record : records) all[record.sweep ? record.sweep->curve : record.variant].push_back(record);
    return all;
}

void MeasuredProgram::distrustReach() {
    if (build_) build_->reach = {};
}

std::string MeasuredProgram::reachOf(const Step& step, const std::string& technique) const {
    return build_ ? build_->reach.key(std::string(techniques::idOfVariant(technique)), step.scene).value_or("") : "";
}

fs::path MeasuredProgram::fileOf(const Step& step, const std::string& technique) const {
    const std::string reach = reachOf(step, technique);
    const std::string hash = hash128(fmt::format("{}\n{}\n{}\n{}\n{}", surroundings_, reach.empty() ? content_ : reach,
                                                 step.place(), technique, digestOf(technique)))
                                 .text();
    return cache_ / "gate" / "results" / hash.substr(0, 2) / (hash + ".jsonl");
}

bool MeasuredProgram::isKept(const Step& step, const std::string& technique) const {
    return kept(step, technique).has_value();
}

std::optional<std::vector<Record>> MeasuredProgram::kept(const Step& step, const std::string& technique) const {
    const fs::path file = fileOf(step, technique), hash = fs::path(file).replace_extension(".hash");
    if (!fs::exists(file) || !fs::exists(hash) || hash128(readFile(file)).text() != readFile(hash)) return std::nullopt;
    std::vector<Record> records = readRecords(file);
    if (!reachOf(step, technique).empty()) // another program with the same may have measured them
        for (Record& record : records) {
            record.commit = build_->commit;
            record.dirty = build_->dirty;
            record.program = build_->program;
        }
    return records;
}

void MeasuredProgram::keep(const Step& step, const std::string& technique, const std::vector<Record>& records) const {
    const fs::path file = fileOf(step, technique);
    writeRecords(file, records);
    writeFile(fs::path(file).replace_extension(".hash"), hash128(readFile(file)).text());
}

fs::path MeasuredProgram::folderOf(const Step& step) const {
    return runs_ / hash128(fmt::format("{}\n{}", step.place(), fmt::join(step.techniques, "\n"))).text();
}

MeasuredProgram::Results MeasuredProgram::results(const Step& step, bool again, int programs,
                                                  const Progress& progress) const {
    const fs::path out = folderOf(step);
    if (again) fs::remove_all(out);
    run(step, out, programs, progress);
    Results all = byTechnique(recordsIn(out, step));
    if (!again)
        for (const auto& [technique, records] : all)
            if (std::ranges::find(records, Status::Error, &Record::status) == records.end()) // else it is tried again
                keep(step, technique, records);
    fs::remove_all(out);
    return all;
}

Measured MeasuredProgram::measure(const std::vector<Step>& steps, const Progress& progress) const {
    return measured(steps, false, progress);
}

Measured MeasuredProgram::measureAgain(const std::vector<Step>& steps, const Progress& progress) const {
    return measured(steps, true, progress);
}

Measured MeasuredProgram::measured(const std::vector<Step>& steps, bool again, const Progress& progress) const {
    using Clock = std::chrono::steady_clock;
    Measured measured;
    measured.ofSteps.resize(steps.size());
    std::vector<std::optional<StepTime>> times(steps.size());
    std::mutex mutex;
    std::size_t ended = 0;
    // Another gate that measures the same program does so for both.
    const FolderLock alone(runs_, [&] { progress(0, "waiting for another gate that measures this program"); });
    const int programs = std::min(static_cast<int>(steps.size()), availableThreads());
    inParallel(static_cast<int>(steps.size()), programs, [&](int index) {
        const auto i = static_cast<std::size_t>(index);
        Step open = steps[i];
        Results all;
        if (!again) {
            for (const std::string& technique : open.techniques)
                if (auto records = kept(open, technique)) all[technique] = std::move(*records);
            std::erase_if(open.techniques, [&](const std::string& technique) { return all.contains(technique); });
        }
        if (!open.techniques.empty()) {
            const auto start = Clock::now();
            all.merge(results(open, again, programs, [&](double, std::string_view line) {
                const std::scoped_lock lock(mutex);
                progress(static_cast<double>(ended) / static_cast<double>(steps.size()), line);
            }));
            times[i] = {open.name, std::chrono::duration<double>(Clock::now() - start).count()};
        }
        for (const std::string& technique : steps[i].techniques)
            if (const auto found = all.find(technique); found != all.end())
                std::ranges::move(found->second, std::back_inserter(measured.ofSteps[i]));
        const std::scoped_lock lock(mutex);
        ++ended;
    });
    for (const std::optional<StepTime>& time : times)
        if (time) measured.times.push_back(*time);
    return measured;
}

} // namespace shadowbench::gate
