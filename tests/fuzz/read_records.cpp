#include "harness/records/compare.h"
#include "harness/records/record.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"
#include "harness/runs/merge.h"
#include "report/advice.h"
#include "report/cost_report.h"
#include "report/lod_report.h"
#include "report/run_report.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/target.h"

namespace shadowbench::fuzz {

void readResults(std::string_view input) {
    for (const Record& record : readRecords(kept("results.jsonl", input))) {
        const std::string line = toJson(record);
        require(toJson(parseRecord(line)) == line, "a record is another one after it was written and read: " + line);
    }
}

void readManifestLines(std::string_view input) {
    kept("manifest.jsonl", input);
    const std::vector<shards::ManifestCell> cells = shards::readManifest(folder());
    shards::writeManifest(folder(), cells);
    require(shards::readManifest(folder()) == cells, "a manifest is another one after it was written and read");
}

void readMeasuredCell(std::string_view input) {
    const std::string line = shards::text(shards::measuredCell(std::string(input)));
    require(shards::text(shards::measuredCell(line)) == line,
            "a cell is another one after it was written and read: " + line);
}

void readMergedFolder(std::string_view input) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    kept("manifest.jsonl", input.substr(0, end));
    std::filesystem::create_directories(folder() / "cells");
    for (const shards::ManifestCell& cell : shards::readManifest(folder()))
        kept("cells/" + cell.id + ".json", input.substr(end));
    shards::merge({folder()});
}

void readComparedRecords(std::string_view input) {
    const std::vector<Record> records = readRecords(kept("results.jsonl", input));
    const std::size_t half = records.size() / 2;
    gate::compare({records.begin(), records.begin() + static_cast<std::ptrdiff_t>(half)},
                  {records.begin() + static_cast<std::ptrdiff_t>(half), records.end()});
    report::csv(records);
    report::passCsv(records);
    for (const Record& record : records) {
        report::terminalTable(records, record.scene);
        report::markdownTable(records, record.scene);
        report::lodTable(records, record.scene);
        report::passTable(records, record.scene);
        report::adviceFor(records, record.scene);
    }
}

} // namespace shadowbench::fuzz
