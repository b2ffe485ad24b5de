// `gpu-cost` as a user types it, on records that were measured on a card.
#include "tests/support/program.h"

#include <fmt/format.h>
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
        const Outcome outcome = shell("shadowbench shader-cost --quiet --technique none --cache " + folder_.cache() +
                                      " --out " + folder_ / "shaders");
        if (outcome.code == 5) GTEST_SKIP() << outcome.output;
    }

    [[nodiscard]] Outcome asked(const std::string& words) const {
        return shell("shadowbench gpu-cost --quiet " + words + " --cache " + folder_.cache() + " --out " + folder_ / "out");
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

    /// The records that were written.
    [[nodiscard]] std::vector<nlohmann::json> written() const {
        std::vector<nlohmann::json> all;
        std::ifstream file(folder_ / "out/results.jsonl");
        for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
        return all;
    }

    /// Cards and sizes of the first.
    [[nodiscard]] std::vector<std::string> modelled() const {
        const nlohmann::json first = written().at(0)["cost"]["gpu"];
        std::vector<std::string> names;
        for (const auto& [name, cost] : first.items()) names.push_back(name);
        return names;
    }

    Folder folder_;
};

TEST_F(GpuCostVerb, ModelsAFrameOnACardNearWhatWasMeasuredThere) {
    const std::string records = folder_.write("results.jsonl", recordOf("sm-uniform") + recordOf("pcf:kernel=7"));
    const Outcome outcome = asked(records + " --card h200 --size 1280x720");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("simple at 1280×720 on NVIDIA H200, modelled"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("Modelled against measured"), std::string::npos) << outcome.output;
    const auto all = written();
    ASSERT_EQ(all.size(), 2U);
    for (const auto& record : all) {
        const auto& modelled = record["cost"]["gpu"];
        EXPECT_EQ(modelled.size(), 3U) << "the size that was asked for and the two that were measured";
        EXPECT_LT(modelled["h200@1280x720"]["least"], modelled["h200@1280x720"]["milliseconds"]);
        EXPECT_GT(modelled["h200@1280x720"]["most"], modelled["h200@1280x720"]["milliseconds"]);
        for (const auto& device : record["cost"]["device"]) {
            const int side = device["size"][0];
            const double ratio = modelled[fmt::format("h200@{}x{}", side, side)]["milliseconds"].get<double>() /
                                 device["median"].get<double>();
            EXPECT_GT(ratio, 0.7) << record;
            EXPECT_LT(ratio, 1.4) << record;
        }
    }
}

TEST_F(GpuCostVerb, ASizeThatWasMeasuredIsModelledOnce) {
    const Outcome outcome =
        asked(folder_.write("results.jsonl", recordOf("sm-uniform")) + " --card h200 --size 1024x1024 --size 2048x2048");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(modelled(), (std::vector<std::string>{"h200@1024x1024", "h200@2048x2048"}));
    const std::string title = "simple at 1024×1024 on NVIDIA H200, modelled";
    ASSERT_NE(outcome.output.find(title), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find(title), outcome.output.rfind(title)) << outcome.output;
}

TEST_F(GpuCostVerb, RecordsMayTakeTheirOwnPlace) {
    ASSERT_EQ(asked(folder_.write("results.jsonl", recordOf("sm-uniform")) + " --card gtx-1080").code, 0);
    ASSERT_EQ(asked(folder_ / "out" + " --card h200 --size 1280x720 --size 640x360").code, 0);
    EXPECT_EQ(modelled(), (std::vector<std::string>{"h200@1024x1024", "h200@1280x720", "h200@2048x2048", "h200@640x360"}));
}

TEST_F(GpuCostVerb, AllCardsAreModelledUnlessOneIsNamed) {
    const std::string records = folder_.write("results.jsonl", recordOf("sm-uniform"));
    ASSERT_EQ(asked(records).code, 0);
    std::vector<std::string> cards;
    for (const std::string& name : modelled())
        if (name.ends_with("@1920x1080")) cards.push_back(name.substr(0, name.find('@')));
    EXPECT_EQ(cards, (std::vector<std::string>{"geforce-7600-gt", "gtx-1080", "h200", "rtx-2080-ti", "rx-6800-xt"}));
}

TEST_F(GpuCostVerb, WhatReadsBackWaitsForTheProgram) {
    const Outcome outcome = asked(folder_.write("results.jsonl", recordOf("sm-tiled")) + " --card h200");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("waits for the program"), std::string::npos) << outcome.output;
    EXPECT_EQ(written().at(0)["cost"]["gpu"]["h200@1920x1080"]["waits"], true);
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
