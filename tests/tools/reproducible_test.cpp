// tools/reproducible in a copy of its own, with a stand-in for the program that leaves the records it is given.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"
#include "tests/support/records_examples.h"

#include <functional>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class ReproducibleTool : public testing::Test {
protected:
    ReproducibleTool() {
        for (const char* file : {"tools/reproducible", "benchmarks/tiny_scenes.sh"}) {
            fs::create_directories(fs::path(folder_ / file).parent_path());
            fs::copy_file(fs::path(SOURCE_FOLDER) / file, folder_ / file);
        }
        fs::create_directory(folder_ / "build");
        const std::string program =
            folder_.write("build/shadowbench", "#!/bin/sh\nwhile [ \"$1\" != --out ]; do shift; done\n"
                                               "mkdir -p \"$2\" && cp " +
                                                   (folder_ / "records.jsonl") + " \"$2/results.jsonl\"\n");
        fs::permissions(program, fs::perms::owner_all);
    }

    /// Runs the tool where the program's records are those of the examples with `change`.
    [[nodiscard]] Outcome tool(const std::string& options, const std::function<void(Record&)>& change) const {
        std::vector<Record> records{test::hardRecord(), test::softRecord()};
        records[1].reference->content = "beef";
        for (Record& record : records) change(record);
        writeRecords(folder_ / "records.jsonl", records);
        return shell((folder_ / "tools/reproducible") + " " + options + " " + (folder_ / "build"));
    }

    Folder folder_;
};

void asItWas(Record&) {}

TEST_F(ReproducibleTool, FindsTheSameWhateverTheDateAndTheProgramAre) {
    EXPECT_EQ(tool("--accept", asItWas).code, 0);
    const Outcome same = tool("", [](Record& r) {
        r.time = "2027-01-01T00:00:00Z";
        r.commit = r.program = r.metricCode = "another";
        r.dirty = true;
    });
    EXPECT_EQ(same.code, 0) << same.output;
    EXPECT_NE(same.output.find("all 6 hashes of truths, images and records are those kept"), std::string::npos)
        << same.output;
}

TEST_F(ReproducibleTool, NamesWhatDiffers) {
    ASSERT_EQ(tool("--accept", asItWas).code, 0);
    const Outcome images = tool("", [](Record& r) {
        if (r.technique == "pcss") r.images = "2222";
    });
    EXPECT_EQ(images.code, 4) << images.output;
    EXPECT_NE(images.output.find("2 of 6 are not those kept"), std::string::npos) << images.output;
    EXPECT_NE(images.output.find("images overlapping-occluders pcss:taps=32+32 2222\n"), std::string::npos) << images.output;
    EXPECT_EQ(images.output.find("dueling-frusta"), std::string::npos) << images.output;
    const Outcome truth = tool("--quick", [](Record& r) { r.reference->content += "0"; });
    EXPECT_NE(truth.output.find("truth dueling-frusta polygon feed f00d0\n"), std::string::npos) << truth.output;
    const Outcome score = tool("", [](Record& r) { r.values["stability.flicker.mean"] = 0.25; });
    EXPECT_EQ(score.code, 4) << "of the same images";
}

TEST_F(ReproducibleTool, OnAnotherKindOfMachineIsInconclusiveAndSaysHowNearItIs) {
    const auto another = [](Record& r) { r.environment.cpuFeatures = "family 26"; };
    const Outcome first = tool("", another);
    EXPECT_EQ(first.code, 5) << first.output;
    EXPECT_NE(first.output.find("# cpu_features: family 26\n"), std::string::npos) << first.output;
    ASSERT_EQ(tool("--accept", asItWas).code, 0);
    const Outcome second = tool("", another);
    EXPECT_EQ(second.code, 5) << second.output;
    EXPECT_NE(second.output.find("6 of 6 are those of "), std::string::npos) << second.output;
    EXPECT_EQ(tool("--accept", another).code, 0);
    EXPECT_EQ(tool("", another).code, 0);
}

TEST_F(ReproducibleTool, RefusesWhatItDoesNotKnow) {
    EXPECT_EQ(tool("--fast", asItWas).code, 2);
    EXPECT_EQ(shell((folder_ / "tools/reproducible") + " /nowhere").code, 2);
}

} // namespace
} // namespace shadowbench
