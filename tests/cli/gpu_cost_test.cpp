// `gpu-cost` as a user types it, on records that were measured on a card.
#include "tests/support/program.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

class GpuCostVerb : public testing::Test {
protected:
    void SetUp() override {
        const Outcome outcome = shell("shadowbench shader-cost --quiet --technique none --cache " + folder_ / "cache" +
                                      " --out " + folder_ / "shaders");
        if (outcome.code == 5) GTEST_SKIP() << outcome.output;
    }

    [[nodiscard]] Outcome asked(const std::string& words) const {
        return shell("shadowbench gpu-cost --quiet " + words + " --cache " + folder_ / "cache" + " --out " +
                     folder_ / "out");
    }

    /// The published record of a variant on `simple`.
    [[nodiscard]] std::string recordOf(const std::string& variant) const {
        std::ifstream file(SOURCE_FOLDER "/results/gpu/results.jsonl");
        for (std::string line; std::getline(file, line);) {
            const auto record = nlohmann::json::parse(line);
            if (record["scene"] == "simple" && record["variant"] == variant) return line + "\n";
        }
        throw std::runtime_error("results/gpu has no record of " + variant);
    }

    [[nodiscard]] std::vector<nlohmann::json> lines() const {
        std::vector<nlohmann::json> all;
        std::ifstream file(folder_ / "out/gpu-cost.jsonl");
        for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }

    Folder folder_;
};

TEST_F(GpuCostVerb, ModelsAFrameOnACardNearWhatWasMeasuredThere) {
    const std::string records = folder_.write("results.jsonl", recordOf("sm-uniform") + recordOf("pcf:kernel=7"));
    const Outcome outcome = asked(records + " --card h200 --size 1280x720");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("simple at 1280×720 on NVIDIA H200, modelled"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("Modelled against measured"), std::string::npos) << outcome.output;
    const auto all = lines();
    ASSERT_EQ(all.size(), 6U) << "two techniques, on the size that was asked for and on the two that were measured";
    for (const auto& line : all) {
        const double modelled = line["modelled_ms"];
        EXPECT_LT(line["least_ms"], modelled);
        EXPECT_GT(line["most_ms"], modelled);
        if (!line.contains("measured_ms")) continue;
        const double ratio = modelled / line["measured_ms"].get<double>();
        EXPECT_GT(ratio, 0.7) << line;
        EXPECT_LT(ratio, 1.4) << line;
    }
}

TEST_F(GpuCostVerb, AllCardsAreModelledUnlessOneIsNamed) {
    const std::string records = folder_.write("results.jsonl", recordOf("sm-uniform"));
    ASSERT_EQ(asked(records).code, 0);
    std::vector<std::string> cards;
    for (const auto& line : lines())
        if (!line.contains("measured_ms")) cards.push_back(line["card"]);
    EXPECT_EQ(cards, (std::vector<std::string>{"geforce-7600-gt", "gtx-1080", "h200", "rtx-2080-ti", "rx-6800-xt"}));
}

TEST_F(GpuCostVerb, WhatReadsBackWaitsForTheProgram) {
    const Outcome outcome = asked(folder_.write("results.jsonl", recordOf("sm-tiled")) + " --card h200");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("waits for the program"), std::string::npos) << outcome.output;
    EXPECT_EQ(lines().at(0)["waits_for_program"], true);
}

TEST_F(GpuCostVerb, WhatIsWrongIsNamedWithARemedy) {
    const std::string records = folder_.write("results.jsonl", recordOf("sm-uniform"));
    const Outcome card = asked(records + " --card h20");
    EXPECT_EQ(card.code, 2);
    EXPECT_NE(card.output.find("h200"), std::string::npos) << card.output;
    for (const char* size : {"1920", "0x100", "1920x", "x1080", "axb", "1920x1080x2", "20000x100"}) {
        const Outcome outcome = asked(records + " --size " + size);
        EXPECT_EQ(outcome.code, 2) << size;
        EXPECT_NE(outcome.output.find("write it as 1920x1080"), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(asked("").code, 2);
    EXPECT_EQ(asked(folder_ / "missing.jsonl").code, 2);
    EXPECT_EQ(asked(folder_.write("empty.jsonl", "")).code, 2);
}

} // namespace
} // namespace shadowbench
