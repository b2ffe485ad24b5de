// Folders that are broken in every way that a key, a value or a file can be: each is one line with its place.
#include "base/one_line.h"
#include "tests/support/message_of.h"
#include "tests/support/technique_folders.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/stat.h>
#include <utility>

namespace shadowbench {
namespace {

/// With each key that there is.
const std::string fullToml = R"toml(id = "full"
title = "All that there is"
source = "Nobody 2026"
answer = "soft"
history = true
view = "light-sample"
variants = ["", "map=512,kind=wide"]
lacks = ["moving-light"]

[parameter.map]
default = 1024
range = [16, 8192]
meaning = "texels per side"
source = "a book"

[parameter.radius]
default = 2.5
range = [0.0, 8.0]
meaning = "texels"

[parameter.kind]
default = "narrow"
choices = ["narrow", "wide"]
meaning = "the kernel"

[target.depths]
format = "Depth32F"
size = "map"
compare = true

[target.moments]
format = "RG32F"
size = "map"
filter = "linear"
mipmaps = true

[target.layers]
format = "R32F"
size = 256

[target.mean]
format = "RGBA32F"
size = "image"
history = true

[target.mask]
format = "Depth32FStencil8"
size = "image"

[[pass]]
name = "moments"
draw = "casters"
fragment = "moments.frag"
to = ["moments", "depths"]
offset = [2, "radius"]
clear = [1, 1, 0, 0]
cull = "front"

[[pass]]
name = "layers"
draw = "casters"
fragment = "moments.frag"
to = "layers"
blend = "add"
depth_test = false

[[pass]]
name = "sums"
compute = "sums.comp"
to = "moments"
work_groups = [1, "moments", 1]

[[pass]]
name = "mask"
draw = "screen"
fragment = "mean.frag"
to = "mask"

[pass.stencil]
test = "not-equal"
ref = 1
pass = "increment"
fail = "invert"

[[pass]]
name = "mean"
draw = "screen"
fragment = "mean.frag"
to = "mean"
define = { SOURCE = "moments", STEP = "ivec2(1, 0)" }
repeat = 2
group = "there and back"

[[pass]]
name = "resolve"
draw = "screen"
fragment = "resolve.frag"
to = "visibility"
)toml";

class BrokenFolder : public testing::Test {
protected:
    BrokenFolder() {
        for (const char* file : {"moments.frag", "mean.frag", "sums.comp"}) folder_.write(file, "void main() {}\n");
    }

    /// What is said of it, without the folder; "" of one that is read.
    [[nodiscard]] std::string said(const std::string& toml) const {
        std::ofstream(folder_.path() / "technique.toml") << toml; // not flushed to the disk, as writeFile would
        try {
            folder_.entry();
            return "";
        } catch (const BadInput& error) {
            const std::string path = (folder_.path() / "").string();
            const std::string message = error.what();
            EXPECT_EQ(message, onOneLine(message));
            return message.starts_with(path) ? message.substr(path.size()) : message;
        } catch (const std::exception& error) {
            ADD_FAILURE() << toml << "\n" << error.what();
            return "";
        }
    }

    static std::vector<std::string> linesOf(const std::string& text) {
        std::istringstream all(text);
        std::vector<std::string> lines;
        for (std::string line; std::getline(all, line);) lines.push_back(line);
        return lines;
    }

    /// The full file with another line in place of number `at`, from 0.
    static std::string with(std::size_t at, const std::string& line) {
        std::string text;
        const std::vector<std::string> lines = linesOf(fullToml);
        for (std::size_t i = 0; i < lines.size(); ++i) text += (i == at ? line : lines[i]) + "\n";
        return text;
    }

    WrittenTechnique folder_{fullToml};
};

const std::vector<std::string> wrongValues{
    "true",       "\"xyz\"", "\"\"",        "42",         "-7",        "1.5",           "nan",
    "inf",        "1e300",   "99999999999", "[]",         "[1, 2]",    "[2, 1]",        "[\"a\", \"b\"]",
    "[[1], [2]]", "{}",      "{ a = 1 }",   "1979-05-27", "\"a\\nb\"", "\"a\\u0000b\"", "\"\"\"",
    "01",         "'",       "[",           "\xff"};

/// Keys that may have it: texts for people, and other choices that are as good.
bool mayBe(const std::string& key, const std::string& value) {
    const auto is = [&](std::initializer_list<const char*> keys) { return std::ranges::count(keys, key) > 0; };
    if (is({"title", "meaning", "name", "source", "group"})) return value == "\"xyz\"";
    if (key == "id") return value == "\"xyz\"";
    if (is({"history", "compare", "mipmaps"})) return value == "true";
    if (key == "depth_test") return value == "true";
    if (key == "repeat" || key == "ref") return value == "42";
    if (key == "lacks") return value == "[]";
    if (key == "define") return value == "{}" || value == "{ a = 1 }";
    if (is({"default", "size"})) return value == "42" || value == "1.5";
    return key == "offset" && value.size() == 6 && value.ends_with("]"); // [1, 2]
}

TEST_F(BrokenFolder, AnyOtherValueOfAKeyIsOneLineAtItsPlace) {
    ASSERT_EQ(said(fullToml), "");
    const std::vector<std::string> lines = linesOf(fullToml);
    std::size_t broken = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t equals = lines[i].find(" = ");
        if (equals == std::string::npos) continue;
        const std::string key = lines[i].substr(0, equals);
        for (const std::string& value : wrongValues) {
            const std::string message = said(with(i, key + " = " + value));
            if (mayBe(key, value)) continue;
            ++broken;
            // Another line where the value is right by itself: a history that a target needs, a default beside its range.
            const bool isOpen = value == "[" || value == "\"\"\"";
            const bool isElsewhere =
                isOpen || key == "range" || key == "choices" || key == "size" || key == "answer" || key == "to";
            const std::string place = fmt::format("technique.toml:{}: ", i + 1);
            EXPECT_TRUE(message.starts_with(isElsewhere && !message.empty() ? "technique.toml:" : place))
                << i + 1 << ": " << key << " = " << value << "\n"
                << message;
            EXPECT_GT(message.size(), place.size() + 10) << message;
        }
    }
    EXPECT_GT(broken, 700U);
}

TEST_F(BrokenFolder, AKeyThatIsMissingMisspeltOrThereTwiceIsNamed) {
    const std::vector<std::string> lines = linesOf(fullToml),
                                   mayLack{"source", "view",    "variants",    "lacks", "compare", "filter",     "mipmaps",
                                           "offset", "clear",   "define",      "cull",  "blend",   "depth_test", "repeat",
                                           "group",  "compute", "work_groups", "test",  "ref",     "pass",       "fail"};
    std::string table; // the last header
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with("[")) table = lines[i];
        const std::size_t equals = lines[i].find(" = ");
        if (equals == std::string::npos) continue;
        const std::string key = lines[i].substr(0, equals);
        const std::string missing = said(with(i, ""));
        if (std::ranges::count(mayLack, key) == 0 && !(key == "history" && table == "[target.mean]")) {
            EXPECT_TRUE(missing.starts_with("technique.toml:")) << key << ": " << missing;
            EXPECT_NE(missing.find(key == "range" || key == "choices" ? "range" : key), std::string::npos) << missing;
        }
        const std::string misspelt = said(with(i, key.substr(0, key.size() - 1) + lines[i].substr(equals)));
        EXPECT_NE(misspelt.find(fmt::format("technique.toml:{}: ", i + 1)), std::string::npos) << misspelt;
        EXPECT_NE(misspelt.find(": unknown key"), std::string::npos) << misspelt;
        EXPECT_NE(misspelt.find(key, misspelt.find("unknown key")), std::string::npos) << misspelt; // the right one
        const std::string twice = said(with(i, lines[i] + "\n" + lines[i]));
        EXPECT_TRUE(twice.starts_with(fmt::format("technique.toml:{}: not valid TOML: ", i + 2))) << twice;
    }
}

TEST_F(BrokenFolder, TheFileCutAnywhereIsOneLine) {
    std::size_t broken = 0;
    for (std::size_t length = 0; length + 30 < fullToml.size(); length += 5) {
        const std::string message = said(fullToml.substr(0, length));
        EXPECT_TRUE(message.starts_with("technique.toml:")) << length << ": " << message;
        ++broken;
    }
    EXPECT_GT(broken, 150U);
}

TEST_F(BrokenFolder, APassWritesNoMoreTargetsThanGlHas) {
    std::string targets, names;
    for (int i = 0; i < 8; ++i) {
        targets += fmt::format("[target.t{}]\nformat = \"R8\"\nsize = \"image\"\n", i);
        names += fmt::format("\"t{}\", ", i);
    }
    const std::string toml =
        replaced(replaced(fullToml, "[target.mean]", targets + "[target.mean]"), "to = \"mean\"", "to = [" + names + "]");
    EXPECT_NE(said(toml).find("a pass writes 7 targets at most"), std::string::npos) << said(toml);
}

TEST_F(BrokenFolder, WhatContradictsItselfIsToldWithTheRemedy) {
    const auto changed = [&](const std::string& from, const std::string& to) { return said(replaced(fullToml, from, to)); };
    const std::vector<std::pair<std::string, std::string>> cases{
        {changed("[parameter.radius]", "[parameter.Map]"), "shaders would call it MAP, as map; rename one"},
        {changed("[parameter.radius]", "[parameter.kind_wide]"), "shaders would call it KIND_WIDE"},
        {changed("SOURCE =", "RADIUS ="), "is the parameter radius already; choose another name"},
        {changed("SOURCE = \"moments\"", "SOURCE = \"a\\nb\""), "a macro is one line"},
        {changed("choices = [\"narrow\", \"wide\"]", "choices = [\"narrow\", \"narrow\"]"), "is there twice"},
        {changed("choices = [\"narrow\", \"wide\"]", "choices = []"), "names no word; of a number, say its range"},
        {changed("[target.mean]", "[target.positions]"), "is the name of a uniform that shaders have already"},
        {changed("[target.mean]", "[target.previous_moments]"), "is the name of a uniform that shaders have already"},
        {changed("[target.mean]", "[target.visibility]"), "is the image of the answer"},
        {changed("[target.mean]", "[target.gl_mean]"), "is no name in GLSL"},
        {changed("[\"moments\", \"depths\"]", "[\"moments\", \"mean\"]"),
         "is of another size than moments; what a pass writes"},
        {changed("[\"moments\", \"depths\"]", "[\"moments\", \"moments\"]"), "is written twice"},
        {changed("[\"moments\", \"depths\"]", "[\"moments\", \"visibility\"]"), "visibility is written alone"},
        {changed("[\"moments\", \"depths\"]", "\"mean\""), "casters are drawn into a map"},
        {changed("to = \"mean\"", "to = [\"depths\", \"moments\"]"), "a pass over the screen writes depths alone"},
        {changed("to = \"mean\"", "to = \"mea\""), "there is no target \"mea\" (did you mean \"mean\"?)"},
        {changed("to = \"visibility\"", "to = \"mean\""), "the last pass writes the answer: to = \"visibility\""},
        {changed("fragment = \"mean.frag\"", "fragment = \"../mean.frag\""), "has no shader \"../mean.frag\""},
        {changed("fragment = \"mean.frag\"", "offset = [1, 1]\nfragment = \"mean.frag\""), "offset: is of casters"},
        {changed("repeat = 2", "repeat = \"map\""), "map must be a whole number within 1 and 64"},
        {changed("repeat = 2", "repeat = 65"), "expected a whole number from 1 to 64, got 65"},
        {changed("name = \"resolve\"", "group = \"there and back\"\nrepeat = 3\nname = \"resolve\""),
         "is said by the first pass of the group"},
        {changed("name = \"moments\"", "group = \"there and back\"\nname = \"moments\""),
         "has passes above; those of a group come one after the other"},
        {changed("name = \"resolve\"", "group = \"there and back\"\nwhen = \"kind=wide\"\nname = \"resolve\""),
         "has passes above that are drawn with another choice"},
        {changed("repeat = 2", "blend = \"min\""), "no pass before has drawn mean: say clear = [0, 0, 0, 0]"},
        {changed("repeat = 2", "clear = [0, 0, 0, 0]"), "is of casters, or with blend"},
        {changed("repeat = 2", "cull = \"back\""), "cull: is of casters"},
        {changed("to = \"mask\"", "to = \"mean\""),
         "stencil: needs a target with a stencil: name one of the format Depth32FStencil8 in `to`"},
        {changed("to = \"mask\"", "to = [\"visibility\", \"mask\", \"mean\"]"),
         "visibility is written alone, or with a stencil"},
        {said(replaced(replaced(fullToml, "to = \"mask\"", "to = [\"visibility\", \"mask\"]"),
                       "size = \"image\"\n\n[[pass]]", "size = 64\n\n[[pass]]")),
         "is of another size than visibility"},
        {changed("fail = \"invert\"", "depth_fail = \"invert\""), "is of casters; over the screen no depth is tested"},
        {changed("fail = \"invert\"", "fail = \"inverts\""),
         "expected one of keep, replace, increment, decrement, invert, got \"inverts\" (did you mean \"invert\"?)"},
        {changed("ref = 1", "ref = 256"), "expected a whole number from 0 to 255, got 256"},
        {changed("work_groups =", "stencil = { ref = 1 }\nwork_groups ="), "stencil: is of a pass that draws"},
        {changed("work_groups =", "blend = \"min\"\nwork_groups ="), "blend: is of a pass that draws; this one computes"},
        {changed("compute =", "draw = \"screen\"\ncompute ="), "draw: is of a pass that draws; this one computes"},
        {changed("compute = \"sums.comp\"", "compute = \"sum.comp\""),
         "has no shader \"sum.comp\" (did you mean \"sums.comp\"?)"},
        {changed("compute = \"sums.comp\"", "draw = \"screen\"\nfragment = \"mean.frag\""),
         "work_groups: is of a compute pass: say compute = \"FILE.comp\""},
        {changed("to = \"moments\"\nwork_groups", "to = \"depths\"\nwork_groups"), "no image has depths"},
        {changed("[1, \"moments\", 1]", "[1, \"moment\", 1]"), "there is no target \"moment\" (did you mean \"moments\"?)"},
        {changed("[1, \"moments\", 1]", "[1, 1, \"moments\"]"), "a target has no third side; say a number"},
        {changed("[1, \"moments\", 1]", "[1, \"moments\"]"), "expected three: along x, y and z"},
        {changed("[1, \"moments\", 1]", "[0, \"moments\", 1]"), "expected a whole number from 1 to 65535, got 0"},
        {changed("cull = \"front\"", "depth_test = false"), "a target of depths keeps the nearest"},
        {changed("format = \"Depth32F\"", "format = \"Depth32F\"\nmipmaps = true"), "depths have no mipmaps"},
        {changed("format = \"RG32F\"", "format = \"RG32F\"\ncompare = true"), "only depths compare"},
        {changed("format = \"RG32F\"", "format = \"kind\""), "narrow"},
        {changed("format = \"RG32F\"", "format = \"map\""), "map is a number; its choices would be formats"},
        {changed("format = \"RG32F\"", "format = \"RG32UI\""), "whole numbers are not interpolated"},
        {said(replaced(replaced(fullToml, "format = \"RGBA32F\"", "format = \"RG32UI\""), "repeat = 2",
                       "blend = \"min\"\nclear = [0, 0, 0, 0]")),
         "mean holds whole numbers, which are drawn over the screen without blend"},
        {said(replaced(replaced(fullToml, "\"narrow\"\nchoices = [\"narrow\", \"wide\"]",
                                "\"RG16F\"\nchoices = [\"RG16F\", \"Depth32F\"]"),
                       "format = \"RG32F\"", "format = \"kind\"")),
         "Depth32F is none to choose"},
        {changed("answer = \"soft\"", "answer = \"hard\""), "a light-sample is of a technique whose answer is soft"},
        {changed("map=512", "map=8"), "map"},
        {changed("kind=wide", "kind=wode"), "wide"},
        {changed("history = true\nview", "view"), "say history = true above"},
    };
    for (const auto& [message, remedy] : cases) {
        EXPECT_TRUE(message.starts_with("technique.toml:")) << remedy << ": " << message;
        EXPECT_NE(message.find(remedy), std::string::npos) << message;
    }
}

TEST_F(BrokenFolder, FilesThatAreNoneOfItsOwnAreRefused) {
    namespace fs = std::filesystem;
    const auto refused = [&](const std::string& file, const std::string& why) {
        const std::string message = said(fullToml);
        EXPECT_TRUE(message.starts_with(file)) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
        fs::remove_all(folder_.path() / file);
    };
    fs::create_symlink("/etc/hostname", folder_.path() / "a.frag");
    refused("a.frag", "a link");
    fs::create_symlink("nowhere", folder_.path() / "a.glsl");
    refused("a.glsl", "a link");
    fs::create_directory(folder_.path() / "a.glsl");
    refused("a.glsl", "a folder");
    ASSERT_EQ(::mkfifo((folder_.path() / "a.glsl").c_str(), 0600), 0);
    refused("a.glsl", "a device");
    folder_.write("a.glsl", std::string((1 << 20) + 1, ' '));
    refused("a.glsl", "is larger than 1 MiB");
    folder_.write("a.glsl", "one\ntwo" + std::string(1, '\0'));
    refused("a.glsl:2: has a byte 0", "");
    fs::remove(folder_.path() / "a.glsl");
    for (int i = 0; i < 64; ++i) folder_.write(fmt::format("{}.glsl", i), "");
    EXPECT_NE(said(fullToml).find("has more than 64 shaders"), std::string::npos);
}

TEST_F(BrokenFolder, TheDescriptionIsAFileOfItsOwn) {
    namespace fs = std::filesystem;
    const fs::path file = folder_.path() / "technique.toml";
    const auto message = [&] { return test::messageOf<BadInput>([&] { folder_.entry(); }); };
    fs::rename(file, folder_.path() / "other.toml");
    EXPECT_NE(message().find("technique.toml is missing; shadowbench new-technique writes one"), std::string::npos);
    fs::create_symlink("other.toml", file);
    EXPECT_NE(message().find("a link"), std::string::npos);
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_NE(message().find("a folder"), std::string::npos);
    fs::remove(file);
    folder_.write("technique.toml", fullToml + std::string(1 << 20, '#'));
    EXPECT_NE(message().find("is larger than 1 MiB"), std::string::npos);
}

} // namespace
} // namespace shadowbench
