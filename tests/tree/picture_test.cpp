// The picture of the layers in docs/design.md is that of cmake/layers.txt.
#include "base/files.h"
#include "tests/support/citations.h"

#include <gtest/gtest.h>
#include <sstream>

namespace shadowbench {
namespace {

using Arrows = std::map<std::string, std::set<std::string>>;

/// "folder: the folders it includes | packages", a line each.
Arrows arrowsOf(const std::string& layers) {
    Arrows arrows;
    for (const std::string& line : citations::linesOf(layers)) {
        const std::size_t colon = line.find(':');
        if (line.starts_with('#') || colon == std::string::npos) continue;
        std::istringstream words(line.substr(colon + 1, line.find('|') - colon - 1));
        std::set<std::string>& below = arrows[line.substr(0, colon)];
        for (std::string folder; words >> folder;) below.insert(folder);
    }
    return arrows;
}

bool reaches(const Arrows& arrows, const std::string& from, const std::string& to) {
    return std::ranges::any_of(arrows.at(from),
                               [&](const std::string& below) { return below == to || reaches(arrows, below, to); });
}

/// Without the arrows that follow from others, as lines of a Mermaid flowchart.
std::set<std::string> pictureOf(const Arrows& arrows) {
    std::set<std::string> lines;
    for (const auto& [folder, below] : arrows)
        for (const std::string& to : below) {
            const auto isBetween = [&](const std::string& other) { return other != to && reaches(arrows, other, to); };
            if (std::ranges::none_of(below, isBetween)) lines.insert(fmt::format("    {} --> {}", folder, to));
        }
    return lines;
}

TEST(Picture, OfTheLayersIsThatOfTheirList) {
    const std::filesystem::path root = SOURCE_FOLDER;
    std::set<std::string> drawn;
    for (const std::string& line : citations::linesOf(readFile(root / "docs/design.md")))
        if (line.find(" --> ") != std::string::npos) drawn.insert(line);
    const std::set<std::string> listed = pictureOf(arrowsOf(readFile(root / "cmake/layers.txt")));
    std::string wrong;
    for (const std::string& line : listed)
        if (!drawn.contains(line)) wrong += "\n  missing: " + line;
    for (const std::string& line : drawn)
        if (!listed.contains(line)) wrong += "\n  not so: " + line;
    EXPECT_TRUE(wrong.empty()) << wrong;
    EXPECT_GT(drawn.size(), 20U);
}

TEST(Picture, LeavesOutWhatFollows) {
    const std::string layers = "# a comment: none\na: | x\nb: a\nc: b a | y\n";
    EXPECT_EQ(pictureOf(arrowsOf(layers)), (std::set<std::string>{"    b --> a", "    c --> b"}));
}

} // namespace
} // namespace shadowbench
