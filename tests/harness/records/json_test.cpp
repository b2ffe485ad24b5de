#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tests/support/records_examples.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace shadowbench {
namespace {

using namespace test;
using Json = nlohmann::ordered_json;

/// What parseRecord() says about a record whose JSON was changed by `change`; "" if nothing.
template <typename Change>
std::string complaint(const Change& change) {
    Json json = Json::parse(toJson(hardRecord()));
    change(json);
    try {
        parseRecord(json.dump());
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class RecordsFile : public testing::Test {
protected:
    [[nodiscard]] std::filesystem::path file() const { return folder_ / "results.jsonl"; }

    [[nodiscard]] std::string complaintAbout(const std::string& content) const {
        writeFile(file(), content);
        try {
            readRecords(file());
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    }

private:
    TemporaryFolder owner_;
    std::filesystem::path folder_ = owner_.path();
};

TEST(RecordJson, ReadsBackAsTheSameLineForEveryStatus) {
    for (const Record& record : recordOfEveryStatus()) {
        const std::string line = toJson(record);
        EXPECT_EQ(toJson(parseRecord(line)), line);
        EXPECT_EQ(line.find('\n'), std::string::npos);
    }
}

TEST(RecordJson, KeepsEveryMember) {
    const Record r = parseRecord(toJson(hardRecord()));
    EXPECT_EQ(r.variant, "sm-history:base=lispsm");
    EXPECT_EQ(r.parameters, hardRecord().parameters);
    EXPECT_EQ(r.width, 256);
    EXPECT_EQ(*r.values["accuracy.edge_error.signed"], -0.1);
    EXPECT_EQ(r.values.list("stability.by_frame.mismatch"), hardRecord().values.list("stability.by_frame.mismatch"));
    EXPECT_TRUE(r.values.list("stability.by_frame.rmse").empty());
    EXPECT_EQ(*r.values["aliasing.p95"], 4.2);
    EXPECT_EQ(*r.values["aliasing.mapped"], 0.97);
    EXPECT_EQ(r.figures, hardRecord().figures);
    EXPECT_EQ(r.values["cost.time.base_ratio"], 1.08);
    EXPECT_EQ(r.values["cost.work.bytes"], 4194304);
    ASSERT_EQ(r.passes.size(), 3U);
    EXPECT_EQ(r.passes[1].name, "depth map");
    EXPECT_EQ(r.passes[1].milliseconds, 15.4);
    EXPECT_EQ(r.otherScreen->width, 1024);
    EXPECT_EQ(r.otherScreen->passes[0].fragments, 16U * 32768);
    EXPECT_EQ(r.reference->tools.at("CGAL"), "5.5.1");
    EXPECT_EQ(r.tolerances, (std::map<std::string, double>{{"mismatch", 0.005}}));
    EXPECT_FALSE(r.values["accuracy.rmse"]);
}

TEST(RecordJson, KeepsTheCostsOfAGraphicsProcessor) {
    const Record r = parseRecord(toJson(deviceRecord()));
    ASSERT_EQ(r.deviceCosts.size(), 2U);
    EXPECT_EQ(r.deviceCosts[1].width, 2048);
    EXPECT_EQ(r.deviceCosts[1].median, 4.8);
    EXPECT_EQ(r.deviceCosts[1].mad, 0.001);
    EXPECT_EQ(r.deviceCosts[1].ratio, 1.1);
    EXPECT_EQ(r.deviceCosts[1].processor, 0.04);
    EXPECT_EQ(r.deviceCosts[1].motion, 6);
    EXPECT_EQ(r.deviceCosts[0].first, 1.3);
    EXPECT_FALSE(r.deviceCosts[1].first);
    EXPECT_EQ(r.deviceCosts[1].passes[0].fragments, 4U * 32768);
    EXPECT_TRUE(parseRecord(toJson(hardRecord())).deviceCosts.empty());
}

TEST(RecordJson, KeepsWhatIsModelled) {
    Record record = hardRecord();
    record.modelled["gtx-1080@1920x1080"] = {3, 2, 5, true, {{"resolve", 1, 2, 3, 4, 5, 0.5}}};
    record.modelled["h200@1920x1080"] = {1, 0.5, 2, false, {{"resolve", 0.25, 0, 0, 0, 0, 0}}};
    const Record r = parseRecord(toJson(record));
    ASSERT_EQ(r.modelled.size(), 2U);
    const ModelledCost& cost = r.modelled.at("gtx-1080@1920x1080");
    EXPECT_EQ(cost.milliseconds, 3);
    EXPECT_EQ(cost.least, 2);
    EXPECT_EQ(cost.most, 5);
    EXPECT_TRUE(cost.waits);
    EXPECT_EQ(cost.passes.at(0).geometry, 4);
    EXPECT_EQ(cost.passes.at(0).fixed, 0.5);
    Json broken = Json::parse(toJson(record));
    broken["cost"]["gpu"]["h200@1920x1080"].erase("least");
    try {
        (void)parseRecord(broken.dump());
        ADD_FAILURE();
    } catch (const BadInput& error) {
        EXPECT_TRUE(contains(error.what(), "h200@1920x1080.least")) << error.what();
    }
}

TEST(RecordJson, KeepsAllTolerancesAndReadsTheOneOfOlderRecords) {
    Record record = hardRecord();
    record.tolerances = {{"leak", 0.1}, {"mismatch", 0.005}};
    EXPECT_EQ(parseRecord(toJson(record)).tolerances, record.tolerances);
    record.tolerances.clear();
    EXPECT_FALSE(contains(toJson(record), "tolerance"));

    Json older = Json::parse(toJson(hardRecord()));
    older.erase("tolerances");
    older["tolerance"] = {{"metric", "mismatch"}, {"value", 0.005}};
    EXPECT_EQ(parseRecord(older.dump()).tolerances, hardRecord().tolerances);
    const auto set = [](const Json& tolerance) {
        return complaint([&](Json& json) {
            json.erase("tolerances");
            json["tolerance"] = tolerance;
        });
    };
    EXPECT_TRUE(contains(set({{"metric", "mismatch"}}), "\"tolerance.value\" is missing"));
    EXPECT_TRUE(contains(set({{"metric", "mismatch"}, {"value", "small"}}), "\"tolerance.value\" is not a number"));
    EXPECT_TRUE(contains(set({{"metric", "mismatch"}, {"value", 1}, {"more", 1}}), "\"tolerance.more\" is unknown"));
}

TEST(RecordJson, WritesDoublesThatReadBackEqual) {
    Record record = softRecord();
    for (const double value : {0.1 + 0.2, 1.0 / 3, 5e-324, 1.7976931348623157e308, 0.0}) {
        record.values["accuracy.rmse"] = value;
        EXPECT_EQ(*parseRecord(toJson(record)).values["accuracy.rmse"], value);
    }
}

TEST(RecordJson, WritesTheFieldsInSchemaOrderAndNoAbsentMetric) {
    const Json json = Json::parse(toJson(softRecord()));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"schema_version", "scene",     "technique", "variant",     "parameters",
                                              "profile",        "size",      "frames",    "seed",        "status",
                                              "cell",           "commit",    "dirty",     "program",     "metric_code",
                                              "images",         "truths",    "time",      "environment", "reference",
                                              "accuracy",       "stability", "cost",      "tolerances"}));
    EXPECT_FALSE(json["accuracy"].contains("mismatch"));
    EXPECT_EQ(json["stability"]["by_frame"],
              Json::parse(R"({"rmse":[0.2,0.031],"bad30":[0.1,0.012],"changed":[0.04,0.008,0.0]})"));
    EXPECT_EQ(json["tolerances"], Json::parse(R"({"penumbra_rmse":0.05})"));
    EXPECT_EQ(json["size"], Json::parse("[256,256]"));
}

TEST(RecordJson, FiguresAndAliasingStandBetweenAccuracyAndStability) {
    const std::string line = toJson(hardRecord());
    EXPECT_TRUE(contains(line,
                         R"("aliasing":{"median":1.8,"p95":4.2,"mapped":0.97},"figures":{"confident":0.31,"tiles":6.0},)"
                         R"("stability")"))
        << line;
}

TEST(RecordJson, KeepsAStabilityThatHoldsTheErrorOfMovingFramesAlone) {
    Record record = hardRecord();
    clear(record, "stability");
    record.values["stability.moving_rmse"] = 0.25;
    EXPECT_EQ(parseRecord(toJson(record)).values["stability.moving_rmse"], 0.25);
    clear(record, "stability");
    record.values["stability.disocclusion_error"] = 0.5;
    EXPECT_EQ(parseRecord(toJson(record)).values["stability.disocclusion_error"], 0.5);
}

TEST(RecordJson, KeepsCostsInMotionAndOfTheFirstFrame) {
    Record record = hardRecord();
    for (const char* group : {"cost.motion", "cost.cold"})
        for (const metrics::Metric& line : metrics::linesOf(group)) {
            if (line.list)
                record.values.list(metrics::MetricId(line)) = {3, 4};
            else
                record.values[line] = 7;
        }
    record.values["cost.work.peak_bytes"] = 4194305;
    record.motionPasses = record.coldPasses = record.passes;
    record.coldPasses[0].name = "precomputation";
    const Json json = Json::parse(toJson(record));
    EXPECT_EQ(json["cost"]["motion"]["work"]["vertices"], 7);
    EXPECT_EQ(json["cost"]["cold"]["compile"], 7);
    const Record read = parseRecord(toJson(record));
    EXPECT_EQ(toJson(read), toJson(record));
    EXPECT_EQ(read.coldPasses.at(0).name, "precomputation");
    EXPECT_EQ(read.values.list("cost.motion.time.samples"), (std::vector<double>{3, 4}));
}

TEST(RecordJson, RefusesAPassThatIsNone) {
    EXPECT_TRUE(contains(complaint([](Json& j) { j["cost"]["by_pass"] = 3; }), "\"cost.by_pass\" is not a list"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["cost"]["by_pass"][1]["rusn"] = 3; }), "is unknown"));
}

TEST(RecordJson, NeverWritesAScoredRecordWithoutItsPrimaryMismatch) {
    Record record = hardRecord();
    record.values["accuracy.primary_mismatch"].reset();
    EXPECT_THROW(toJson(record), InternalError);
}

TEST(RecordJson, WritesCountsAsWholeNumbers) {
    Record record = softRecord();
    record.values["cost.instructions"] = 9007199254740991; // 2⁵³ − 1
    const std::string line = toJson(record);
    EXPECT_TRUE(contains(line, "\"instructions\":9007199254740991,")) << line;
    EXPECT_EQ(toJson(parseRecord(line)), line);
    EXPECT_TRUE(contains(complaint([](Json& j) { j["cost"]["work"]["bytes"] = 9007199254740994; }), "is not within 0"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["cost"]["work"]["bytes"] = 1.5; }), "is not a whole number"));
}

TEST(RecordJson, TypesParametersAsNumbersWhereTheyAreNumbers) {
    const Json parameters = Json::parse(toJson(hardRecord()))["parameters"];
    EXPECT_EQ(parameters.dump(), R"({"base":"lispsm","map":1024,"bias":0.25,"taps":"32+32"})");
}

TEST(RecordJson, NeverWritesANumberThatIsNotFinite) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        Record record = hardRecord();
        record.values["accuracy.edge_error.hausdorff"] = bad;
        try {
            toJson(record);
            FAIL() << bad;
        } catch (const InternalError& error) {
            EXPECT_TRUE(contains(error.what(), "accuracy.edge_error.hausdorff")) << error.what();
        }
        record = hardRecord();
        record.values.list("stability.by_frame.changed")[1] = bad;
        EXPECT_THROW(toJson(record), InternalError);
        record = hardRecord();
        record.figures["tiles"] = bad;
        EXPECT_THROW(toJson(record), InternalError);
    }
}

TEST(RecordJson, NamesTheKeyOfWhatIsWrong) {
    EXPECT_EQ(complaint([](Json&) {}), "");
    EXPECT_TRUE(contains(complaint([](Json& j) { j.erase("variant"); }), "\"variant\" is missing"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["acuracy"] = 1; }), "\"acuracy\" is unknown"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["accuracy"]["mismach"] = 0.1; }), "\"accuracy.mismach\" is unknown"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["accuracy"]["leak"] = nullptr; }), "\"accuracy.leak\" is not a number"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["cost"]["time"].erase("p95"); }), "\"cost.time.p95\" is missing"));
    EXPECT_TRUE(
        contains(complaint([](Json& j) { j["stability"]["by_frame"]["chnged"] = Json::array(); }), "by_frame.chnged"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["figures"]["tiles"] = "6"; }), "\"figures.tiles\" is not a number"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["figures"] = 6; }), "\"figures\" is not an object"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["status"] = "fine"; }), "\"status\" is not"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["frames"] = 1.5; }), "\"frames\" is not a whole number"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["seed"] = -1; }), "\"seed\" is not within"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["size"] = {1, 2, 3}; }), "\"size\""));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["parameters"]["map"] = true; }), "\"parameters.map\""));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["environment"] = 3; }), "\"environment\" is not an object"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["schema_version"] = 2; }), "\"schema_version\" is 2"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j.erase("schema_version"); }), "\"schema_version\""));
    EXPECT_TRUE(contains(complaint([](Json& j) { j.erase("accuracy"); }), "\"accuracy\" belongs to scored records"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["status"] = "error"; }), "\"accuracy\" belongs to scored records"));
    EXPECT_TRUE(contains(complaint([](Json& j) { j["figures"]["a\nb"] = "6"; }), "\"figures.a\nb\" is not a number"));
    EXPECT_THROW(parseRecord(std::string(1'000'000, '[')), BadInput);
    EXPECT_THROW(parseRecord("{"), BadInput);
    EXPECT_THROW(parseRecord("[]"), BadInput);
    EXPECT_THROW(parseRecord(""), BadInput);
}

TEST(RecordJson, RefusesAMemberOfAnotherTypeWhateverItHolds) {
    const std::vector<std::pair<std::function<void(Json&)>, std::string>> changes{
        {[](Json& j) { j["scene"] = 3; }, "\"scene\" is not text"},
        {[](Json& j) { j["reason"] = true; }, "\"reason\" is not text"},
        {[](Json& j) { j["dirty"] = "no"; }, "\"dirty\" is neither true nor false"},
        {[](Json& j) { j["status"] = 1; }, "\"status\" is not"},
        {[](Json& j) { j["width"] = 1; }, "\"width\" is unknown"},
        {[](Json& j) { j.erase("size"); }, "\"size\" is missing"},
        {[](Json& j) { j["size"] = 256; }, "\"size\" is not [width, height]"},
        {[](Json& j) {
             j["size"] = {256, "256"};
         },
         "\"size\" is not a whole number"},
        {[](Json& j) {
             j["size"] = {256, 3e9};
         },
         "\"size\" is not a whole number"},
        {[](Json& j) {
             j["size"] = {256, 3'000'000'000};
         },
         "\"size\" is not within"},
        {[](Json& j) { j["frames"] = -3'000'000'000; }, "\"frames\" is not within"},
        {[](Json& j) { j.erase("parameters"); }, "\"parameters\" is missing"},
        {[](Json& j) { j["parameters"] = Json::array(); }, "\"parameters\" is not an object"},
        {[](Json& j) { j["reference"] = "feed"; }, "\"reference\" is not an object"},
        {[](Json& j) { j["reference"]["tools"] = "CGAL"; }, "\"reference.tools\" is not an object"},
        {[](Json& j) { j["reference"]["tools"]["CGAL"] = 5.5; }, "\"reference.tools\" is not text"},
        {[](Json& j) { j["stability"]["by_frame"]["mismatch"] = 0.1; }, "by_frame.mismatch\" is not a list"},
        {[](Json& j) { j["stability"]["by_frame"]["mismatch"][1] = "0.1"; }, "by_frame.mismatch\" is not a number"},
        {[](Json& j) { j["accuracy"] = 3; }, "\"accuracy\" is not an object"},
        {[](Json& j) { j["cost"]["other_screen"]["by_pass"][0]["name"] = 3; }, "by_pass.name\" is not text"},
        {[](Json& j) { j["environment"]["valgrind"] = 3.19; }, "\"environment.valgrind\" is not text"},
        {[](Json& j) {
             j["lod"] = {{"pop", "x"}};
         },
         "\"lod.pop\" is not a number"}};
    for (const auto& [change, sentence] : changes)
        EXPECT_TRUE(contains(complaint(change), sentence)) << sentence << " != " << complaint(change);
}

TEST(RecordJson, RefusesALevelOfDetailRecordThatWasNotScored) {
    Json json = Json::parse(toJson(lodRecord()));
    json["status"] = "error";
    json["reason"] = "x";
    EXPECT_THROW(parseRecord(json.dump()), BadInput);
}

TEST(RecordJson, NamesTheCellWhoseTextIsNotUtf8) {
    Record record = hardRecord();
    record.reason = "\xff";
    try {
        toJson(record);
        FAIL() << "written";
    } catch (const InternalError& error) {
        EXPECT_TRUE(contains(error.what(), "sm-history:base=lispsm on dueling-frusta: a text is not UTF-8")) << error.what();
    }
}

TEST(RecordJson, KeepsWhatAnotherRendererSaysOfItself) {
    Record record = hardRecord();
    record.technique = record.variant = "external:engine";
    record.external = ExternalInfo{"Engine", "its page", ReportedCost{2.5, "a GPU"}, "v4.2-3-gabcdef0"};
    const Record read = parseRecord(toJson(record));
    EXPECT_TRUE(isExternal(read));
    EXPECT_FALSE(isExternal(hardRecord()));
    EXPECT_EQ(read.external->title, "Engine");
    EXPECT_EQ(read.external->revision, "v4.2-3-gabcdef0");
    EXPECT_EQ(read.external->reported->milliseconds, 2.5);
    EXPECT_EQ(toJson(read), toJson(record));
}

TEST_F(RecordsFile, ReadsBackWhatWasWritten) {
    const std::vector<Record> records = recordOfEveryStatus();
    writeRecords(file(), records);
    const std::vector<Record> read = readRecords(file());
    ASSERT_EQ(read.size(), records.size());
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(toJson(read[i]), toJson(records[i]));

    writeRecords(file(), {});
    EXPECT_TRUE(readRecords(file()).empty());
}

TEST_F(RecordsFile, NamesFileAndLineOfWhatIsWrong) {
    const std::string line = toJson(hardRecord()) + "\n";
    EXPECT_EQ(complaintAbout(line + line), "");
    EXPECT_TRUE(contains(complaintAbout(line + "{}\n"), "results.jsonl:2: ")) << complaintAbout(line + "{}\n");
    EXPECT_TRUE(contains(complaintAbout(line + "\n" + line), "results.jsonl:2: "));
    EXPECT_TRUE(contains(complaintAbout(line + line.substr(0, 50)), "results.jsonl:2: the last line has no end"));
    EXPECT_THROW(readRecords(file().parent_path() / "none.jsonl"), BadInput);
}

TEST(Headline, IsMismatchForHardTruthsAndRmseWhereASoftTruthWasUsed) {
    EXPECT_EQ(headline(hardRecord())->metric, "mismatch");
    EXPECT_EQ(headline(hardRecord())->value, 0.0009);
    EXPECT_EQ(headline(softRecord())->metric, "rmse");

    Record hardOnAreaLight = hardRecord();
    hardOnAreaLight.softReference = softRecord().reference;
    hardOnAreaLight.values["accuracy.rmse"] = 0.2;
    EXPECT_EQ(headline(hardOnAreaLight)->metric, "rmse");
    EXPECT_EQ(headline(hardOnAreaLight)->value, 0.2);

    Record filtered = hardRecord(); // against the hard truth, rmse too
    filtered.values["accuracy.rmse"] = 0.2;
    EXPECT_EQ(headline(filtered)->metric, "mismatch");
}

TEST(Headline, IsThereForExpectedFailuresAndNotForWhatWasNotScored) {
    EXPECT_TRUE(headline(expectedFailure()));
    EXPECT_FALSE(headline(unscored(Status::Error, "x")));
    EXPECT_FALSE(headline(unscored(Status::NotApplicable, "x")));
}

TEST(LevelOfDetail, IsWhatHasPopping) {
    EXPECT_TRUE(isLevelOfDetail(lodRecord()));
    EXPECT_FALSE(isLevelOfDetail(hardRecord()));
}

} // namespace
} // namespace shadowbench
