// What two records must have in common for their figures to be compared, and how the difference is said.
#include "harness/records/comparability.h"
#include "tests/support/records_examples.h"

#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

using test::hardRecord;
using Change = std::function<void(Environment&)>;

/// What tells the environment of a record from the same with `change`; "" if nothing does.
std::string differenceOf(const Change& change, EnvironmentScope what) {
    Environment other = hardRecord().environment;
    change(other);
    return difference(hardRecord().environment, other, what).value_or("");
}

TEST(Environments, DifferInWhatDraws) {
    const std::vector<std::pair<Change, std::string>> changes{
        {[](Environment& e) { e.renderer = "softpipe"; },
         R"~(renderer is "llvmpipe (LLVM 15.0.6, 256 bits)" and "softpipe")~"},
        {[](Environment& e) { e.gl = "4.6"; }, R"(gl is "4.5 (Core Profile) Mesa 22.3.6" and "4.6")"},
        {[](Environment& e) { e.platform = "egl"; }, R"(platform is "osmesa" and "egl")"},
        {[](Environment& e) { e.vendor = "other"; }, R"(vendor is "Mesa/X.org" and "other")"},
        {[](Environment& e) { e.driver = "other"; }, R"(driver is "Mesa 22.3.6" and "other")"},
        {[](Environment& e) { e.rasterThreads = 2; }, R"(raster_threads is "0" and "2")"},
        {[](Environment& e) { e.vectorBits = 512; }, R"(vector_bits is "256" and "512")"},
        {[](Environment& e) { e.mesa = "other"; }, R"(mesa is "libosmesa6 22.3.6-1, libllvm15 15.0.6-4" and "other")"}};
    for (const auto& [change, sentence] : changes)
        for (const EnvironmentScope what : {EnvironmentScope::OfScores, EnvironmentScope::OfCounts, EnvironmentScope::All})
            EXPECT_EQ(differenceOf(change, what), sentence);
}

TEST(Environments, DifferInWhatCountsOnlyWhereCountsAreCompared) {
    const std::vector<std::pair<Change, std::string>> changes{
        {[](Environment& e) { e.cpu = "other"; }, R"(cpu is "some cpu" and "other")"},
        {[](Environment& e) { e.cpuFeatures = "other"; },
         R"(cpu_features is "family 6, model 85, stepping 7, features 77aa" and "other")"},
        {[](Environment& e) { e.libraries = "other"; }, R"(libraries is "libc 2.36, libstdc++6 12.2.0-14" and "other")"}};
    for (const auto& [change, sentence] : changes) {
        EXPECT_EQ(differenceOf(change, EnvironmentScope::OfScores), "");
        EXPECT_EQ(differenceOf(change, EnvironmentScope::OfCounts), sentence);
        EXPECT_EQ(differenceOf(change, EnvironmentScope::All), sentence);
    }
    const Change compiler = [](Environment& e) { e.compiler = "GCC 13"; };
    EXPECT_EQ(differenceOf(compiler, EnvironmentScope::OfCounts), "");
    EXPECT_EQ(differenceOf(compiler, EnvironmentScope::All), R"(compiler is "GCC 12.2.0" and "GCC 13")");
}

TEST(Environments, DoNotDifferInWhatOneOfThemDoesNotState) {
    const Change older = [](Environment& e) {
        e.cpuFeatures = e.mesa = e.libraries = e.platform = e.vendor = e.driver = "";
        e.valgrind.reset();
    };
    EXPECT_EQ(differenceOf(older, EnvironmentScope::All), "");
    Environment counted = hardRecord().environment, other = counted;
    counted.valgrind = "3.19.0";
    EXPECT_FALSE(difference(counted, other, EnvironmentScope::All)) << "one counted nothing";
    other.valgrind = "3.20.0";
    EXPECT_EQ(difference(counted, other, EnvironmentScope::OfCounts), R"(valgrind is "3.19.0" and "3.20.0")");
}

TEST(Environments, OfImagesThatOthersDrewAreAllOne) {
    Environment one = hardRecord().environment, other = one;
    one.gl = other.gl = notDrawnHere;
    one.renderer = "engine 1";
    other.renderer = "engine 2"; // its next version is what is compared
    EXPECT_FALSE(difference(one, other, EnvironmentScope::OfScores));
    other.gl = hardRecord().environment.gl;
    EXPECT_TRUE(difference(one, other, EnvironmentScope::OfScores));
}

TEST(CountingEnvironment, NamesAllThatCountsDependOn) {
    Environment e = hardRecord().environment;
    EXPECT_EQ(countingEnvironment(e),
              "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6, 0 raster threads, 256 bits, no Valgrind, "
              "some cpu, family 6, model 85, stepping 7, features 77aa, libosmesa6 22.3.6-1, libllvm15 15.0.6-4, libc 2.36, "
              "libstdc++6 12.2.0-14");
    const std::string before = countingEnvironment(e);
    e.platform = "";
    EXPECT_EQ(countingEnvironment(e), before) << "an older record is of OSMesa";
    e.platform = "egl";
    e.mesa = "";
    e.valgrind = "3.19.0";
    EXPECT_NE(countingEnvironment(e).find("3.19.0, some cpu"), std::string::npos);
    EXPECT_TRUE(countingEnvironment(e).ends_with("libstdc++6 12.2.0-14, through egl"));
}

TEST(Incomparable, SaysWhatDiffers) {
    const auto why = [](const std::function<void(Record&)>& change) {
        Record head = hardRecord();
        change(head);
        return whyIncomparable(hardRecord(), head).value_or("");
    };
    EXPECT_EQ(why([](Record&) {}), "");
    EXPECT_EQ(why([](Record& r) { r.frames = 12; }), "it had 68 frames and has 12");
    EXPECT_EQ(why([](Record& r) { r.parameters[1].second = "2048"; }), "its parameter map was 1024 and is 2048");
    EXPECT_EQ(why([](Record& r) { r.parameters.erase(r.parameters.begin()); }), "") << "one that is gone";
    EXPECT_NE(why([](Record& r) { r.reference.reset(); }).find("different truths"), std::string::npos);
    EXPECT_NE(why([](Record& r) { r.reference->content = "other"; }).find("one key with other pixels"), std::string::npos);
    EXPECT_NE(why([](Record& r) { r.environment.gl = "4.6"; }).find("different rasterisers: gl is"), std::string::npos);
    Record walk = test::lodRecord();
    EXPECT_FALSE(whyIncomparable(walk, walk)) << "no truth on either side";
}

TEST(TruthOfAMetric, IsTheOneThatItWasComputedFrom) {
    Record record = hardRecord();
    record.softReference = ReferenceInfo{"povray", "soft", 1024, 0.02, {}};
    record.pixelReference = ReferenceInfo{"pixel-areas", "areas", 0, 0, {}};
    const auto keyOf = [&](const char* path) { return truthOf(*metrics::metricAt(path), record)->key; };
    EXPECT_EQ(keyOf("accuracy.leak"), "feed");
    EXPECT_EQ(keyOf("accuracy.rmse"), "soft");
    EXPECT_EQ(keyOf("stability.by_frame.rmse"), "soft");
    EXPECT_EQ(keyOf("stability.seeds.bias"), "soft");
    EXPECT_EQ(keyOf("accuracy.pixel_area.rmse"), "areas");
    EXPECT_EQ(keyOf("stability.flicker.mean"), "areas");
    EXPECT_EQ(keyOf("cost.work.draws"), "feed");
    record.softReference.reset();
    record.pixelReference.reset();
    EXPECT_EQ(keyOf("accuracy.rmse"), "feed") << "the only one";
    EXPECT_EQ(keyOf("stability.flicker.mean"), "feed");
}

std::string whyNot(const char* path, const std::function<void(Record&)>& change) {
    Record head = hardRecord();
    change(head);
    EXPECT_FALSE(whyIncomparable(hardRecord(), head)) << "the cell as a whole is comparable";
    return whyIncomparable(*metrics::metricAt(path), hardRecord(), head).value_or("");
}

TEST(IncomparableMetrics, OfMotionNeedTheSameTruthsOfAllFrames) {
    const auto slower = [](Record& r) { r.truths = "other"; }; // the camera's path: the still frame's truth is the same
    for (const char* path : {"stability.flicker.mean", "stability.flip_rate", "stability.moving_rmse"})
        EXPECT_NE(whyNot(path, slower).find("the scene's motion"), std::string::npos) << path;
    for (const char* path : {"accuracy.leak", "stability.convergence", "cost.work.draws"})
        EXPECT_EQ(whyNot(path, slower), "") << path;
    EXPECT_EQ(whyNot("stability.flicker.mean", [](Record& r) { r.truths = ""; }), "") << "an older record";
}

TEST(IncomparableMetrics, AreOverOneClassOfPixels) {
    const auto fewer = [](double by) {
        return [by](Record& r) { r.values["accuracy.pixels.lit"] = *r.values["accuracy.pixels.lit"] - by; };
    };
    EXPECT_EQ(whyNot("accuracy.false_shadow", fewer(65)), ""); // 0.1 % of 256 × 256
    EXPECT_EQ(whyNot("accuracy.false_shadow", fewer(66)),
              "it is over 49934 pixels and was over 50000 (accuracy.pixels.lit)");
    EXPECT_EQ(whyNot("accuracy.leak", fewer(66)), "") << "over the shadowed ones";
    EXPECT_EQ(whyNot("accuracy.false_shadow", [](Record& r) { r.values["accuracy.pixels.lit"].reset(); }), "");
}

TEST(SameCode, IsAssumedWhereARecordDoesNotSayAndSameImagesAreNot) {
    Record older = hardRecord(), other = hardRecord();
    older.metricCode = older.images = "";
    EXPECT_TRUE(sameMetricCode(older, hardRecord()));
    EXPECT_TRUE(sameMetricCode(hardRecord(), older));
    EXPECT_TRUE(sameMetricCode(hardRecord(), hardRecord()));
    EXPECT_TRUE(sameImages(hardRecord(), hardRecord()));
    EXPECT_FALSE(sameImages(older, older)) << "nothing is known";
    other.metricCode = other.images = "other";
    EXPECT_FALSE(sameMetricCode(hardRecord(), other));
    EXPECT_FALSE(sameImages(hardRecord(), other));
}

} // namespace
} // namespace shadowbench::gate
