// Every record written is valid under the schema, and the schema refuses what is not a record.
// GCC 12 warns of overlapping copies where valijson joins strings (GCC bug 105651, a false alarm).
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include "tests/support/records_examples.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace shadowbench {
namespace {

using namespace test;
using Json = nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

class RecordSchema : public testing::Test {
protected:
    void SetUp() override {
        const Json document = Json::parse(recordSchema());
        const Adapter adapter(document);
        valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(adapter, schema_);
    }

    bool valid(const Json& record) {
        valijson::Validator validator;
        valijson::ValidationResults results;
        const Adapter adapter(record);
        const bool result = validator.validate(schema_, adapter, &results);
        valijson::ValidationResults::Error error;
        why_.clear();
        while (results.popError(error)) why_ += error.description + "\n";
        return result;
    }

    valijson::Schema schema_;
    std::string why_;
};

TEST_F(RecordSchema, HoldsForRecordsOfEveryStatus) {
    for (const Record& record : recordOfEveryStatus())
        EXPECT_TRUE(valid(Json::parse(toJson(record)))) << toJson(record) << why_;
}

TEST_F(RecordSchema, RefusesATypoAtEveryLevel) {
    for (const char* place : {"", "/environment", "/reference", "/accuracy", "/accuracy/edge_error", "/aliasing",
                              "/stability", "/stability/flicker", "/stability/by_frame", "/cost", "/cost/time", "/cost/work",
                              "/cost/by_pass/1", "/cost/other_screen", "/cost/other_screen/by_pass/0", "/tolerance"}) {
        Json record = Json::parse(toJson(hardRecord()));
        ASSERT_TRUE(valid(record)) << why_;
        record[Json::json_pointer(place)]["mismach"] = 0.1;
        EXPECT_FALSE(valid(record)) << place;
    }
}

TEST_F(RecordSchema, HoldsForOlderRecordsWithBarePasses) {
    Json record = Json::parse(toJson(hardRecord()));
    record["cost"]["time"]["bare"] = 15.2;
    record["cost"]["time"]["bare_ratio"] = 1.4;
    record["cost"]["by_pass"][1]["bare"] = {{"source", "course, Shadow Mapping"}, {"fragments", 16384}};
    EXPECT_TRUE(valid(record)) << why_;
}

TEST_F(RecordSchema, RefusesATypoInCostsOfAGraphicsProcessor) {
    for (const char* place : {"/cost/device/0", "/cost/device/1/by_pass/0"}) {
        Json record = Json::parse(toJson(deviceRecord()));
        ASSERT_TRUE(valid(record)) << why_;
        record[Json::json_pointer(place)]["mediann"] = 0.1;
        EXPECT_FALSE(valid(record)) << place;
    }
}

TEST_F(RecordSchema, RefusesATypoInModelledCosts) {
    for (const char* place : {"/cost/gpu/h200@1x1", "/cost/gpu/h200@1x1/by_pass/0"}) {
        Record modelled = hardRecord();
        modelled.modelled["h200@1x1"] = {1, 0.5, 2, false, {{"resolve", 0.25, 0, 0, 0, 0, 0}}};
        Json record = Json::parse(toJson(modelled));
        ASSERT_TRUE(valid(record)) << why_;
        record[Json::json_pointer(place)]["leastt"] = 0.1;
        EXPECT_FALSE(valid(record)) << place;
    }
}

TEST_F(RecordSchema, ALevelOfDetailRecordHasNoAccuracyAndNoTypos) {
    for (const char* place : {"/lod", "/lod/time", "/lod/by_frame"}) {
        Json record = Json::parse(toJson(lodRecord()));
        ASSERT_TRUE(valid(record)) << why_;
        record[Json::json_pointer(place)]["popp"] = 0.1;
        EXPECT_FALSE(valid(record)) << place;
    }
    Json record = Json::parse(toJson(lodRecord()));
    record["accuracy"] = {{"primary_mismatch", 0.0}};
    EXPECT_FALSE(valid(record));
    record = Json::parse(toJson(unscored(Status::Error, "x")));
    record["lod"] = Json::parse(toJson(lodRecord()))["lod"];
    EXPECT_FALSE(valid(record));
}

TEST_F(RecordSchema, RefusesANullAndAZeroLengthCurve) {
    Json record = Json::parse(toJson(hardRecord()));
    record["accuracy"]["leak"] = nullptr;
    EXPECT_FALSE(valid(record));
    record = Json::parse(toJson(hardRecord()));
    record["stability"]["by_frame"]["changed"] = Json::array();
    EXPECT_FALSE(valid(record));
}

TEST_F(RecordSchema, TakesAnyFigureThatIsANumber) {
    Json record = Json::parse(toJson(hardRecord()));
    record["figures"]["passes"] = 3;
    EXPECT_TRUE(valid(record)) << why_;
    record["figures"]["passes"] = "three";
    EXPECT_FALSE(valid(record));
    record["figures"] = Json::object();
    EXPECT_FALSE(valid(record));
}

TEST_F(RecordSchema, RefusesARateInPerCent) {
    Json record = Json::parse(toJson(hardRecord()));
    record["accuracy"]["mismatch"] = 4.87;
    EXPECT_FALSE(valid(record));
}

TEST_F(RecordSchema, WantsAReasonForWhatWasNotScoredAndATruthForAScore) {
    Json record = Json::parse(toJson(unscored(Status::NotApplicable, "needs an area light")));
    record.erase("reason");
    EXPECT_FALSE(valid(record));

    record = Json::parse(toJson(hardRecord()));
    record.erase("reference");
    EXPECT_FALSE(valid(record));

    record = Json::parse(toJson(unscored(Status::Error, "x")));
    record["accuracy"] = {{"primary_mismatch", 0.03}};
    EXPECT_FALSE(valid(record));
}

} // namespace
} // namespace shadowbench
