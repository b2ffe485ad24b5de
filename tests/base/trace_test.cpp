#include "base/trace.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "base/worker_processes.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

/// The array, whole or, as readers take it, without its end.
Json eventsOf(std::string text) {
    if (!text.ends_with("]\n")) text = text.substr(0, text.rfind(',')) + "]";
    return Json::parse(text);
}

auto ofWorkers(const Json& events) {
    return std::ranges::count_if(events, [](const Json& event) { return event["pid"] != getpid(); });
}

void pause(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

/// Two spans, one within the other, for each item.
SharedWork traced(std::size_t items) {
    SharedWork work;
    work.items = items;
    work.work = [](std::size_t item, const Progress&) {
        const std::string row = "row \"" + std::to_string(item) + "\"";
        const Span cell("cell", row, "basic");
        const Span frame("frame", "technique");
        return std::string();
    };
    work.finished = work.lost = [](std::size_t, const std::string&) {};
    return work;
}

TEST(Trace, HoldsTheSpansOfAllProcessesAndItsOwn) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "deeper" / "trace.json";
    {
        const Trace trace(file);
        const Span span("setup", "scenes");
        shareAmongProcesses(3, traced(60));
    }
    const Json events = eventsOf(readFile(file));
    EXPECT_EQ(ofWorkers(events), 2 * 60);
    std::set<std::string> rows;
    std::set<int> workers;
    for (const Json& event : events) {
        EXPECT_EQ(event["ph"], "X");
        EXPECT_GE(event["dur"], 0.0);
        EXPECT_TRUE(event["cat"] == "run" || event["tdur"] >= 0.0);
        if (event["cat"] != "cell") continue;
        EXPECT_EQ(event["args"]["scene"], "basic");
        rows.insert(event["name"]);
        workers.insert(event["pid"].get<int>());
    }
    EXPECT_EQ(rows.size(), 60U);
    EXPECT_TRUE(rows.contains("row \"59\""));
    EXPECT_EQ(workers.count(getpid()), 0U) << "a worker has a pid of its own";
    const Json& run = events.back(); // all others lie in it
    EXPECT_EQ(run["cat"], "run");
    EXPECT_EQ(run["pid"], getpid());
    for (const Json& event : events) {
        EXPECT_GE(event["ts"], run["ts"]);
        EXPECT_LE(event["ts"].get<double>() + event["dur"].get<double>(),
                  run["ts"].get<double>() + run["dur"].get<double>());
    }
}

TEST(Trace, KeepsWholeLinesOfProcessesThatAreKilled) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "trace.json";
    {
        const Trace trace(file);
        SharedWork work = traced(40);
        work.work = [inner = work.work](std::size_t item, const Progress& progress) {
            const Span span("cell", "outer");
            inner(item, progress);
            if (item % 4 == 3) kill(getpid(), SIGKILL);
            return std::string();
        };
        shareAmongProcesses(2, work);
    }
    const Json events = eventsOf(readFile(file));
    EXPECT_EQ(ofWorkers(events), 2 * 40 + 30) << "10 outer spans had not ended";
}

TEST(Trace, OfAProgramThatIsKilledIsReadWithoutItsEnd) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "trace.json";
    SharedWork work;
    work.items = 1;
    work.work = [&](std::size_t, const Progress&) -> std::string {
        const Trace trace(file);
        { const Span span("setup", "scenes"); }
        kill(getpid(), SIGKILL);
        return "";
    };
    work.finished = work.lost = [](std::size_t, const std::string&) {};
    shareAmongProcesses(1, work);
    const std::string text = readFile(file);
    EXPECT_FALSE(text.ends_with("]\n"));
    EXPECT_EQ(eventsOf(text).size(), 1U);
}

TEST(Trace, IsOffBeforeAndAfter) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "trace.json";
    std::optional<Span> before(std::in_place, "setup", "before");
    {
        const Trace trace(file);
        before.reset();
        {
            const Span span("cost", "pause");
            pause(20);
        }
    }
    { const Span after("setup", "after"); }
    const Json events = eventsOf(readFile(file));
    ASSERT_EQ(events.size(), 2U);
    EXPECT_GE(events[0]["dur"], 20'000.0) << "microseconds";
    EXPECT_LT(events[0]["tdur"], 10'000.0) << "it sleeps";
}

TEST(Trace, ThatCannotBeWrittenIsRefused) {
    const TemporaryFolder folder;
    EXPECT_THROW(Trace(folder.path()), BadInput) << "a folder";
    EXPECT_THROW(Trace("/proc/no-folder/trace.json"), BadInput);
}

} // namespace
} // namespace shadowbench
