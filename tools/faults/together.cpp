#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "harness/records/record.h"
#include "tools/faults/trials.h"

#include <algorithm>
#include <fmt/format.h>
#include <mutex>
#include <stop_token>
#include <thread>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

class Meeting {
public:
    explicit Meeting(const fs::path& program) : sandbox_(program, {}) {
        // What is computed twice shows in how often tools are called: POV-Ray, and a renderer that is not ours.
        const fs::path folder = sandbox_.folder();
        writeFile(folder / "bin/povray", fmt::format("#!/bin/sh\ncase \"$*\" in *version*) ;; *) echo x >>{} ;; esac\n"
                                                     "exec /usr/bin/povray \"$@\"\n",
                                                     (folder / "renders").string()));
        fs::permissions(folder / "bin/povray", fs::perms::owner_all);
        writeFile(folder / "engine.toml",
                  "[[renderer]]\nid = \"copy\"\n"
                  "command = '''echo x >>calls; cp base/images/point/pcf/frame-*.exr {out} # {scene}'''\n");
    }

    /// The tools' calls for one run, and for many of the same at the same time on one cache and one output.
    void runsShareTheirWork(int processes) {
        start({run("alone", "alone-cache")});
        const auto renders = callsOf("renders"), calls = callsOf("calls");
        start(Texts(static_cast<std::size_t>(processes), run("shared", "shared-cache")));
        const auto nowRenders = callsOf("renders"), nowCalls = callsOf("calls");
        findings.lines.push_back(fmt::format("{} runs of the same cells at once: POV-Ray rendered {} times (one run: {}), "
                                             "another renderer was called {} times (one run: {})",
                                             processes, nowRenders, renders, nowCalls, calls));
        if (nowRenders != renders || nowCalls != calls) fault("work was done twice");
        if (records("shared") != records("alone")) fault("the records of runs at once are not those of one run");
    }

    void everythingAtOnce(int processes) {
        Texts all;
        for (int i = 0; i < processes; ++i) {
            all.push_back(run("pruned", "shared-cache")); // a folder of its own: the records are not there yet
            all.push_back(fmt::format("score --quiet --scene point.toml --image base/images/point/pcf/visibility.exr "
                                      "--definition hard --cache cache --out rows --name row-{}",
                                      i));
            all.emplace_back("cache prune --quiet --all --cache shared-cache");
            if (i % 3 != 0) continue;
            all.emplace_back("gate --same-program --quiet --cost none --scene point.toml --technique pcf --base "
                             "base/results.jsonl --bounds bounds.toml --out gate --cache shared-cache");
            all.emplace_back("merge parts --out merged");
            all.emplace_back("report base/results.jsonl --out report");
        }
        start(all);
        const std::size_t rows = records("rows").size(), wanted = static_cast<std::size_t>(processes) + 1;
        findings.lines.push_back(
            fmt::format("{} runs, scores and prunes, {} gates, merges and reports at once: {} of {} rows "
                        "of scores are there",
                        processes, (processes + 2) / 3, rows, wanted));
        if (rows != wanted) fault(fmt::format("{} rows of scores are lost", wanted - rows));
        if (records("pruned") != records("alone")) fault("the records of runs beside prunes are not those of one run");
    }

    Findings findings;

private:
    static std::string run(const std::string& out, const std::string& cache) {
        return fmt::format("run --resume --quiet --cost none --jobs 1 --scene point.toml --scene area.toml --technique pcf "
                           "--technique pcss --technique external:* --external engine.toml --out {} --cache {}",
                           out, cache);
    }

    /// All at once; meanwhile what they write is read, and must be whole at any moment.
    void start(const Texts& commands) {
        std::size_t reads = 0;
        std::jthread reader([&](const std::stop_token& stop) { // which comes, too, when a command cannot be started
            while (!stop.stop_requested())
                for (const char* folder : {"shared", "pruned", "rows", "merged"}) reads += isReadable(folder) ? 1 : 0;
        });
        const int count = static_cast<int>(commands.size());
        inParallel(count, count, [&](int i) {
            const std::string& words = commands[static_cast<std::size_t>(i)];
            const Ended ended = sandbox_.run(words);
            if (ended.code != 0) fault(fmt::format("{} ended with {}: {}", words, ended.code, ended.text));
        });
        reader.request_stop();
        reader.join();
        for (const std::string& sentence : sandbox_.leftovers()) fault(sentence);
        if (count > 1)
            findings.lines.push_back(fmt::format("{} times their records were read meanwhile, and were whole", reads));
    }

    bool isReadable(const std::string& folder) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const fs::path file = sandbox_.folder() / folder / "results.jsonl";
        if (!fs::exists(file)) return false;
        try {
            (void)readRecords(file);
        } catch (const Error& error) {
            fault(fmt::format("while they wrote, {}", error.what()));
        }
        return true;
    }

    [[nodiscard]] Texts records(const std::string& folder) const { return sandbox_.files()[folder + "/results.jsonl"]; }

    /// How often a tool has been called since the last time: each call adds a line to its file.
    [[nodiscard]] std::ptrdiff_t callsOf(const std::string& tool) const {
        const fs::path file = sandbox_.folder() / tool;
        const std::string text = fs::exists(file) ? readFile(file) : "";
        fs::remove(file);
        return std::ranges::count(text, '\n');
    }

    void fault(const std::string& sentence) {
        const std::scoped_lock lock(mutex_);
        findings.faults.push_back(sandbox_.shown(sentence));
    }

    Sandbox sandbox_;
    std::mutex mutex_;
};

} // namespace

Findings workTogether(const fs::path& program, int processes) {
    Meeting meeting(program);
    meeting.runsShareTheirWork(processes);
    meeting.everythingAtOnce(processes);
    return std::move(meeting.findings);
}

} // namespace shadowbench::faults
