// A gate on stand-ins for base and head, which score the same unless a test says otherwise.
#pragma once

#include "base/error.h"
#include "base/temporary_folder.h"
#include "gate/gate.h"
#include "tests/gate/programs/stand_in.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

namespace shadowbench::gate {

class GateOfStandIns : public testing::Test {
protected:
    GateOfStandIns() {
        writeFile(path("tiny.toml"), standInScene());
        bounds("");
        options_.base = base_.program();
        options_.head = head_.program();
        options_.scenes = {path("tiny.toml")};
        options_.techniques = {"pcf"};
        options_.bounds = path("bounds.toml");
        options_.out = path("out");
        options_.cache = path("cache");
        options_.instructions = options_.time = options_.shader = false;
        options_.quiet = true;
        head_.measures({headRecord()});
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
    void bounds(const std::string& text) const { writeFile(path("bounds.toml"), text); }
    /// A file of records as the base.
    void compareWith(const std::vector<Record>& records) {
        writeRecords(path("records/results.jsonl"), records);
        options_.base = path("records");
    }
    /// Of another commit than the base's.
    static Record headRecord(const std::string& variant = "pcf", std::uint32_t seed = 1) {
        Record record = standInRecord(variant, seed);
        record.commit = "decaf";
        return record;
    }
    static Record leaking(Record record, double leak = 0.1) {
        record.values["accuracy.leak"] = leak;
        record.images = std::to_string(leak);
        return record;
    }
    [[nodiscard]] std::string complaint() const {
        try {
            (void)gate(options_);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    }

    TemporaryFolder folder_;
    StandIn base_{folder_.path(), "base"}, head_{folder_.path(), "head"};
    GateOptions options_;
};

inline std::string all(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += sentence + "\n";
    return text;
}

inline bool has(const std::vector<std::string>& sentences, const std::string& part) {
    return all(sentences).find(part) != std::string::npos;
}

/// The sentences of what was not compared, a line each.
inline std::string notCompared(const GateResult& result) {
    std::string text = all(result.notCompared);
    for (const Change& change : result.changes)
        if (change.direction == Direction::NotCompared) text += change.sentence + "\n";
    return text;
}

inline std::vector<Change> of(const GateResult& result, const std::string& metric) {
    std::vector<Change> changes;
    std::ranges::copy_if(result.changes, std::back_inserter(changes), [&](const Change& c) { return c.metric == metric; });
    return changes;
}

} // namespace shadowbench::gate
