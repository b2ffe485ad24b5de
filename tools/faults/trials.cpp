#include "tools/faults/trials.h"

#include "base/files.h"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <set>
#include <sstream>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

bool isDocumented(int code) { return (code >= 0 && code <= 5) || code == 75; }

std::string callOf(const Wanted& wanted) {
    if (wanted.signal == 0)
        return std::string(pointNames.at(static_cast<std::size_t>(wanted.point))) + (wanted.lasting ? ", from then on" : "");
    const char* name = wanted.signal == SIGKILL ? "SIGKILL" : wanted.signal == SIGTERM ? "SIGTERM" : "SIGINT";
    return fmt::format("{} to {}", name, wanted.toFirst ? "the verb" : "the caller");
}

/// The last line that says why; "" if there is none.
std::string lineOf(const Ended& ended) {
    std::string found;
    std::istringstream lines(ended.text);
    for (std::string line; std::getline(lines, line);)
        for (const std::string_view mark : {"shadowbench: ", "error: ", "worth a retry: ", "error, kept for merge: "})
            if (line.starts_with(mark)) found = line;
    const std::size_t unjudged = found.empty() ? ended.text.find("not compared") : ended.text.npos; // a gate's
    return unjudged == ended.text.npos ? found : ended.text.substr(unjudged, ended.text.find('\n', unjudged) - unjudged);
}

/// What the verb that made it makes again of records (base/files.h, writeFileUnflushed).
bool isMadeAgain(const fs::path& file) {
    constexpr std::array kinds{".html", ".css", ".js", ".csv", ".tex", ".md", ".svg", ".pdf", ".png"};
    return std::ranges::find(kinds, file.extension()) != kinds.end();
}

} // namespace

Trial disturb(Sandbox& sandbox, const Verb& verb, const Wanted& wanted, std::uint64_t of) {
    const Ended ended = sandbox.disturbed(verb, wanted);
    Trial trial{.verb = verb.name, .call = callOf(wanted), .number = wanted.number, .of = of, .code = ended.code};
    trial.reached = ended.counts.at(static_cast<std::size_t>(wanted.point)) >= wanted.number;
    const auto fault = [&](const std::string& sentence) { trial.faults.push_back(sandbox.shown(sentence)); };
    const auto hit = std::ranges::find(ended.passed, true, &Passed::isWanted);
    if (hit != ended.passed.end()) trial.what = fmt::format("{} {}", hit->point, hit->path);
    const bool bySignal = wanted.signal != 0 && ended.code == 128 + wanted.signal;
    if (ended.code != 0 && !bySignal) trial.said = sandbox.shown(lineOf(ended));

    if (ended.code < 0)
        fault("it did not end");
    else if (!isDocumented(ended.code) && !bySignal)
        fault(fmt::format("it ended with {}: {}", ended.code, ended.text));
    if (ended.code != 0 && !bySignal && trial.said.empty()) fault("it did not say why: " + ended.text);
    for (const char* word : {"terminate called", "Assertion", "filesystem error", "std::bad_alloc", "basic_"})
        if (ended.text.find(word) != std::string::npos) fault("it said: " + ended.text);
    if (ended.strays > 0) fault(fmt::format("{} processes are left", ended.strays));
    for (const std::string& sentence : sandbox.damage()) fault(sentence);
    if (wanted.signal != SIGKILL) // after which nobody can clear up
        for (const std::string& sentence : sandbox.leftovers()) fault(sentence);
    if (const auto differs = sandbox.difference(verb); ended.code == 0 && differs) fault("it ended with 0, but " + *differs);
    if (ended.code == 0 && wanted.signal == 0 && trial.faults.empty()) return trial;

    const Ended next = sandbox.run(verb.words);
    if (next.code != 0) fault(fmt::format("the next run ended with {}: {}", next.code, next.text));
    if (const auto differs = sandbox.difference(verb)) fault("the next run: " + *differs);
    for (const Texts& sentences : {sandbox.damage(), sandbox.leftovers()})
        for (const std::string& sentence : sentences) fault("after the next run, " + sentence);
    return trial;
}

std::vector<std::uint64_t> spread(std::uint64_t of, std::uint64_t most) {
    std::vector<std::uint64_t> numbers;
    const std::uint64_t wanted = std::min(of, most);
    for (std::uint64_t i = 0; i < wanted; ++i) numbers.push_back(wanted == 1 ? 1 : 1 + i * (of - 1) / (wanted - 1));
    return numbers;
}

void checkOrder(Sandbox& sandbox, const Verb& verb, Findings& findings) {
    int lasting = 0, madeAgain = 0;
    Texts faults;
    std::set<std::string> flushed, named, unflushed; // the last: names in a folder that is not flushed yet
    for (const auto& [point, path, from, isWanted] : sandbox.disturbed(verb, {}).passed) {
        if (path.starts_with('/') || path.starts_with("tmp/")) continue; // beside the sandbox, or removed in the end
        if (point == "fsync") {
            flushed.insert(path);
            std::erase_if(unflushed, [&p = path](const fs::path& name) { return fs::path(p) / name.filename() == name; });
        }
        if (point != "rename") continue;
        named.insert(path);
        const bool isFlushed = flushed.contains(from);
        ++(isFlushed || !isMadeAgain(path) ? lasting : madeAgain);
        if (!isFlushed && isMadeAgain(path)) continue;
        if (!isFlushed) faults.push_back(path + " is renamed before it is flushed");
        unflushed.insert(path);
    }
    for (const std::string& name : unflushed) faults.push_back(name + ": its folder is not flushed after its rename");
    for (const auto& [file, content] : sandbox.files())
        if (!sandbox.before().contains(file) && !named.contains(file)) faults.push_back(file + " is written in place");
    findings.lines.push_back(fmt::format("| {} | {} | {} | {} |", verb.name, lasting, madeAgain, faults.size()));
    for (const std::string& fault : faults) findings.faults.push_back(verb.name + ": " + fault);
}

} // namespace shadowbench::faults
