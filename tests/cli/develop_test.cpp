// `develop`: each save of a technique folder on a page, and what the server behind it refuses.
#include "tests/support/live_page.h"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

double figure(const Json& state, const std::string& name, const std::string& which = "now") {
    for (const Json& f : state["rows"][0]["figures"])
        if (f["name"] == name) return f[which];
    throw std::runtime_error("there is no figure " + name);
}

const std::string allLit = replaced(mapShader, "shadowTest(depths, testedPoint(receiver))", "1.0");

class Develop : public testing::Test {
protected:
    LivePage page(const std::vector<std::string>& more = {}) const { return {mine_.path(), temporary_.path(), more}; }

    /// Programs that have the technique folder among their words.
    [[nodiscard]] int programs() const {
        int count = 0;
        for (const fs::directory_entry& process : fs::directory_iterator("/proc")) {
            std::ifstream words(process.path() / "cmdline");
            const std::string all{std::istreambuf_iterator<char>(words), {}};
            if (all.find(mine_.path().string()) != std::string::npos) ++count;
        }
        return count;
    }
    [[nodiscard]] bool leavesNothing() const { return fs::is_empty(temporary_.path()) && programs() == 0; }

    WrittenTechnique mine_;
    TemporaryFolder temporary_;
};

TEST_F(Develop, ShowsTheFolderAndEachSaveBesideTheKeptState) {
    const LivePage page = this->page();
    const auto html = page.client().Get("/");
    ASSERT_TRUE(html);
    EXPECT_EQ(html->status, 200);
    EXPECT_NE(html->get_header_value("Content-Security-Policy").find("default-src 'none'"), std::string::npos);

    const Json first = page.drawnAfter(0);
    EXPECT_EQ(first["rows"][0]["variant"], "my:mine");
    EXPECT_EQ(first["rows"][0]["kept"], first["rows"][0]["last"]);
    EXPECT_EQ(first["command"].get<std::string>().find("shadowbench run --technique-folder " + mine_.path().string()), 0U);
    const int number = first["rows"][0]["last"];
    for (const char* kind : {"visibility", "truth", "error"}) {
        const auto png = page.client().Get(fmt::format("/pictures/{}/{}.png", number, kind));
        ASSERT_TRUE(png);
        EXPECT_EQ(png->body.substr(1, 3), "PNG") << kind;
    }

    mine_.write("resolve.frag", allLit);
    const Json lit = page.drawnAfter(number);
    EXPECT_EQ(figure(lit, "false shadow"), 0);
    EXPECT_GT(figure(lit, "leak"), 10 * figure(first, "leak"));
    EXPECT_EQ(figure(lit, "leak", "kept"), figure(first, "leak"));

    EXPECT_EQ(page.client().Post("/keep", page.ownOrigin(), "", "text/plain")->status, 204);
    const Json kept = page.drawnAfter(number);
    EXPECT_EQ(figure(kept, "leak", "kept"), figure(lit, "leak"));
    EXPECT_EQ(page.client().Get(fmt::format("/pictures/{}/error.png", number))->status, 404) << "no state beyond the two";
}

TEST_F(Develop, AnErrorStandsWithItsPlaceUntilItIsSetRight) {
    const LivePage page = this->page();
    const int number = page.drawnAfter(0)["rows"][0]["last"];
    mine_.write("resolve.frag", replaced(mapShader, "receiver.seen ?", "reciever.seen ?"));
    const Json wrong =
        page.stateWhere([](const Json& state) { return !state["rows"].empty() && state["rows"][0]["error"] != ""; });
    EXPECT_EQ(wrong["rows"][0]["error"],
              "resolve.frag:8: error: `reciever' undeclared (did you mean \"receiver\" or \"Receiver\"?)");
    EXPECT_EQ(wrong["rows"][0]["last"], number);

    mine_.write("technique.toml", replaced(mapToml, "\"casters\"", "\"caster\""));
    const Json refused = page.stateWhere([](const Json& state) { return state["error"] != ""; });
    EXPECT_EQ(refused["error"].get<std::string>().find("technique.toml:"), 0U) << refused["error"];
    EXPECT_EQ(refused["rows"][0]["last"], number);

    mine_.write("technique.toml", mapToml);
    { // as an editor that writes in place, in two steps
        std::ofstream file(mine_.path() / "resolve.frag");
        file << mapShader.substr(0, 100) << std::flush;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        file << mapShader.substr(100);
    }
    const Json right = page.drawnAfter(number);
    EXPECT_EQ(figure(right, "error"), figure(right, "error", "kept"));
}

TEST_F(Develop, ASaveOfASceneIsDrawnAgainstItsOwnTruth) {
    const Folder room;
    const std::string other = room.write("other.toml", tinyScene());
    const LivePage page = this->page({"--scene", other});
    const auto truth = [&](const Json& state) {
        return page.client().Get(fmt::format("/pictures/{}/truth.png", int(state["rows"][1]["last"])))->body;
    };
    const Json first = page.drawnAfter(0);
    ASSERT_EQ(first["rows"][1]["scene"], "other");
    const int number = first["rows"][0]["last"];
    const std::string before = truth(first);
    room.write("other.toml", replaced(tinyScene(), "at = [0.13, 1.2, 0.21]", "at = [0.9, 1.2, 0.21]"));
    const Json moved = page.drawnAfter(number);
    EXPECT_NE(truth(moved), before);
    room.write("other.toml", replaced(tinyScene(), "title", "titel"));
    const Json wrong = page.stateWhere([](const Json& state) { return state["error"] != ""; });
    EXPECT_EQ(wrong["error"], other + ":2: titel: unknown key (did you mean \"title\"?)");
    room.write("other.toml", tinyScene());
    EXPECT_EQ(truth(page.drawnAfter(moved["rows"][0]["last"])), before);
}

TEST_F(Develop, ANewerSaveStopsADrawingThatHangs) {
    const LivePage page = this->page();
    const int number = page.drawnAfter(0)["rows"][0]["last"];
    mine_.write("resolve.frag", hangingShader);
    EXPECT_TRUE(page.stateWhere([](const Json& state) { return state["drawing"].get<bool>(); })["drawing"]);
    mine_.write("resolve.frag", allLit);
    EXPECT_EQ(figure(page.drawnAfter(number), "false shadow"), 0);
}

TEST_F(Develop, ARowThatHangsNamesItsPassAndTheOthersAreShown) {
    mine_.write("technique.toml", replaced(mapToml, "title", "variants = [\"map=512\", \"\"]\ntitle"));
    mine_.write("resolve.frag", replaced(hangingShader, "k < 60000", "k < (MAP == 512 ? 60000 : 1)"));
    ::setenv("SHADOWBENCH_MAX_CELL_SECONDS", "2", 1);
    const LivePage page = this->page();
    ::unsetenv("SHADOWBENCH_MAX_CELL_SECONDS");
    const Json state = page.stateWhere([](const Json& news) { return news["rows"].size() == 2; });
    EXPECT_EQ(
        state["rows"][0]["error"],
        "the process that rendered it took longer than 2 s in the pass \"resolve\" and was ended: shorten its shaders' "
        "loops, or raise SHADOWBENCH_MAX_CELL_SECONDS");
    EXPECT_EQ(state["rows"][1]["error"], "");
}

TEST_F(Develop, WhatNothingUsesIsAWarningUntilItIsUsed) {
    const std::string unused = "[parameter.radius]\ndefault = 1\nrange = [1, 8]\nmeaning = \"texels\"\n";
    mine_.write("technique.toml", replaced(mapToml, "[target.depths]", unused + "[target.depths]"));
    const LivePage page = this->page();
    const Json first = page.drawnAfter(0);
    ASSERT_EQ(first["warnings"].size(), 1U);
    EXPECT_EQ(first["warnings"][0].get<std::string>().find("technique.toml:10: parameter.radius: no shader reads RADIUS"),
              0U)
        << first["warnings"];
    mine_.write("resolve.frag", replaced(mapShader, ": 1.0", ": float(RADIUS)"));
    EXPECT_TRUE(page.drawnAfter(first["rows"][0]["last"])["warnings"].empty());
}

TEST_F(Develop, StrangersAreRefused) {
    const LivePage page = this->page();
    const auto statusOf = [&](const std::string& path, const httplib::Headers& headers) {
        return page.client().Get(path, headers)->status;
    };
    ASSERT_EQ(statusOf("/", {{"Host", "evil.example:" + std::to_string(page.port())}}), 421); // events would never end
    EXPECT_EQ(statusOf("/events", {{"Host", "evil.example"}}), 421);
    EXPECT_EQ(statusOf("/", {{"Host", "127.0.0.1:1"}}), 421);
    EXPECT_EQ(statusOf("/", {{"Host", "localhost:" + std::to_string(page.port())}}), 200);
    for (const char* path : {"/technique.toml", "/pictures/../../technique.toml", "/pictures/%2e%2e/visibility.png",
                             "/pictures/99999/error.png", "/index.html"})
        EXPECT_EQ(statusOf(path, {}), 404) << path;
    const auto keepFrom = [&](const httplib::Headers& headers) {
        return page.client().Post("/keep", headers, "", "text/plain")->status;
    };
    EXPECT_EQ(keepFrom({{"Origin", "http://evil.example"}}), 403);
    EXPECT_EQ(keepFrom({{"Origin", "null"}}), 403);
    EXPECT_EQ(keepFrom({}), 403);
    EXPECT_EQ(keepFrom(page.ownOrigin()), 204);
}

TEST_F(Develop, AnInterruptLeavesNoFolderAndNoProgram) {
    for (const int signal : {SIGINT, SIGTERM}) {
        mine_.write("resolve.frag", hangingShader);
        LivePage page = this->page();
        EXPECT_TRUE(page.stateWhere([](const Json& state) { return state["drawing"].get<bool>(); })["drawing"]);
        while (programs() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        EXPECT_FALSE(leavesNothing());
        EXPECT_EQ(WTERMSIG(page.end(signal)), signal);
        EXPECT_TRUE(leavesNothing());
    }
}

TEST_F(Develop, AKillLeavesNoProgramAndTheNextOneRemovesItsFolder) {
    mine_.write("resolve.frag", hangingShader);
    {
        LivePage page = this->page();
        EXPECT_TRUE(page.stateWhere([](const Json& state) { return state["drawing"].get<bool>(); })["drawing"]);
        while (programs() < 3) std::this_thread::sleep_for(std::chrono::milliseconds(5)); // its run, and that one's worker
        page.end(SIGKILL);
    }
    for (int ticks = 0; programs() > 0 && ticks < 400; ++ticks) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(programs(), 0);
    mine_.write("resolve.frag", mapShader);
    LivePage next = this->page();
    EXPECT_EQ(next.drawnAfter(0)["rows"][0]["error"], "");
    next.end(SIGTERM);
    EXPECT_TRUE(leavesNothing());
}

TEST_F(Develop, TwoRunBesideEachOtherOnPortsOfTheirOwn) {
    const LivePage one = page(), other = page();
    EXPECT_NE(one.port(), other.port());
    EXPECT_EQ(figure(one.drawnAfter(0), "error"), figure(other.drawnAfter(0), "error"));
}

TEST_F(Develop, ANewTechniqueIsShownAtOnce) {
    const Folder room;
    const Outcome made = shell("shadowbench new-technique mine --like vsm --folder " + room / "mine");
    EXPECT_EQ(made.code, 0) << made.output;
    EXPECT_NE(made.output.find("see it: shadowbench develop " + room / "mine"), std::string::npos) << made.output;
    const LivePage page(room / "mine", temporary_.path());
    EXPECT_LT(figure(page.drawnAfter(0), "leak"), 0.05);
    EXPECT_EQ(shell("shadowbench new-technique mine --folder " + room / "mine").code, 2);
    EXPECT_EQ(shell("shadowbench develop " + room / "nothing").code, 2);
}

} // namespace
} // namespace shadowbench
