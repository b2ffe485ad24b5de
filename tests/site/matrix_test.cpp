// The table of every technique on every scene.
#include "site/matrix.h"

#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

constexpr std::size_t cost = 2; // the column

/// Its cost as measured here, and milliseconds on a card.
Record modelledCell(const std::string& variant, double ratio, double milliseconds) {
    Record record = hardCell(variant, 0.01, ratio);
    record.modelled["gtx-1080@1920x1080"] = {milliseconds, milliseconds / 2, 2 * milliseconds, false, {}, {}};
    return record;
}

std::string costOf(const site::Table& table, std::size_t row) { return table.rows[row].cells[cost].text; }

TEST(Matrix, CostsAreMultiplesOfTheUniformMapAsMeasuredHere) {
    const std::vector<Record> records{hardCell("sm-uniform", 0.02, 1), hardCell("pcf", 0.01, 1.5)};
    const site::Table table = site::matrixTable(records, {}, "all");
    EXPECT_EQ(costOf(table, 0), "1.00");
    EXPECT_EQ(costOf(table, 1), "1.50");
    EXPECT_NE(table.columns[cost].hint.find("measured here"), std::string::npos);
}

TEST(Matrix, CostsAreMultiplesOfTheUniformMapOnTheCardThatIsModelled) {
    const std::vector<Record> records{modelledCell("sm-uniform", 1, 0.5), modelledCell("pcf", 1.5, 0.6),
                                      hardCell("vsm", 0.01, 2)};
    const site::Table table = site::matrixTable(records, {}, "all");
    EXPECT_EQ(costOf(table, 0), "1.00");
    EXPECT_EQ(costOf(table, 1), "1.20");
    EXPECT_EQ(costOf(table, 2), "–") << "never beside what was measured here";
    EXPECT_NE(table.columns[cost].hint.find("modelled on gtx-1080 at 1920×1080"), std::string::npos);
}

} // namespace
} // namespace shadowbench
