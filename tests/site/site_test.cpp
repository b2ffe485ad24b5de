// Whole sites, made from records.
#include "base/files.h"
#include "base/temporary_folder.h"
#include "site/gate_page.h"
#include "site/menu.h"
#include "site/names.h"
#include "site/site.h"
#include "tests/support/report_examples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;
using namespace test;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Values of all attributes `name` in the HTML.
std::vector<std::string> attributes(const std::string& html, const std::string& name) {
    std::vector<std::string> values;
    const std::string start = " " + name + "=\"";
    for (std::size_t at = html.find(start); at != std::string::npos; at = html.find(start, at + 1)) {
        const std::size_t from = at + start.size();
        values.push_back(html.substr(from, html.find('"', from) - from));
    }
    return values;
}

std::vector<Record> bothScenes() {
    std::vector<Record> records = hardScene();
    for (const Record& record : softScene()) records.push_back(record);
    return records;
}

std::vector<fs::path> pagesOf(const fs::path& site) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(site))
        if (entry.path().extension() == ".html") found.push_back(entry.path());
    return found;
}

/// Addresses on pages that lead nowhere.
std::set<std::string> deadLinks(const fs::path& site) {
    std::set<std::string> dead;
    for (const fs::path& page : pagesOf(site)) {
        const std::string html = readFile(page);
        for (const char* name : {"href", "src"})
            for (const std::string& address : attributes(html, name)) {
                const std::string path = address.substr(0, address.find('#'));
                if (path.empty() || path.starts_with("data:")) continue;
                if (!fs::exists(page.parent_path() / path)) dead.insert(page.filename().string() + ": " + address);
            }
    }
    return dead;
}

/// A site of both scenes, made once: drawing its charts takes longest.
const fs::path& bothSite() {
    static const TemporaryFolder folder;
    static const fs::path made = [] {
        writeFile(folder.path() / "results.jsonl", "");
        return writeSite({.records = bothScenes()}, folder.path()).parent_path();
    }();
    return made;
}

class Site : public testing::Test {
protected:
    [[nodiscard]] const fs::path& folder() const { return folder_.path(); }

private:
    TemporaryFolder folder_;
};

TEST(BothSite, HasAPageASceneAndATruthAndNoDeadLink) {
    for (const char* file :
         {"index.html", "scenes/dueling-frusta.html", "scenes/overlapping-occluders.html", "truth.html",
          "truth/dueling-frusta.html", "assets/d3.js", "pareto-dueling-frusta.svg", "pareto-dueling-frusta.pdf",
          "tables/choose-answers.tex", "choose.html", "docs/metrics.md", "report.md", "results.csv"})
        EXPECT_TRUE(fs::exists(bothSite() / file)) << file;
    EXPECT_EQ(deadLinks(bothSite()), std::set<std::string>());
}

TEST(BothSite, AnswersOnItsFirstPageWhichTechniqueToTake) {
    const std::string page = readFile(bothSite() / "choose.html");
    const std::string answers =
        page.substr(page.find("data-table=\"answers\""), page.find("</table>") - page.find("data-table=\"answers\""));
    EXPECT_TRUE(has(answers, ">sm-uniform<")) << answers; // what errs less lacks moving casters or open meshes
    EXPECT_TRUE(has(answers, "none is within tolerance; this one is nearest")) << answers;
}

TEST(BothSite, ShowsEveryFigureUnroundedWithoutAScript) {
    const std::string page = readFile(bothSite() / "scenes/dueling-frusta.html");
    for (const char* part : {"data-v=\"0.0487\"", "data-v=\"4.7\"", "<img src=\"../pareto-dueling-frusta.svg\"",
                             "needs an area light", "data-chart=\"scatter\""})
        EXPECT_TRUE(has(page, part)) << part;
    EXPECT_FALSE(has(page, "<style"));
    EXPECT_EQ(attributes(page, "style"), std::vector<std::string>());
    EXPECT_EQ(attributes(page, "onclick"), std::vector<std::string>());
}

TEST_F(Site, SaysWhatACostBuysOnTheCardWhereThatIsModelled) {
    std::vector<Record> records{hardCell("sm-uniform", 0.05, 1), hardCell("sm-lispsm", 0.01, 1.2),
                                hardCell("sm-cascaded", 0.001, 3)};
    const auto bought = [&] {
        writeSite({.records = records}, folder());
        const std::string page = readFile(folder() / "choose.html");
        const std::size_t at = page.find("data-table=\"budgets\"");
        std::string table = page.substr(at, page.find("</table>", at) - at), names;
        for (const char* name : {"sm-uniform", "sm-lispsm", "sm-cascaded"}) {
            int times = 0;
            for (std::size_t i = table.find(">" + std::string(name) + " <small>"); i != std::string::npos;
                 i = table.find(">" + std::string(name) + " <small>", i + 1))
                ++times;
            names += fmt::format("{} {} ", name, times);
        }
        return names;
    };
    // At 1, 1.25, 1.5, 2, 4 and 8 frames of sm-uniform.
    EXPECT_EQ(bought(), "sm-uniform 1 sm-lispsm 3 sm-cascaded 2 ");
    EXPECT_TRUE(has(readFile(folder() / "index.html"), "src=\"pareto-dueling-frusta.svg\""));
    const double milliseconds[] = {1, 3, 1.2};
    for (std::size_t i = 0; i < 3; ++i) records[i].modelled["gtx-1080@1920x1080"] = {milliseconds[i], 0.5, 6, false, {}};
    EXPECT_EQ(bought(), "sm-uniform 1 sm-lispsm 0 sm-cascaded 5 ");
    const std::string index = readFile(folder() / "index.html");
    for (const char* part : {"src=\"modelled-gtx-1080-1920x1080-dueling-frusta.svg\"", "data-x=\"modelled\"",
                             "data-modelledlabel=\"ms on gtx-1080 at 1920×1080, modelled", "data-key=\"cost\""})
        EXPECT_TRUE(has(index, part)) << part;
}

TEST_F(Site, CountsTechniquesAndHasOtherRenderersOnAPageOfTheirOwn) {
    std::vector<Record> records = hardScene();
    records.push_back(hardCell("sm-uniform:map=64", 0.1, 1));
    records.push_back(hardCell("external:engine", 0, 0.1)); // the best and the cheapest of all
    records.back().technique = records.back().variant;
    records.back().values["cost.time.ratio"].reset();
    records.back().external = ExternalInfo{.title = "An engine", .source = "version 4"};
    writeSite({.records = records}, folder());
    const std::string index = readFile(folder() / "index.html"), choose = readFile(folder() / "choose.html");
    EXPECT_TRUE(has(index, "4 techniques in 6 variants on 1 scene; beside them 1 setting of other renderers.")) << index;
    for (const char* part : {"href=\"choose.html\"", "href=\"engines.html\"", "<meta name=\"description\"", "og:title",
                             "<small>volume-zfail</small>", "docs/metrics.md"})
        EXPECT_TRUE(has(index, part)) << part;
    EXPECT_FALSE(has(index, "<img src=\"\"")) << "no place for pictures that are not there";
    const std::string answers = choose.substr(choose.find("<tbody>"), choose.find("</tbody>") - choose.find("<tbody>"));
    EXPECT_FALSE(has(answers, "external:engine")) << answers;
    EXPECT_TRUE(has(answers, "class=\"within number\"") || has(answers, ">nearest") || has(answers, "class=\"nearest\""))
        << answers;
    EXPECT_FALSE(has(choose.substr(choose.find("data-table=\"all\"")), "external:engine"));
    EXPECT_TRUE(has(readFile(folder() / "engines.html"), "An engine"));
    EXPECT_EQ(deadLinks(folder()), std::set<std::string>());
}

TEST_F(Site, HasAPageForEachEngineAndNamesRowsWithTheSameImages) {
    std::vector<Record> records;
    const auto add = [&](const char* id, const char* source, const std::string& images) {
        for (const char* scene : {"simple", "trees", "windmills"}) {
            records.push_back(hardCell(std::string("external:") + id, 0.03, 1));
            records.back().scene = scene;
            records.back().technique = records.back().variant;
            records.back().parameters = {{"means", "hard"}, {"map", "512"}};
            records.back().external = ExternalInfo{.title = id, .source = source};
            records.back().images = images.empty() ? "" : images + scene;
        }
    };
    add("one-pcf", "One 4.2, OpenGL", "a");
    add("one-vsm", "One 4.1", "b");
    add("copy", "Two Engines 1", "a");
    add("silent", "", "");
    writeSite({.records = records}, folder());
    const std::string all = readFile(folder() / "engines.html"), one = readFile(folder() / "engines/One.html");
    for (const char* part :
         {"one-pcf", "One 4.1", "map = 512", "run --external LIST --technique external:one-vsm --scene simple"})
        EXPECT_TRUE(has(one, part)) << part;
    EXPECT_FALSE(has(one, "external:copy"));
    for (const char* page : {"engines/Two_Engines-9d59718e.html", "engines/silent.html"})
        EXPECT_TRUE(fs::exists(folder() / page)) << page;
    const std::size_t at = all.find("data-table=\"same\"");
    ASSERT_NE(at, std::string::npos);
    const std::string same = all.substr(at, all.find("</table>", at) - at);
    EXPECT_TRUE(has(same, "one-pcf") && has(same, "copy")) << same;
    EXPECT_FALSE(has(same, "one-vsm") || has(same, "silent")) << same;
    EXPECT_EQ(deadLinks(folder()), std::set<std::string>());
}

TEST(SceneGroups, SortScenesByWhatTheyAreFor) {
    std::vector<Record> records(4, hardCell("pcf", 0.1, 1));
    records[0].scene = "simple";
    records[1].scene = "contact";
    records[2].scene = "mine";
    records[3].profile = "standard";
    records[3].width = records[3].height = 512;
    records[3].scene = "simple" + sizeSuffix(records[3]);
    const std::vector<LinkGroup> groups = sceneGroups(records);
    ASSERT_EQ(groups.size(), 4U);
    const std::vector<std::pair<std::string, std::string>> expected{{"Standard scenes", "simple"},
                                                                    {"Where techniques fail", "contact"},
                                                                    {"Own scenes", "mine"},
                                                                    {"At 512²", "simple, standard, 512²"}};
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_EQ(groups[i].title, expected[i].first);
        ASSERT_EQ(groups[i].links.size(), 1U);
        EXPECT_EQ(groups[i].links.front().title, expected[i].second);
    }
}

TEST_F(Site, OfTheSameRecordsIsTheSameBytes) {
    writeFile(folder() / "results.jsonl", "");
    writeSite({.records = bothScenes()}, folder());
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder())) {
        if (!entry.is_regular_file()) continue;
        const fs::path twin = bothSite() / entry.path().lexically_relative(folder());
        EXPECT_EQ(readFile(entry.path()), readFile(twin)) << entry.path();
    }
}

TEST_F(Site, HasAPageOfEachClaimWhereItsRecordsDecideOne) {
    Record history = hardCell("sm-history", 0.0009, 1.19);
    history.figures["history_bytes"] = 8;
    writeSite({.records = {history}}, folder());
    EXPECT_TRUE(has(readFile(folder() / "claims.html"), "claims/K8.html"));
    for (const char* claim : {"K4", "K8"}) EXPECT_TRUE(fs::exists(folder() / "claims" / (claim + std::string(".html"))));
    EXPECT_EQ(deadLinks(folder()), std::set<std::string>());
}

TEST_F(Site, HasNoClaimsWhereItsRecordsDecideNone) {
    writeSite({.records = {hardScene().front()}}, folder());
    EXPECT_FALSE(fs::exists(folder() / "claims.html"));
    EXPECT_FALSE(fs::exists(folder() / "claims"));
    EXPECT_FALSE(has(readFile(folder() / "index.html"), "claims.html"));
}

TEST_F(Site, ShowsHostileNamesAsText) {
    const std::string script = "\"'><script>alert(1)</script><img src=x onerror=alert(1)>", longest(1000000, 'x');
    std::vector<Record> records = hardScene();
    for (Record& record : records) record.scene = script;
    records[1].variant = script;
    records[1].technique = "NaN";
    records[2].variant = longest;
    records[2].profile = records[2].commit = records[2].environment.cpu = script;
    records[3].variant = "../../../escape";
    records[4].reason = script;
    writeSite({.records = records}, folder());
    EXPECT_EQ(deadLinks(folder()), std::set<std::string>());
    std::size_t bytes = 0;
    for (const fs::path& page : pagesOf(folder())) {
        const std::string html = readFile(page);
        EXPECT_FALSE(has(html, "<script>")) << page;
        EXPECT_FALSE(has(html, "<img src=x")) << page;
        bytes += html.size();
    }
    EXPECT_LT(bytes, 1000000U); // the long name is cut
    EXPECT_TRUE(has(readFile(folder() / "choose.html"), "&lt;script&gt;alert(1)&lt;/script&gt;"));
}

TEST_F(Site, OfNoRecordsSaysSo) {
    writeSite({.records = {}}, folder());
    EXPECT_TRUE(has(readFile(folder() / "index.html"), "There are no records."));
}

TEST_F(Site, FitsIntoOneFileThatNeedsNoOther) {
    const fs::path file = folder() / "single.html";
    writeSingleFile(bothSite(), file);
    const std::string html = readFile(file);
    std::set<std::string> ids;
    for (const std::string& id : attributes(html, "id")) EXPECT_TRUE(ids.insert(id).second) << id << " twice";
    for (const char* name : {"href", "src"})
        for (const std::string& address : attributes(html.substr(0, html.rfind("<script>")), name)) {
            EXPECT_TRUE(address.starts_with("#") || address.starts_with("data:")) << address;
            EXPECT_TRUE(!address.starts_with("#") || ids.contains(address.substr(1))) << address;
        }
    EXPECT_TRUE(has(html, "data:image/svg+xml;base64,"));
}

TEST_F(Site, ComparesWithOlderRecordsAndShowsTheWorstFirst) {
    std::vector<Record> base = bothScenes(), head = bothScenes();
    for (Record& record : head) record.commit = "decade";
    head[2].values["accuracy.mismatch"] = 0.002;
    head[1].values["accuracy.mismatch"] = 0.4;
    head[1].images = head[2].images = "drawn otherwise";
    writeSite({.records = head, .base = base, .baseName = "before.jsonl"}, folder());
    const std::string page = readFile(folder() / "gate.html");
    EXPECT_TRUE(has(page, "Accuracy or stability is worse")) << page;

    EXPECT_TRUE(has(page, "./bench run --images --cost none")) << page;
    EXPECT_TRUE(has(page, "expected results compared")) << page;
    EXPECT_LT(page.find("worse: "), page.find("id=\"classes\"")) << "the worst, then how many, then all";
    EXPECT_LT(page.find("id=\"classes\""), page.find("id=\"changes\""));
    EXPECT_LT(page.find(">sm-uniform<"), page.find(">sm-history:base=lispsm<"));
}

} // namespace
} // namespace shadowbench::site
