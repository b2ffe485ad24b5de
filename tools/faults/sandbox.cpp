#include "tools/faults/sandbox.h"

#include "base/descriptor.h"
#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/interrupts.h"
#include "base/launch.h"
#include "groundtruth/store/cache.h"
#include "harness/records/record.h"
#include "harness/runs/merge.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds tick{2};

std::string sceneWith(const std::string& light) {
    return "# A box over a slab.\ntitle = \"Box\"\nsize = [32, 32]\nreference_samples = 16\n"
           "camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }\nlight = " +
           light +
           "\n[timeline]\nstill = 2\nmoving = 1\n"
           "[[object]]\nmesh = { box = { size = [12, 0.2, 12] } }\nplace = [{ at = [0, -0.1, 0] }]\n"
           "[[object]]\nmesh = { box = { size = [1.6, 0.4, 1.2] } }\nplace = [{ at = [0.13, 1.2, 0.21] }]\n";
}

/// Waits for orphans to end, then kills them; how many there were to kill.
int endOrphans(std::chrono::milliseconds patience) {
    const auto end = Clock::now() + patience;
    while (waitpid(-1, nullptr, WNOHANG) >= 0 && Clock::now() < end) std::this_thread::sleep_for(tick);
    std::ifstream list(fmt::format("/proc/self/task/{}/children", gettid()));
    int killed = 0;
    for (pid_t child = 0; list >> child; ++killed) kill(child, SIGKILL);
    while (killed > 0 && waitpid(-1, nullptr, 0) >= 0) {
    }
    return killed;
}

bool isRecords(const std::string& file) { return file.ends_with("results.jsonl") || file.ends_with("sweep.jsonl"); }

/// See Files.
Texts contentOf(const fs::path& file) {
    if (!isRecords(file)) return {fmt::format("{} lines", std::ranges::count(readFile(file), '\n'))};
    Texts lines;
    for (const Record& record : readRecords(file)) lines.push_back(toJson(shards::withoutTimings(record)));
    std::ranges::sort(lines);
    return lines;
}

/// Whether a file is whole, by what its format says of its own end. Throws where a reader of the format says what is
/// damaged.
bool isWhole(const fs::path& file) {
    static const std::map<std::string, std::string> ends{
        {".html", "</html>"}, {".svg", "</svg>"}, {".pdf", "%%EOF"}, {".xml", ">"}};
    const std::string kind = file.extension().string();
    if (kind == ".exr" || kind == ".png") return readChannel(file, 0).size() > 0;
    if (kind == ".ref") return !groundtruth::damage({file.stem().string().substr(0, 32), file, 0, {}});
    std::string text = readFile(file);
    if (kind == ".json" || kind == ".gltf") return nlohmann::json::accept(text);
    if (kind == ".jsonl") { // each line by itself
        std::istringstream lines(text);
        bool whole = text.ends_with('\n');
        for (std::string line; std::getline(lines, line);) whole = whole && nlohmann::json::accept(line);
        return whole;
    }
    text.erase(text.find_last_not_of("\r\n") + 1);
    return !text.empty() && (!ends.contains(kind) || text.ends_with(ends.at(kind)));
}

} // namespace

Sandbox::Sandbox(fs::path program, const std::vector<Verb>& verbs)
    : program_(std::move(program)), work_(fs::canonical(folder_.path()) / "work"),
      kept_(fs::canonical(folder_.path()) / "kept") {
    fs::create_directories(work_ / "tmp");
    writeFile(folder_.path() / "plan", "");
    fs::resize_file(folder_.path() / "plan", sizeof(Plan));
    plan_.reset(mapPlan((folder_.path() / "plan").c_str()));
    if (!plan_) throw InternalError("cannot map a plan of faults");
    writeFile(work_ / "point.toml", sceneWith("{ kind = \"point\", centre = [1.7, 6.1, -2.3] }"));
    writeFile(work_ / "area.toml",
              sceneWith("{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.9, 0, 0], v = [0, 0, 0.9] }"));
    writeFile(work_ / "bounds.toml", "# none\n");
    const auto require = [&](const std::string& words) {
        const Ended ended = run(words);
        if (ended.code != 0)
            throw InternalError(fmt::format("undisturbed, {} ends with {}: {}", words, ended.code, ended.text));
    };
    const std::string pcf = "run --quiet --cost none --scene point.toml --cache cache --technique pcf ";
    require(pcf + "--technique sm-uniform --images --out base");
    require(pcf + "--out half");
    require(pcf + "--technique sm-uniform --shard 1/1 --out parts");
    require("score --quiet --scene point.toml --image base/images/point/pcf/visibility.exr --definition hard --name earlier "
            "--cache cache --out rows");
    fs::copy(work_, kept_, fs::copy_options::recursive);
    before_ = files();
    for (const Verb& verb : verbs) {
        reset();
        require(verb.words);
        expected_[verb.name] = files();
    }
    reset();
}

void Sandbox::reset() const {
    fs::remove_all(work_);
    fs::copy(kept_, work_, fs::copy_options::recursive);
}

Ended Sandbox::disturbed(const Verb& verb, const Wanted& wanted) {
    reset();
    new (plan_.get()) Plan{.wanted = wanted};
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    Texts variables{fmt::format("{}={}", variable, (folder_.path() / "plan").string())};
    if (wanted.point == Point::Allocation) variables.emplace_back("LD_PRELOAD=" FAILING_NEW);
    Ended ended = run(verb.words, variables);
    ended.strays = endOrphans(patience);
    std::ranges::copy(plan_->counts, ended.counts.begin());
    if (plan_->logged > plan_->log.size()) throw InternalError(verb.name + " comes to more points than a plan has room for");
    std::istringstream lines(std::string(plan_->log.data(), plan_->logged));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::string point, in, path, from;
        for (std::string* field : {&point, &in, &path, &from}) std::getline(fields, *field, '\t');
        const bool isWanted = point.starts_with('!');
        const auto whole = [&](const std::string& p) { return shown((fs::path(in) / p).lexically_normal()); };
        ended.passed.push_back({point.substr(isWanted ? 1 : 0), whole(path), whole(from), isWanted});
    }
    return ended;
}

Ended Sandbox::run(const std::string& words, const Texts& variables) const {
    Command command{.program = program_, .arguments = {}, .folder = work_};
    std::istringstream stream(words);
    for (std::string word; stream >> word;) command.arguments.push_back(word);
    command.cpuLimit.reset();
    command.openFiles.reset();
    command.memoryLimit.reset();
    const char* path = std::getenv("PATH");
    command.environment =
        Texts{"HOME=" + work_.string(), "TMPDIR=" + (work_ / "tmp").string(), "LC_ALL=C",
              fmt::format("PATH={}:{}", (work_ / "bin").string(), path != nullptr ? path : "/usr/bin:/bin")};
    command.environment->insert(command.environment->end(), variables.begin(), variables.end());
    const Launch launch(command);
    const Descriptor output(memfd_create("output", MFD_CLOEXEC));
    // Not runProcess: it kills the whole group in the end, and so would hide a process that is left.
    const pid_t pid = start(launch, openNothing().get(), output.get(), output.get());
    int status = 0;
    bool late = false;
    const auto end =
        Clock::now() + std::chrono::minutes(variables.empty() ? 30 : 5); // of many at once, most wait for others
    while (waitpid(pid, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(tick);
        if (late || (Clock::now() < end && !DeferredInterrupts::pending())) continue;
        late = true;
        kill(-pid, SIGKILL);
    }
    if (DeferredInterrupts::pending()) throw Inconclusive("the trials were interrupted");
    const Finished finished = decoded(status);
    Ended ended{.code = late ? -1 : finished.signal != 0 ? 128 + finished.signal : finished.exitCode};
    ended.text.resize(static_cast<std::size_t>(lseek(output.get(), 0, SEEK_END)));
    if (pread(output.get(), ended.text.data(), ended.text.size(), 0) < 0)
        throw InternalError("cannot read what was printed");
    return ended;
}

Files Sandbox::files() const {
    Files files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(work_)) {
        const std::string file = entry.path().lexically_relative(work_).string();
        const bool isOurs = !file.starts_with("tmp/") && !file.starts_with("cache/shaders/"); // the latter are Mesa's
        if (!entry.is_regular_file() || isTemporary(file) || !isOurs) continue;
        try {
            files[file] = contentOf(entry.path());
        } catch (const Error& error) {
            files[file] = {error.what()};
        }
    }
    return files;
}

Texts Sandbox::leftovers() const {
    Texts left;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(work_)) {
        const std::string file = entry.path().lexically_relative(work_).string();
        if (file.starts_with("tmp/") || isTemporary(file)) left.push_back(file + " is left");
    }
    return left;
}

Texts Sandbox::damage() const {
    Texts sentences;
    const Files now = files();
    for (const auto& [file, content] : now) try {
            if (!isWhole(work_ / file)) sentences.push_back(file + " is partial");
        } catch (const Error& error) {
            sentences.push_back(fmt::format("{} is partial: {}", file, error.what()));
        }
    for (const auto& [file, content] : before_)
        if (isRecords(file) && (!now.contains(file) || !std::ranges::includes(now.at(file), content)))
            sentences.push_back("a record of " + file + " is lost");
    return sentences;
}

std::optional<std::string> Sandbox::difference(const Verb& verb) const {
    const Files now = files();
    for (const auto& [file, content] : expected_.at(verb.name)) {
        if (!file.starts_with(verb.out())) continue; // what is kept in the cache may be kept by another name
        if (!now.contains(file)) return file + " is missing";
        if (now.at(file) != content)
            return fmt::format("{} is \"{}\" and should be \"{}\"", file, fmt::join(now.at(file), " "),
                               fmt::join(content, " "));
    }
    return {};
}

std::string Sandbox::shown(std::string text) const {
    const std::string own = work_.string() + "/";
    for (std::size_t at = text.find(own); at != std::string::npos; at = text.find(own, at)) text.erase(at, own.size());
    return text;
}

} // namespace shadowbench::faults
