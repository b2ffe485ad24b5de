// Costs that different devices took are not put side by side.
#include "base/error.h"
#include "base/temporary_folder.h"
#include "harness/records/comparability.h"
#include "tests/support/records_examples.h"

#include <functional>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class OneDevice : public testing::Test {
protected:
    /// What is said of a file of a record of ours and one that `change` has changed; "" if both are read.
    [[nodiscard]] std::string complaint(const std::function<void(Record&)>& change) const {
        Record other = test::hardRecord();
        other.variant = "vsm";
        change(other);
        writeRecords(folder_.path() / "ours.jsonl", {test::hardRecord()});
        writeRecords(folder_.path() / "other.jsonl", {other});
        try {
            EXPECT_EQ(gate::readOfOneDevice({folder_.path() / "ours.jsonl", folder_.path() / "other.jsonl"}).size(), 2U);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    }

private:
    TemporaryFolder folder_;
};

void onGpu(Record& record) {
    record.environment.platform = "egl";
    record.environment.vendor = "NVIDIA Corporation";
    record.environment.renderer = "NVIDIA H100 PCIe/PCIe/SSE2";
}

TEST_F(OneDevice, IsWhatStatedCostsMustBeOf) {
    EXPECT_EQ(complaint([](Record&) {}), "");
    const std::string said = complaint(onGpu);
    for (const char* text : {"costs of different devices", "vsm on dueling-frusta", "NVIDIA H100 PCIe/PCIe/SSE2",
                             "llvmpipe (LLVM 15.0.6, 256 bits)"})
        EXPECT_NE(said.find(text), std::string::npos) << said;
    EXPECT_NE(complaint([](Record& r) { r.environment.cpu = "another"; }), "");
    EXPECT_NE(complaint([](Record& r) { r.environment.platform = "egl"; }), "");
}

TEST_F(OneDevice, MayDifferWhereNoCostIsStated) {
    EXPECT_EQ(complaint([](Record& r) {
                  onGpu(r);
                  for (const char* group : {"cost", "lod"}) test::clear(r, group);
                  r.passes.clear();
                  r.otherScreen.reset();
              }),
              "");
    EXPECT_EQ(complaint([](Record& r) {
                  onGpu(r);
                  r.technique = "external:engine"; // what another renderer reports of itself
              }),
              "");
}

TEST_F(OneDevice, IsOsMesaWhereAnOlderRecordDoesNotSay) {
    EXPECT_EQ(complaint([](Record& r) { r.environment.platform = r.environment.vendor = r.environment.driver = ""; }), "");
}

} // namespace
} // namespace shadowbench
