// Where the time of a run goes, as `run --trace` writes it.
#include "tests/support/program.h"

#include "base/files.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

struct Event {
    std::string name, category;
    double start = 0, end = 0;
    int process = 0;
};

std::vector<Event> eventsIn(const std::string& file) {
    std::vector<Event> events;
    for (const auto& event : nlohmann::json::parse(readFile(file))) {
        const double start = event["ts"], duration = event["dur"];
        events.push_back({event["name"], event["cat"], start, start + duration, event["pid"]});
    }
    return events;
}

/// Whether `inner` lies in `outer`. Times are written to the nanosecond.
bool isIn(const Event& inner, const Event& outer) {
    constexpr double rounding = 0.002; // microseconds
    return inner.start >= outer.start - rounding && inner.end <= outer.end + rounding;
}

bool areApart(const Event& a, const Event& b) { return a.end <= b.start || b.end <= a.start; }

/// Those that say what is done: neither the run nor a cell as a whole.
std::vector<Event> phases(std::vector<Event> events) {
    std::erase_if(events, [](const Event& event) { return event.category == "run" || event.category == "cell"; });
    return events;
}

/// Microseconds in which at least one of them runs.
double covered(std::vector<Event> events) {
    std::ranges::sort(events, {}, &Event::start);
    double sum = 0, until = 0;
    for (const Event& event : events) {
        sum += std::max(0.0, event.end - std::max(event.start, until));
        until = std::max(until, event.end);
    }
    return sum;
}

class TracedRun : public testing::Test {
protected:
    Outcome run(const std::string& options) {
        return shell("shadowbench run --cost none --quiet --trace " + file_ + " --scene " +
                     folder_.write("tiny.toml", tinyScene()) + " --out " + (folder_ / "out") + " --cache " +
                     folder_.cache() + options);
    }

    Folder folder_;
    std::string file_ = folder_ / "trace.json";
};

TEST_F(TracedRun, NamesWhatTakesAtLeastNineTenthsOfItsTime) {
    const Outcome outcome = run(" --jobs 1 --technique pcf --technique sm-cascaded --technique volume-zfail");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Event> events = eventsIn(file_);
    const Event& whole = events.back();
    EXPECT_EQ(whole.name, "run");
    EXPECT_GE(covered(phases(events)), 0.9 * (whole.end - whole.start));
}

TEST_F(TracedRun, HasCellsOfSeveralWorkersInWhichAllElseNests) {
    const Outcome outcome = run(" --jobs 2 --neighbours --technique pcf --technique 'sm-*'");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Event> events = eventsIn(file_);
    std::map<std::string, std::set<std::string>> names; // by category
    std::set<int> workers;
    for (const Event& event : events) {
        names[event.category].insert(event.name);
        if (event.category == "cell") workers.insert(event.process);
        EXPECT_TRUE(isIn(event, events.back())) << event.name;
        for (const Event& other : events) {
            const bool nests = areApart(event, other) || isIn(event, other) || isIn(other, event);
            EXPECT_TRUE(other.process != event.process || nests) << event.name << " and " << other.name;
        }
    }
    EXPECT_EQ(workers.size(), 2U);
    EXPECT_FALSE(workers.contains(events.back().process));
    EXPECT_TRUE(names["cell"].contains("pcf"));
    EXPECT_TRUE(names["setup"].contains("gl/gbuffer.frag")) << "its program";
    EXPECT_TRUE(names["truth fetched"].contains("hard"));
    for (const char* category : {"frame", "metrics", "extra", "files"}) EXPECT_FALSE(names[category].empty()) << category;
}

TEST_F(TracedRun, TellsTruthsThatAreComputed) {
    const std::string empty = " --technique none --cache " + (folder_ / "empty");
    const Outcome outcome = shell("shadowbench run --cost none --quiet --jobs 1 --trace " + file_ + " --scene " +
                                  folder_.write("tiny.toml", tinyScene()) + " --out " + (folder_ / "out") + empty);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    std::set<std::string> categories;
    for (const Event& event : eventsIn(file_)) categories.insert(event.category);
    EXPECT_TRUE(categories.contains("truth computed"));
    EXPECT_TRUE(categories.contains("truth fetched")) << "by the process that scores the cell";
}

TEST_F(TracedRun, CannotWriteIntoAFolder) {
    file_ = folder_ / "";
    const Outcome outcome = run(" --technique none");
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("cannot write the trace"), std::string::npos) << outcome.output;
}

} // namespace
} // namespace shadowbench
