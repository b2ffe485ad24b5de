#include "tools/faults/together.h"

#include "base/error.h"
#include "base/files.h"
#include "base/parallel.h"
#include "harness/records/record.h"
#include "harness/runs/merge.h"
#include "tools/faults/sandbox.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mutex>
#include <stop_token>
#include <thread>

namespace shadowbench::faults {
namespace fs = std::filesystem;
namespace {

using Words = std::vector<std::string>;
using Commands = std::vector<Words>;

/// Lines of a file to which every call of a tool adds one.
std::size_t lines(const fs::path& file) {
    const std::string text = fs::exists(file) ? readFile(file) : "";
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class Meeting {
public:
    Meeting(const fs::path& program, int processes, const std::function<void(const std::string&)>& show)
        : sandbox_(program, {}), show_(show) {
        together_.processes = processes;
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

    Together all() {
        runsShareTheirWork();
        everythingAtOnce();
        return std::move(together_);
    }

private:
    static Words run(const std::string& out, const std::string& cache) {
        return {"run",        "--resume",   "--quiet",     "--cost",      "none", "--jobs",      "1",    "--scene",
                "point.toml", "--scene",    "area.toml",   "--technique", "pcf",  "--technique", "pcss", "--technique",
                "external:*", "--external", "engine.toml", "--out",       out,    "--cache",     cache};
    }
    static Words score(int row) {
        return {"score",        "--quiet",
                "--scene",      "point.toml",
                "--image",      "base/images/point/pcf/visibility.exr",
                "--definition", "hard",
                "--name",       fmt::format("row-{}", row),
                "--out",        "rows",
                "--cache",      "cache"};
    }
    static Words gate() {
        return {"gate",
                "--same-program",
                "--quiet",
                "--cost",
                "none",
                "--scene",
                "point.toml",
                "--technique",
                "pcf",
                "--base",
                "base/results.jsonl",
                "--bounds",
                "bounds.toml",
                "--out",
                "gate",
                "--cache",
                "shared-cache"};
    }

    /// The tools' calls for one run, and for many of the same at the same time on one cache and one output.
    void runsShareTheirWork() {
        start({run("alone", "alone-cache")});
        const std::size_t renders = take("renders"), calls = take("calls");
        start(Commands(static_cast<std::size_t>(together_.processes), run("shared", "shared-cache")));
        const std::size_t nowRenders = take("renders"), nowCalls = take("calls");
        note(fmt::format("{} runs of the same cells at once: POV-Ray rendered {} times (one run: {}), another renderer was "
                         "called {} times (one run: {})",
                         together_.processes, nowRenders, renders, nowCalls, calls));
        if (nowRenders != renders || nowCalls != calls) fault("work was done twice");
        if (records("shared") != records("alone")) fault("the records of runs at once are not those of one run");
        check();
    }

    void everythingAtOnce() {
        Commands all;
        for (int i = 0; i < together_.processes; ++i) {
            all.push_back(run("pruned", "shared-cache")); // a folder of its own: the records are not there yet
            all.push_back(score(i));
            all.push_back({"cache", "prune", "--quiet", "--all", "--cache", "shared-cache"});
            if (i % 3 != 0) continue;
            all.push_back(gate());
            all.push_back({"merge", "parts", "--out", "merged"});
            all.push_back({"report", "base/results.jsonl", "--out", "report"});
        }
        start(all);
        const std::size_t rows = records("rows").size(), wanted = static_cast<std::size_t>(together_.processes) + 1;
        note(fmt::format(
            "{} runs, scores and prunes, {} gates, merges and reports at once: {} of {} rows of scores are there",
            together_.processes, (together_.processes + 2) / 3, rows, wanted));
        if (rows != wanted) fault(fmt::format("{} rows of scores are lost", wanted - rows));
        if (records("pruned") != records("alone")) fault("the records of runs beside prunes are not those of one run");
        check();
    }

    /// All at once; meanwhile what they write is read, and must be whole at any moment.
    void start(const Commands& commands) {
        std::size_t reads = 0;
        std::jthread reader([&](const std::stop_token& stop) { // which comes, too, when a command cannot be started
            while (!stop.stop_requested()) {
                for (const char* folder : {"shared", "pruned", "rows", "merged"}) reads += isReadable(folder) ? 1 : 0;
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
        });
        const int count = static_cast<int>(commands.size());
        inParallel(count, count, [&](int i) {
            const Words& words = commands[static_cast<std::size_t>(i)];
            const Ended ended = sandbox_.runPlain(words);
            if (ended.code != 0) fault(fmt::format("{} ended with {}: {}", fmt::join(words, " "), ended.code, ended.errors));
        });
        reader.request_stop();
        reader.join();
        if (count > 1) note(fmt::format("{} times their records were read meanwhile, and were whole", reads));
    }

    bool isReadable(const std::string& folder) {
        const fs::path file = sandbox_.folder() / folder / "results.jsonl";
        if (!fs::exists(file)) return false;
        try {
            (void)readRecords(file);
        } catch (const Error& error) {
            fault(fmt::format("while they wrote, {}", error.what()));
        }
        return true;
    }

    Words records(const std::string& folder) const {
        Words lines;
        for (const Record& record : readRecords(sandbox_.folder() / folder / "results.jsonl"))
            lines.push_back(toJson(shards::withoutTimings(record)));
        return lines;
    }

    /// How often a tool has been called since the last time.
    std::size_t take(const std::string& file) const {
        const std::size_t count = lines(sandbox_.folder() / file);
        fs::remove(sandbox_.folder() / file);
        return count;
    }

    void check() {
        for (const std::string& sentence : sandbox_.damage(false)) fault(sentence);
        for (const std::string& sentence : sandbox_.leftFolders()) fault(sentence);
    }

    void note(const std::string& fact) {
        show_(fact);
        together_.facts.push_back(fact);
    }
    void fault(const std::string& sentence) {
        const std::scoped_lock lock(mutex_);
        together_.faults.push_back(sandbox_.shown(sentence));
        show_("FAULT " + together_.faults.back());
    }

    Sandbox sandbox_;
    const std::function<void(const std::string&)>& show_;
    Together together_;
    std::mutex mutex_;
};

} // namespace

Together workTogether(const fs::path& program, int processes, const std::function<void(const std::string&)>& show) {
    return Meeting(program, processes, show).all();
}

std::string togetherReport(const Together& together, const std::string& command) {
    std::string text = fmt::format("# At the same time\n\n`{}`\n\nVerbs at once on one cache and one output: every one ends "
                                   "with 0, what they write is whole at any moment, no record is lost.\n\n",
                                   command);
    for (const std::string& fact : together.facts) text += "* " + fact + "\n";
    text += "\n## Faults\n\n";
    for (const std::string& fault : together.faults) text += "* " + fault + "\n";
    return together.faults.empty() ? text + "None.\n" : text;
}

} // namespace shadowbench::faults
