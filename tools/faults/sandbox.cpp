#include "tools/faults/sandbox.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "harness/records/record.h"
#include "harness/runs/merge.h"
#include "tools/faults/whole_files.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view shaderCache = "cache/shaders/"; // Mesa's own

std::string sceneWith(const std::string& light) {
    return "# A box over a slab.\ntitle = \"Box\"\nsize = [32, 32]\nreference_samples = 16\n"
           "camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }\nlight = " +
           light +
           "\n[timeline]\nstill = 2\nmoving = 1\n"
           "[[object]]\nmesh = { box = { size = [12, 0.2, 12] } }\nplace = [{ at = [0, -0.1, 0] }]\n"
           "[[object]]\nmesh = { box = { size = [1.6, 0.4, 1.2] } }\nplace = [{ at = [0.13, 1.2, 0.21] }]\n";
}

/// Of records, what two measurements of one cell have in common.
std::vector<std::string> comparable(const fs::path& records) {
    std::vector<std::string> lines;
    for (const Record& record : readRecords(records)) lines.push_back(toJson(shards::withoutTimings(record)));
    std::ranges::sort(lines);
    return lines;
}

/// Files below `folder`, from it, but for temporary ones.
std::vector<std::string> filesBelow(const fs::path& folder) {
    std::vector<std::string> files;
    if (!fs::exists(folder)) return files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && !isTemporary(entry.path()))
            files.push_back(entry.path().lexically_relative(folder).string());
    std::ranges::sort(files);
    return files;
}

} // namespace

Sandbox::Sandbox(fs::path program, const std::vector<Verb>& verbs)
    : program_(std::move(program)), work_(fs::canonical(folder_.path()) / "work"),
      before_(fs::canonical(folder_.path()) / "before") {
    fs::create_directories(work_ / "tmp");
    writeFile(work_ / "point.toml", sceneWith("{ kind = \"point\", centre = [1.7, 6.1, -2.3] }"));
    writeFile(work_ / "area.toml",
              sceneWith("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.9, 0, 0], v = [0, 0, 0.9] }"));
    writeFile(work_ / "bounds.toml", "");
    const std::vector<std::string> run{"run",        "--quiet", "--cost", "none",        "--scene",
                                       "point.toml", "--cache", "cache",  "--technique", "pcf"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = run;
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    prepare(with({"--technique", "sm-uniform", "--images", "--out", "base"}));
    prepare(with({"--out", "half"}));
    prepare(with({"--technique", "sm-uniform", "--shard", "1/1", "--out", "parts"}));
    prepare({"score", "--quiet", "--scene", "point.toml", "--image", "base/images/point/pcf/visibility.exr", "--definition",
             "hard", "--name", "earlier", "--out", "rows", "--cache", "cache"});
    fs::copy(work_, before_, fs::copy_options::recursive);
    for (const Verb& verb : verbs) {
        reset();
        const Ended ended = runPlain(verb.arguments);
        if (ended.code != 0)
            throw InternalError(fmt::format("undisturbed, {} ends with {}: {}", verb.name, ended.code, ended.errors));
        expected_[verb.name] = {verb.records.empty() ? std::vector<std::string>() : comparable(work_ / verb.records),
                                filesBelow(work_ / verb.out)};
    }
    reset();
}

void Sandbox::prepare(const std::vector<std::string>& arguments) const {
    const Ended ended = runPlain(arguments);
    if (ended.code != 0)
        throw InternalError(fmt::format("{} ends with {}: {}", fmt::join(arguments, " "), ended.code, ended.errors));
}

void Sandbox::reset() {
    fs::remove_all(work_);
    fs::copy(before_, work_, fs::copy_options::recursive);
}

std::vector<std::string> Sandbox::environment() const {
    const char* path = std::getenv("PATH");
    return {"HOME=" + work_.string(), "TMPDIR=" + (work_ / "tmp").string(), "LC_ALL=C",
            "PATH=" + (work_ / "bin").string() + ":" + (path != nullptr ? path : "/usr/bin:/bin")};
}

Ended Sandbox::run(const Verb& verb, const Decide& decide, const std::vector<std::string>& variables) const {
    Job job{.program = program_, .arguments = verb.arguments, .folder = work_, .variables = environment()};
    job.variables.insert(job.variables.end(), variables.begin(), variables.end());
    return supervise(job, decide);
}

Ended Sandbox::runPlain(const std::vector<std::string>& arguments) const {
    Command command{.program = program_, .arguments = arguments, .folder = work_};
    command.limit = std::chrono::minutes(30); // of which most may be a wait for the others
    command.cpuLimit.reset();
    command.openFiles.reset();
    command.memoryLimit.reset();
    command.environment = environment();
    Ended ended;
    const Finished finished = runProcess(command, [&](std::string_view line) { (ended.errors += line) += '\n'; });
    ended.code = finished.signal != 0 ? 128 + finished.signal : finished.exitCode;
    ended.late = finished.timedOut;
    return ended;
}

std::vector<std::string> Sandbox::damage(bool killed) const {
    std::vector<std::string> sentences;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(work_)) {
        const std::string file = entry.path().lexically_relative(work_).string();
        if (!entry.is_regular_file() || file.starts_with(shaderCache) || file.starts_with("tmp/") || file == "bounds.toml")
            continue;
        if (isTemporary(entry.path())) {
            if (!killed) sentences.push_back(file + " is left");
        } else if (const auto what = partial(entry.path())) {
            sentences.push_back(file + " is partial: " + *what);
        }
    }
    return sentences;
}

std::vector<std::string> Sandbox::leftFolders() const {
    std::vector<std::string> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(work_ / "tmp"))
        left.push_back("tmp/" + entry.path().filename().string() + " is left");
    return left;
}

std::optional<std::string> Sandbox::difference(const Verb& verb) const {
    const Expected& expected = expected_.at(verb.name);
    const std::vector<std::string> files = filesBelow(work_ / verb.out);
    for (const std::string& file : expected.files)
        if (!std::ranges::binary_search(files, file)) return verb.out + "/" + file + " is missing";
    if (verb.records.empty()) return {};
    try {
        const std::vector<std::string> records = comparable(work_ / verb.records);
        if (records.size() != expected.records.size())
            return fmt::format("there are {} records, not {}", records.size(), expected.records.size());
        for (std::size_t i = 0; i < records.size(); ++i)
            if (records[i] != expected.records[i]) return "a record differs: " + records[i] + " from " + expected.records[i];
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::vector<std::string> Sandbox::lostRows(const Verb& verb) const {
    std::set<std::string> there;
    std::vector<std::string> lost;
    if (verb.keeps.empty()) return lost;
    try {
        for (const Record& record : readRecords(work_ / verb.records)) there.insert(record.technique);
    } catch (const Error& error) {
        lost.emplace_back(error.what());
    }
    for (const std::string& row : verb.keeps)
        if (!there.contains(row)) lost.push_back(fmt::format("the record of {} is lost", row));
    return lost;
}

std::string Sandbox::shown(std::string text) const {
    const std::string own = work_.string() + "/";
    for (std::size_t at = text.find(own); at != std::string::npos; at = text.find(own, at)) text.erase(at, own.size());
    return text;
}

} // namespace shadowbench::faults
