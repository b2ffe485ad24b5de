#include "tools/faults/failing_calls.h"

#include "base/files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sstream>
#include <unistd.h>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

/// What each call fails with: a full disk, a broken one, too many processes or files.
int errorOf(Kind kind) {
    switch (kind) {
    case Kind::Open:
    case Kind::Pipe:
        return EMFILE;
    case Kind::Write:
        return ENOSPC;
    case Kind::Rename:
    case Kind::Fsync:
        return EIO;
    case Kind::Fork:
    case Kind::Thread:
        return EAGAIN;
    }
    return EIO;
}

bool isDocumented(int code) { return (code >= 0 && code <= 5) || code == 75; }

/// The line that says why; "" if there is none.
std::string lineOf(const Ended& ended) {
    std::istringstream lines(ended.errors);
    std::string found;
    for (std::string line; std::getline(lines, line);)
        for (const std::string_view start : {"shadowbench: ", "error: ", "worth a retry: ", "error, kept for merge: "})
            if (line.starts_with(start)) found = line;
    if (!found.empty()) return found;
    std::istringstream printed(ended.output); // a gate says what it could not judge
    for (std::string line; std::getline(printed, line);)
        if (line.find("not compared") != std::string::npos) found = line;
    return found;
}

/// What a run that was disturbed, but not killed, should not do.
void judge(const Sandbox& sandbox, const Verb& verb, const Ended& ended, Trial& trial) {
    const auto fault = [&](const std::string& sentence) { trial.faults.push_back(sandbox.shown(sentence)); };
    trial.code = ended.code;
    trial.said = ended.code == 0 ? "" : sandbox.shown(lineOf(ended));
    if (ended.late) fault("it did not end");
    if (!isDocumented(ended.code)) fault(fmt::format("it ended with {}: {}", ended.code, ended.errors));
    if (ended.code != 0 && trial.said.empty()) fault("it did not say why: " + ended.errors);
    for (const char* word : {"terminate called", "Assertion", "filesystem error", "std::bad_alloc", "basic_"})
        if (ended.errors.find(word) != std::string::npos) fault("it said: " + ended.errors);
    if (ended.strays > 0) fault(fmt::format("{} processes are left", ended.strays));
    for (const std::string& sentence : sandbox.damage(false)) fault(sentence);
    for (const std::string& sentence : sandbox.leftFolders()) fault(sentence);
    for (const std::string& sentence : sandbox.lostRows(verb)) fault(sentence);
    if (ended.code == 0)
        if (const auto differs = sandbox.difference(verb)) fault("it ended with 0, but " + *differs);
}

/// The next run, undisturbed, goes on.
void judgeNext(const Sandbox& sandbox, const Verb& verb, Trial& trial) {
    const auto fault = [&](const std::string& sentence) {
        trial.faults.push_back(sandbox.shown("the next run: " + sentence));
    };
    const Ended next = sandbox.runPlain(verb.arguments);
    if (next.code != 0) fault(fmt::format("it ended with {}: {}", next.code, next.errors));
    if (const auto differs = sandbox.difference(verb)) fault(*differs);
    for (const std::string& sentence : sandbox.damage(false)) fault(sentence);
}

Trial judged(const Sandbox& sandbox, const Verb& verb, const Ended& ended, Trial trial) {
    judge(sandbox, verb, ended, trial);
    if (trial.code != 0 || !trial.faults.empty()) judgeNext(sandbox, verb, trial);
    return trial;
}

Decision goOn(const Call& /*call*/, pid_t /*root*/) { return {}; }

} // namespace

bool isOwn(const Call& call) {
    if (!call.byProgram) return false;
    if (call.kind == Kind::Write && call.descriptor == STDERR_FILENO) return false;
    for (const std::string_view system : {"/usr/", "/lib", "/etc/", "/sys/", "/dev/dri", "/proc/"})
        if (call.path.starts_with(system)) return false;
    return call.path.find("/cache/shaders") == std::string::npos;
}

std::map<Kind, std::uint64_t> countCalls(Sandbox& sandbox, const Verb& verb) {
    sandbox.reset();
    std::map<Kind, std::uint64_t> counts;
    (void)sandbox.run(verb, [&](const Call& call, pid_t) {
        if (isOwn(call)) ++counts[call.kind];
        return Decision{};
    });
    return counts;
}

Trial failCall(Sandbox& sandbox, const Verb& verb, Kind kind, std::uint64_t number, std::uint64_t of, bool lasting) {
    sandbox.reset();
    Trial trial{.verb = verb.name,
                .call = std::string(name(kind)),
                .number = number,
                .of = of,
                .what = {},
                .said = {},
                .faults = {}};
    std::uint64_t count = 0;
    const Ended ended = sandbox.run(verb, [&](const Call& call, pid_t) {
        if (call.kind != kind || !isOwn(call) || ++count < number || (count > number && !lasting)) return Decision{};
        if (count == number) trial.what = sandbox.shown(call.path);
        return Decision{.error = errorOf(kind)};
    });
    if (lasting) trial.call += ", from then on";
    return judged(sandbox, verb, ended, std::move(trial));
}

std::optional<Trial> failAllocation(Sandbox& sandbox, const Verb& verb, std::uint64_t number) {
    sandbox.reset();
    const fs::path counter = sandbox.folder().parent_path() / "count";
    writeFile(counter, std::string(sizeof(std::uint64_t), '\0'));
    const Ended ended = sandbox.run(verb, goOn,
                                    {"LD_PRELOAD=" FAILING_NEW, fmt::format("SHADOWBENCH_FAIL_NEW={}", number),
                                     "SHADOWBENCH_NEW_COUNT=" + counter.string()});
    std::uint64_t count = 0;
    std::memcpy(&count, readFile(counter).data(), sizeof count);
    if (count < number) return {};
    Trial trial{.verb = verb.name, .call = "allocation", .number = number, .of = 0, .what = {}, .said = {}, .faults = {}};
    return judged(sandbox, verb, ended, std::move(trial));
}

std::vector<std::uint64_t> spread(std::uint64_t of, std::uint64_t most) {
    std::vector<std::uint64_t> numbers;
    const std::uint64_t wanted = std::min(of, most);
    for (std::uint64_t i = 0; i < wanted; ++i) numbers.push_back(wanted == 1 ? 1 : 1 + i * (of - 1) / (wanted - 1));
    return numbers;
}

} // namespace shadowbench::faults
