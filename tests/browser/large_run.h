// Records of a run that nobody has measured, as large as one may become.
#pragma once

#include "tests/support/report_examples.h"

#include <fmt/format.h>
#include <string>
#include <vector>

namespace shadowbench::browser {

/// Every technique on every scene, with figures that differ from cell to cell.
inline std::vector<Record> largeRun(int techniques, int scenes) {
    constexpr const char* families[] = {"pcf", "vsm", "sm-uniform", "volume-zfail", "pcss"};
    std::vector<Record> records;
    for (int scene = 0; scene < scenes; ++scene)
        for (int technique = 0; technique < techniques; ++technique) {
            const int mixed = (7919 * technique + 104729 * scene) % 997;
            Record& record =
                records.emplace_back(test::hardCell(fmt::format("{}:map={}", families[technique % 5], 16 * (technique + 1)),
                                                    mixed / 3000.0, 0.5 + mixed % 61 / 9.0));
            record.scene = fmt::format("scene-{:02}", scene + 1);
            record.tolerances = {{"mismatch", 0.01}};
        }
    return records;
}

} // namespace shadowbench::browser
