// What to ship, from records of several scenes.
#include "site/ship.h"

#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

/// On two scenes under a light without area, whose tolerance is half a per cent.
std::vector<Record> twoScenes() {
    std::vector<Record> records;
    const auto add = [&](const std::string& scene, const std::string& variant, double mismatch, double milliseconds) {
        Record record = hardCell(variant, mismatch, 1);
        record.scene = scene;
        record.modelled["gtx-1080@1920x1080"] = {milliseconds, milliseconds / 2, 2 * milliseconds, false, {}, {}};
        records.push_back(record);
    };
    for (const char* scene : {"first", "second"}) {
        add(scene, "sm-uniform", 0.05, 1);
        add(scene, "pcf", 0.04, 1.1);
    }
    add("first", "sm-lispsm", 0.001, 1.2);
    add("second", "sm-lispsm", 0.02, 1.2);
    for (const char* scene : {"first", "second"}) {
        add(scene, "sm-cascaded", 0.002, 1.8);
        add(scene, "sm-focused", 0.001, 1.9);
        add(scene, "volume-zpass", 0, 6);
    }
    return records;
}

std::vector<std::string> column(const site::Table& table, std::size_t index) {
    std::vector<std::string> texts;
    for (const site::Row& row : table.rows) texts.push_back(row.cells[index].text);
    return texts;
}

TEST(Ship, IsTheCheapestOfThoseWithinToleranceOnMostScenesForEachCost) {
    const site::Table table = site::shipTable(twoScenes(), {});
    EXPECT_EQ(column(table, 1), (std::vector<std::string>{"1.25 ×", "2 ×"}));
    EXPECT_EQ(column(table, 2), (std::vector<std::string>{"sm-lispsm", "sm-cascaded"}));
    EXPECT_EQ(column(table, 3), (std::vector<std::string>{"1 of 2", "2 of 2"}));
    EXPECT_EQ(column(table, 5)[0], "second 4.0 ×");
    EXPECT_EQ(column(table, 5)[1], "–");
}

TEST(Ship, HasNoLinesWhereNoCostIsKnown) {
    std::vector<Record> records = twoScenes();
    for (Record& record : records) {
        record.modelled.clear();
        clear(record, "cost");
    }
    EXPECT_TRUE(site::shipTable(records, {}).rows.empty());
}

} // namespace
} // namespace shadowbench
