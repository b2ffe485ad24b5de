// A run of a few cells and its site, made once for all tests of a program.
#pragma once

#include "base/error.h"
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::browser {

/// A scene of 48² pixels with one moving frame, four techniques.
class TinyRun {
public:
    TinyRun() {
        const std::string scene = folder_.write("tiny.toml", tinyScene());
        const Outcome run = shell("shadowbench run --quiet --cost none --scene " + scene +
                                  " --technique sm-uniform:map=64 --technique pcf:map=64 --technique volume-zfail"
                                  " --technique none --cache /tmp/shadowbench-test-references --out " +
                                  folder_ / "run");
        if (run.code != 0) throw InternalError("the run for the tests of the pages failed: " + run.output);
    }

    [[nodiscard]] std::filesystem::path folder() const { return folder_ / "run"; }
    [[nodiscard]] std::filesystem::path images() const { return folder() / "images"; }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(folder() / "results.jsonl"); }

private:
    Folder folder_;
};

inline const TinyRun& tinyRun() {
    static const TinyRun run;
    return run;
}

} // namespace shadowbench::browser
