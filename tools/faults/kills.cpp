#include "tools/faults/kills.h"

#include <array>
#include <csignal>
#include <fmt/format.h>

namespace shadowbench::faults {
namespace {

/// Not while the loader looks for libraries: nothing of ours has begun.
bool isMoment(const Call& call) {
    return !call.path.starts_with("/usr/") && !call.path.starts_with("/lib") && !call.path.starts_with("/etc/");
}

std::string_view nameOf(int signal) {
    switch (signal) {
    case SIGKILL:
        return "SIGKILL";
    case SIGTERM:
        return "SIGTERM";
    default:
        return "SIGINT";
    }
}

} // namespace

std::uint64_t countMoments(Sandbox& sandbox, const Verb& verb) {
    sandbox.reset();
    std::uint64_t count = 0;
    (void)sandbox.run(verb, [&](const Call& call, pid_t) {
        if (isMoment(call)) ++count;
        return Decision{};
    });
    return count;
}

Kill drawKill(std::mt19937& random, std::uint64_t moments) {
    constexpr std::array signals{SIGKILL, SIGKILL, SIGTERM, SIGINT};
    const int signal = signals[random() % signals.size()]; // NOLINT: below its size
    const bool child = random() % 2 == 1;
    return {signal, child, 1 + random() % moments};
}

Trial killAt(Sandbox& sandbox, const Verb& verb, const Kill& kill, std::uint64_t moments) {
    sandbox.reset();
    Trial trial{.verb = verb.name,
                .call = fmt::format("{} to {}", nameOf(kill.signal), kill.child ? "the caller" : "the verb"),
                .number = kill.at,
                .of = moments,
                .what = {},
                .said = {},
                .faults = {}};
    const auto fault = [&](const std::string& sentence) { trial.faults.push_back(sandbox.shown(sentence)); };
    std::uint64_t count = 0;
    bool itself = false;
    const Ended ended = sandbox.run(verb, [&](const Call& call, pid_t root) {
        if (!isMoment(call) || ++count != kill.at) return Decision{};
        trial.what = fmt::format("{} {}", name(call.kind), sandbox.shown(call.path));
        itself = !kill.child || call.process == root;
        return Decision{.error = 0, .signal = kill.signal, .whom = kill.child ? call.process : root};
    });
    trial.code = ended.code;
    if (ended.late) fault("it did not end");
    if (ended.strays > 0) fault(fmt::format("{} processes are left", ended.strays));
    const bool bySignal = ended.code == 128 + kill.signal;
    if (itself ? !bySignal && ended.code != 0 : ended.code >= 128)
        fault(fmt::format("it ended with {}: {}", ended.code, ended.errors));
    if (!itself && ended.code != 0 && ended.errors.empty() && ended.output.empty()) fault("it did not say why");
    const bool cleans = kill.signal != SIGKILL; // what cannot be caught leaves what the next run removes
    for (const std::string& sentence : sandbox.damage(!cleans)) fault(sentence);
    if (cleans)
        for (const std::string& sentence : sandbox.leftFolders()) fault(sentence);
    for (const std::string& sentence : sandbox.lostRows(verb)) fault(sentence);

    const Ended next = sandbox.runPlain(verb.arguments);
    if (next.code != 0) fault(fmt::format("the next run ended with {}: {}", next.code, next.errors));
    if (const auto differs = sandbox.difference(verb)) fault("the next run: " + *differs);
    for (const std::string& sentence : sandbox.damage(false)) fault("after the next run, " + sentence);
    return trial;
}

} // namespace shadowbench::faults
