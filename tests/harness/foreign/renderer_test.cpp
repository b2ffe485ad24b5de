// What a TOML of renderers may say, and that everything else is refused by file, line and key.
#include "harness/foreign/renderer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/foreign/expected_failures.h"

#include <gtest/gtest.h>

namespace shadowbench::foreign {
namespace {

using namespace std::chrono_literals;

class RenderersFile : public ::testing::Test {
protected:
    std::vector<Renderer> read(const std::string& text) const {
        writeFile(file(), text);
        return readRenderers(file());
    }
    [[nodiscard]] std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const BadInput& error) {
            const std::string what = error.what(), prefix = folder_.path().string() + "/";
            return what.starts_with(prefix) ? what.substr(prefix.size()) : what;
        }
        return "";
    }
    /// A renderer with the lines, where something is wrong.
    [[nodiscard]] std::string refusalOf(const std::string& lines) const {
        return refusal("[[renderer]]\nid = \"a\"\ncommand = [\"x\", \"{scene}\", \"{out}\"]\n" + lines + "\n");
    }
    [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "r.toml"; }

    TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(RenderersFile, GivesARendererAllThatItSays) {
    const auto renderers = read(R"(
[[renderer]]
id = "three-pcf"
title = "three.js, PCF"
source = "three.js r160"
command = ["./render", "--scene={scene}", "--frames", "{frames}", "--out", "{out}"]
definition = "irradiance"
encoding = "srgb"
channel = "R"
depth_is = "distance"
history = true
leave_out_edges = true
force = true
frames = "still"
time_limit = 2.5
settings = { map = 1024, bias = 0.5, filter = "pcf", flat = true }
environment = { DISPLAY = ":7" }
[[renderer]]
id = "plain"
command = "render {scene} > {out}/log"
means = "area" # as it was called
)");
    ASSERT_EQ(renderers.size(), 2U);
    const Renderer& r = renderers[0];
    EXPECT_EQ(r.id, "three-pcf");
    EXPECT_EQ(r.title, "three.js, PCF");
    EXPECT_EQ(r.source, "three.js r160");
    EXPECT_EQ(r.command.size(), 6U);
    EXPECT_EQ(r.definition, Definition::Irradiance);
    EXPECT_EQ(r.encoding, Encoding::Srgb);
    EXPECT_EQ(r.channel, "R");
    EXPECT_EQ(r.depth, Depth::FromEye);
    EXPECT_TRUE(r.remembers && r.leaveOutEdges && r.force);
    EXPECT_FALSE(r.moving);
    EXPECT_EQ(r.limit, 2500ms);
    const std::vector<std::pair<std::string, std::string>> settings{
        {"bias", "0.5"}, {"filter", "pcf"}, {"flat", "true"}, {"map", "1024"}};
    EXPECT_EQ(r.settings, settings);
    EXPECT_EQ(r.environment.front(), std::pair(std::string("DISPLAY"), std::string(":7")));
    EXPECT_EQ(r.folder, folder_.path());
    const Renderer& plain = renderers[1];
    EXPECT_EQ(plain.command, (std::vector<std::string>{"/bin/sh", "-c", "render {scene} > {out}/log"}));
    EXPECT_TRUE(plain.isShellLine && plain.moving && !plain.force);
    EXPECT_EQ(plain.definition, Definition::Area);
    EXPECT_EQ(plain.encoding, Encoding::OfFormat);
    EXPECT_EQ(plain.limit, 10min);
}

TEST_F(RenderersFile, TakesTheEntryForAnotherOneWhenItSaysSomethingElse) {
    const std::string entry = "[[renderer]]\nid = \"a\"\ncommand = [\"x\", \"{scene}\", \"{out}\"]\n";
    const std::string text = read(entry)[0].text;
    EXPECT_EQ(read("# a comment\n" + entry + "[[renderer]]\nid = \"b\"\ncommand = \"{scene}{out}\"\n")[0].text, text);
    EXPECT_NE(read(entry + "time_limit = 3\n")[0].text, text);
    EXPECT_NE(read(entry + "settings.map = 512\n")[0].text, text);
}

TEST_F(RenderersFile, NamesLineAndKeyOfWhatIsWrong) {
    EXPECT_TRUE(refusalOf("encodin = \"linear\"").starts_with("r.toml:4: renderer[1].encodin: unknown key (did you mean"))
        << refusalOf("encodin = \"linear\"");
    EXPECT_TRUE(
        contains(refusalOf("definition = \"soft\""), "r.toml:4: renderer[1].definition: expected one of hard, area,"));
    EXPECT_TRUE(contains(refusalOf("time_limit = 0"), "expected a number above 0"));
    EXPECT_TRUE(contains(refusalOf("settings = { map = [1] }"), "renderer[1].settings.map: expected a text, a number"));
    EXPECT_TRUE(contains(refusalOf("environment = { A = 1 }"), "renderer[1].environment.A: expected a text"));
    EXPECT_TRUE(contains(refusalOf("[[renderer]]\nid = \"a\"\ncommand = \"{scene}{out}\""), "another renderer \"a\""));
    EXPECT_TRUE(contains(refusal("[[rendrer]]\n"), "r.toml:1: rendrer: unknown key (did you mean \"renderer\"?)"));
    EXPECT_TRUE(contains(refusal("renderer = []\n"), "describe a renderer under [[renderer]]"));
    EXPECT_TRUE(contains(refusal("renderer = 3\n"), "r.toml:1: renderer: expected a list"));
    EXPECT_TRUE(contains(refusal("renderer = [3]\n"), "expected a table"));
    EXPECT_TRUE(contains(refusal(""), "renderer: missing"));
    EXPECT_TRUE(contains(refusal("[[renderer]\n"), "not valid TOML"));
}

TEST_F(RenderersFile, RefusesIdsThatCannotBePartOfATechniquesName) {
    EXPECT_EQ(refusal("[[renderer]]\nid = \"engine_2.1-b\"\ncommand = \"{scene}{out}\"\n"), "");
    for (const char* id : {"", "A", "a b", "a:b", "a,b", "../a", ".a", "-a"})
        EXPECT_TRUE(contains(refusal(std::string("[[renderer]]\nid = \"") + id + "\"\ncommand = \"{scene}{out}\"\n"),
                             "cannot be an id"))
            << id;
}

TEST_F(RenderersFile, RefusesCommandsThatCannotBeCalled) {
    const auto command = [&](const std::string& value) { return refusal("[[renderer]]\nid = \"a\"\ncommand = " + value); };
    EXPECT_TRUE(contains(command("[]"), "is empty"));
    EXPECT_TRUE(contains(command("[\"x\", \"{sceen}\", \"{out}\"]"), "no placeholder {sceen} (did you mean \"scene\"?)"));
    EXPECT_TRUE(contains(command("[\"x\", \"{out}\"]"), "{scene} is missing"));
    EXPECT_TRUE(contains(command("\"x {scene}\""), "{out} is missing"));
    EXPECT_EQ(command("\"x {scene} {out} ${home} {A} awk '{ print }'\""), "") << "braces of the shell's own";
}

TEST_F(RenderersFile, OfTheDocumentationCanBeRead) {
    const std::string page = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/external.md");
    const std::string fence = "```toml\n";
    const std::size_t begin = page.find(fence) + fence.size();
    const auto renderers = read(page.substr(begin, page.find("```", begin) - begin));
    ASSERT_EQ(renderers.size(), 1U);
    EXPECT_EQ(renderers[0].id, "my-engine");
    EXPECT_EQ(renderers[0].settings.size(), 2U);
}

TEST(FilledIn, ReplacesPlaceholdersAndNothingElse) {
    const std::vector<std::pair<std::string, std::string>> values{{"scene", "/tmp/it's"}, {"out", "{scene}"}};
    EXPECT_EQ(filledIn("--scene={scene}:{out} {other} {scene", values, false), "--scene=/tmp/it's:{scene} {other} {scene");
    EXPECT_EQ(filledIn("ls {scene} ${scene}", values, true), "ls '/tmp/it'\\''s' ${scene}");
}

TEST_F(RenderersFile, SharesKeysThatARendererDoesNotSayItself) {
    const auto renderers = read(R"(
[client]
engine = "Mine"
version = "4.2"
maintainer = "me"
[shared]
command = ["./render", "{scene}", "{out}"]
source = "mine 4.2"
time_limit = 30
[[renderer]]
id = "a"
arguments = ["--map=512"]
[[renderer]]
id = "b"
source = "mine 4.1"
lights = ["point", "directional"]
division = "tuned"
advice = "Use it."
)");
    ASSERT_EQ(renderers.size(), 2U);
    EXPECT_EQ(renderers[0].command, (std::vector<std::string>{"./render", "{scene}", "{out}", "--map=512"}));
    EXPECT_EQ(renderers[1].command, (std::vector<std::string>{"./render", "{scene}", "{out}"}));
    EXPECT_EQ(renderers[0].source, "mine 4.2");
    EXPECT_EQ(renderers[1].source, "mine 4.1");
    EXPECT_EQ(renderers[1].limit, 30s);
    EXPECT_NE(renderers[0].text.find("--map=512"), std::string::npos);
    EXPECT_NE(renderers[0].text.find("time_limit"), std::string::npos) << "what is shared is part of the entry, too";
    EXPECT_EQ(renderers[0].division, Division::Defaults);
    EXPECT_EQ(renderers[1].division, Division::Tuned);
    EXPECT_EQ(renderers[1].lights, (std::vector{LightKind::Point, LightKind::Directional}));
    EXPECT_TRUE(renderers[0].lights.empty());
    const auto client = readClient(file());
    ASSERT_TRUE(client);
    EXPECT_EQ(client->engine + client->version + client->maintainer, "Mine4.2me");
    EXPECT_EQ(client->retired, "");
}

TEST_F(RenderersFile, SaysWhyItIsRetiredAndWhatIsExpectedToFail) {
    const std::string entry = "[[renderer]]\nid = \"a\"\ncommand = [\"x\", \"{scene}\", \"{out}\"]\n";
    const std::string client =
        "[client]\nengine = \"Mine\"\nversion = \"4\"\nmaintainer = \"me\"\nretired = \"gone, 2027\"\n";
    const std::string fails = "[[expect]]\nscene = \"sun\"\nrenderers = [\"a*\"]\nsays = \"no shadow\"\nreason = ";
    read(client + entry + fails + "\"it ends\"\n");
    EXPECT_EQ(readClient(file())->retired, "gone, 2027");
    const auto failures = readExpectedFailures(file());
    ASSERT_EQ(failures.size(), 1U);
    EXPECT_EQ(failures[0].says + failures[0].reason, "no shadowit ends");
    EXPECT_TRUE(failures[0].covers("sun", "a"));
    EXPECT_FALSE(failures[0].covers("hands", "a"));
    EXPECT_FALSE(failures[0].covers("sun", "b"));
    read(entry);
    EXPECT_TRUE(readExpectedFailures(file()).empty());
    read(entry + fails + "\"\"\n");
    EXPECT_THROW(readExpectedFailures(file()), BadInput);
}

TEST_F(RenderersFile, RefusesWhatCannotBeShared) {
    const std::string entry = "[[renderer]]\nid = \"a\"\ncommand = [\"x\", \"{scene}\", \"{out}\"]\n";
    EXPECT_EQ(refusal("[shared]\nid = \"a\"\n" + entry).substr(0, 21), "r.toml:2: shared.id: ");
    EXPECT_NE(refusalOf("division = \"tuned\"").find("has `advice`"), std::string::npos);
    EXPECT_NE(refusalOf("advice = \"Use it.\"").find("has `advice`"), std::string::npos);
    EXPECT_NE(refusalOf("lights = [\"sun\"]").find("lights[1]"), std::string::npos) << refusalOf("lights = [\"sun\"]");
    EXPECT_NE(refusalOf("lights = []").find("is empty"), std::string::npos);
    EXPECT_NE(
        refusal("[[renderer]]\nid = \"a\"\ncommand = \"x {scene} {out}\"\narguments = [\"y\"]\n").find("a list of words"),
        std::string::npos);
    EXPECT_FALSE(readClient(file()));
}

} // namespace
} // namespace shadowbench::foreign
