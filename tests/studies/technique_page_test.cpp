// The page of a technique: what its entry says, what it costs, and where it is good and where it breaks.
#include "studies/behaviour/technique_page.h"

#include "base/files.h"
#include "base/temporary_folder.h"
#include "tests/support/records_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

techniques::Entry toy(techniques::Answer answer) {
    return {.id = "toy",
            .title = "A toy",
            .source = {techniques::Document::Course, "Toys"},
            .answer = answer,
            .computed = "the map once",
            .parameters = {{"map", "1024", techniques::IntegerRange{64, 8192}, "texels a side", "Toys 2"},
                           {"bias", "slope", techniques::OneOf{{"none", "slope"}}, "what is added to depths", ""}},
            .variants = {"", "map=2048"}};
}

Record hard(const std::string& scene, const std::string& variant, double mismatch) {
    Record record = test::hardRecord();
    record.scene = scene;
    record.technique = variant.substr(0, variant.find(':'));
    record.variant = variant;
    record.values["accuracy.mismatch"] = mismatch;
    record.values["cost.work.peak_bytes"] = 3 << 20;
    return record;
}

Record soft(const std::string& scene, const std::string& variant, double rmse) {
    Record record = test::softRecord();
    record.scene = scene;
    record.technique = record.variant = variant;
    record.values["accuracy.rmse"] = rmse;
    return record;
}

/// With all pictures that it asks for.
std::string pageOf(const techniques::Entry& entry, const std::vector<Record>& records) {
    const TemporaryFolder pictures;
    for (const char* which : {"-good.png", "-breaks.png"}) writeFile(pictures.path() / (entry.id + which), "");
    return techniquePage(entry, records, pictures.path());
}

void expectIn(const std::string& page, const std::string& text) {
    EXPECT_NE(page.find(text), std::string::npos) << text << "\nis not in\n" << page;
}

TEST(TechniquePage, SaysWhatTheEntrySaysAndWhatItCosts) {
    const std::string page = pageOf(toy(techniques::Answer::Soft), {soft("table", "toy", 0.01)});
    for (const char* text : {"# A toy\n\n`toy`\n", "Real-Time Shadowing Techniques, Toys\n", "soft shadows, area lights\n",
                             "* **Computed**: the map once\n", ": `toy`, `toy:map=2048`\n", "in motion: 1.19 on `table`\n",
                             "| `map` | 64…8192 | 1024 | texels a side | Toys 2 |\n| `bias` | none\\|slope | slope | what "
                             "is added to depths | – |\n"})
        expectIn(page, text);
    expectIn(pageOf(toy(techniques::Answer::Hard), {hard("table", "toy", 0)}), "1.19 on `table`; 3.0 MiB at most\n");
    expectIn(pageOf(toy(techniques::Answer::Hard), {}), "not timed");
}

TEST(TechniquePage, ShowsTheScenesOfLeastAndGreatestErrorBesideNone) {
    std::vector<Record> records{hard("much", "none", 0.5),      hard("much", "toy", 0.05), hard("little", "none", 0.01),
                                hard("little", "toy", 0.009),   hard("fair", "none", 0.2), hard("fair", "toy", 0.03),
                                hard("fair", "toy:map=2048", 0)};
    records[3].status = Status::ExpectedFailure;
    records[3].reason = "its map is coarse";
    const std::string page = pageOf(toy(techniques::Answer::Hard), records);
    const std::string limit = "of `none`'s; beyond the scene's tolerances";
    expectIn(page, "## Where it is good\n\n* **By the error**: `much`, mismatching pixels 5.00 %, 10.0 % " + limit +
                       "\n\n![toy on much](../pictures/techniques/toy-good.png)\n");
    expectIn(page, "## Where it breaks\n\n* **By the error**: `little`, mismatching pixels 0.90 %, 90.0 % " + limit +
                       ". The scene says: its map is coarse\n\n![toy on little](../pictures/techniques/toy-breaks.png)\n");
}

TEST(TechniquePage, CountsOnlyScenesThatItsKindOfAnswerIsRankedOn) {
    const std::vector<Record> records{hard("sun", "none", 0.5), hard("sun", "toy", 0.1), soft("lamp", "none", 0.5),
                                      soft("lamp", "toy", 0.01)};
    expectIn(pageOf(toy(techniques::Answer::Filtered), records), "![toy on sun](../pictures/techniques/toy-good.png)");
    const std::string softPage = pageOf(toy(techniques::Answer::Soft), records);
    expectIn(softPage, "`lamp`, rms error of visibility 0.0100, 2.00 % of `none`'s");
    expectIn(softPage, "![toy on lamp](../pictures/techniques/toy-good.png)\n");
    expectIn(softPage, "## Where it breaks\n\n* **By the error**: on no other scene of these records\n");
}

TEST(TechniquePage, PrefersTheSceneWithMoreShadowAmongEqualOnes) {
    const std::vector<Record> records{hard("little", "none", 0.01), hard("little", "toy", 0), hard("much", "none", 0.5),
                                      hard("much", "toy", 0)};
    const std::string page = pageOf(toy(techniques::Answer::Hard), records);
    expectIn(page, "![toy on much](../pictures/techniques/toy-good.png)");
    expectIn(page, "## Where it breaks\n\n* **By the error**: on no other scene of these records\n");
}

TEST(TechniquePage, OfNoneIsGoodNowhere) {
    techniques::Entry none = toy(techniques::Answer::Hard);
    none.id = "none";
    const std::string page = pageOf(none, {hard("little", "none", 0.01), hard("much", "none", 0.5)});
    expectIn(page, ": on no scene of these records\n\n## Where it breaks\n\n");
    expectIn(page, "![none on much](../pictures/techniques/none-breaks.png)\n");
}

TEST(TechniquePage, OfLevelsOfDetailIsByTheirPopBesideASwitch) {
    std::vector<Record> records;
    for (const auto& [scene, variant, pop] : {std::tuple{"trees", "lod-switch", 0.004},
                                              {"trees", "toy", 0.001},
                                              {"mills", "lod-switch", 0.002},
                                              {"mills", "toy", 0.001}}) {
        records.push_back(test::lodRecord());
        records.back().scene = scene;
        records.back().technique = records.back().variant = variant;
        records.back().values["lod.pop"] = pop;
    }
    const std::string page = pageOf(toy(techniques::Answer::Colour), records);
    expectIn(page,
             "`trees`, pop 0.0010, 25.0 % of `lod-switch`'s\n\n![toy on trees](../pictures/techniques/toy-good.png)\n");
    expectIn(page, "![toy on mills](../pictures/techniques/toy-breaks.png)\n");
    expectIn(page, "* **Cost** in frames of `lod-switch`: 1.10 on `trees`, 1.10 on `mills`");
}

TEST(TechniquePage, HasNoLinksToPicturesThatAreNotThere) {
    const TemporaryFolder pictures;
    const std::vector<Record> records{hard("much", "none", 0.5), hard("much", "toy", 0.1)};
    const std::string page = techniquePage(toy(techniques::Answer::Hard), records, pictures.path());
    EXPECT_EQ(page.find("!["), std::string::npos) << page;
    expectIn(page, "* **By the error**: `much`, mismatching pixels 10.0 %");
}

TEST(TechniquePage, WithoutRecordsSaysSo) {
    const std::string page = pageOf(toy(techniques::Answer::Hard), {hard("much", "toy", 0.1)});
    EXPECT_EQ(page.find("!["), std::string::npos) << page;
    expectIn(page, "## Where it is good\n\n* **By the error**: there is no record of it");
}

} // namespace
} // namespace shadowbench
