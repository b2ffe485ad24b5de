// Findings agree with the verdicts on claims, and what they say of an order is held by figures.
//
// A finding that touches a claim names it and its verdict: "([K4](../results/claims.md#k4): partly)".
#include "base/files.h"
#include "tests/support/citations.h"

#include <gtest/gtest.h>
#include <map>
#include <regex>

namespace shadowbench {
namespace {
namespace fs = std::filesystem;

const fs::path root = SOURCE_FOLDER;

/// Of the table of results/claims.md, whose rows are "| [K1](#k1) | claim | where | verdict |".
std::map<std::string, std::string> verdictsIn(const std::string& page) {
    static const std::regex row(R"(^\| \[(K\d+)\]\(#k\d+\) \|.*\| ([a-z ]+) \|$)");
    std::map<std::string, std::string> verdicts;
    std::smatch found;
    for (const std::string& line : citations::linesOf(page))
        if (std::regex_match(line, found, row)) verdicts[found[1]] = found[2];
    return verdicts;
}

/// Lines that belong together: a paragraph, an item of a list, a table, a heading.
std::vector<std::string> blocksOf(const std::string& page) {
    std::vector<std::string> blocks(1);
    for (const std::string& line : citations::linesOf(page)) {
        const bool begins = line.empty() || line.starts_with("* ") || line.starts_with("#");
        if (begins && !blocks.back().empty()) blocks.emplace_back();
        const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
        blocks.back() += (blocks.back().empty() ? "" : " ") + line.substr(first);
    }
    return blocks;
}

/// What is wrong with the mentions of claims on a page: without a verdict, or with another one than was computed.
std::string wrongMentions(const std::string& page, const std::map<std::string, std::string>& verdicts) {
    static const std::regex mention(R"(\bK(\d+)\b(\]\(\.\./results/claims\.md#k(\d+)\): ([a-z ]+))?)");
    std::string wrong;
    for (const std::string& block : blocksOf(page))
        for (std::sregex_iterator at(block.begin(), block.end(), mention), end; at != end; ++at) {
            const std::string id = "K" + (*at)[1].str(), said = (*at)[4];
            const auto computed = verdicts.find(id);
            if (computed == verdicts.end())
                wrong += fmt::format("\n  {} is no claim", id);
            else if (said != computed->second || (*at)[1] != (*at)[3])
                wrong += fmt::format("\n  {} is \"{}\", not \"{}\"", id, computed->second, said);
        }
    return wrong;
}

/// Paragraphs that order things and stand beside no figures: no table held to records in their section, no claim, no link
/// into results, no command that gives the figures.
std::string unheldOrders(const std::string& page) {
    static const std::regex order(R"(\b(halve[sd]?|half|thirds?|quarters?|fifths?|tenths?|twice|times|more|most|less|fewer|)"
                                  R"(larger|smaller|better|worse|worst|nearly|cheaper|faster|dearer|exact|in the main)\b)",
                                  std::regex::icase);
    const auto has = [](const std::string& block, const char* what) { return block.find(what) != std::string::npos; };
    std::string all, unheld; // of a section
    bool held = false;
    for (const std::string& block : blocksOf(page + "\n# end")) {
        if (block.starts_with("#")) {
            if (!held) all += unheld;
            held = false;
            unheld = "";
            continue;
        }
        held = held || has(block, "[records](");
        const bool names = has(block, "results/") || has(block, "./bench ") || has(block, "_test.cpp");
        if (!block.starts_with("|") && !names && std::regex_search(block, order)) unheld += "\n  " + block.substr(0, 80);
    }
    return all;
}

TEST(Findings, NameTheVerdictsThatWereComputed) {
    const std::map<std::string, std::string> verdicts = verdictsIn(readFile(root / "results/claims.md"));
    ASSERT_EQ(verdicts.size(), 59U);
    const std::string findings = readFile(root / "docs/findings.md");
    EXPECT_NE(findings.find("[K4](../results/claims.md#k4)"), std::string::npos);
    const std::string wrong = wrongMentions(findings, verdicts);
    EXPECT_TRUE(wrong.empty()) << "docs/findings.md:" << wrong;
}

TEST(Findings, OfOrderStandBesideTheFiguresThatHoldThem) {
    const std::string unheld = unheldOrders(readFile(root / "docs/findings.md"));
    EXPECT_TRUE(unheld.empty()) << "docs/findings.md:" << unheld;
}

TEST(Findings, ThatContradictAClaimAreNamed) {
    const std::map<std::string, std::string> verdicts =
        verdictsIn("| [K4](#k4) | A | P | partly |\n| [K7](#k7) | B \\| C | P | not reproduced |\n");
    EXPECT_EQ(verdicts, (std::map<std::string, std::string>{{"K4", "partly"}, {"K7", "not reproduced"}}));
    EXPECT_EQ(wrongMentions("a\n([K4](../results/claims.md#k4):\npartly)", verdicts), "");
    EXPECT_EQ(wrongMentions("([K4](../results/claims.md#k4): reproduced)", verdicts),
              "\n  K4 is \"partly\", not \"reproduced\"");
    EXPECT_EQ(wrongMentions("([K4](../results/claims.md#k7): partly)", verdicts), "\n  K4 is \"partly\", not \"partly\"");
    EXPECT_EQ(wrongMentions("as K7 has it", verdicts), "\n  K7 is \"not reproduced\", not \"\"");
    EXPECT_EQ(wrongMentions("([K9](../results/claims.md#k9): partly)", verdicts), "\n  K9 is no claim");
}

TEST(Findings, OfOrderWithoutFiguresAreNamed) {
    EXPECT_EQ(unheldOrders("## A\n\nIt halves the error.\n"), "\n  It halves the error.");
    EXPECT_EQ(unheldOrders("## A\n\n`s` ([records](r.jsonl)):\n\n| a |\n\nIt halves the error.\n\n## B\n\nTwice as fast.\n"),
              "\n  Twice as fast.");
    EXPECT_EQ(unheldOrders("## B\n\nHow fast: twice as fast.\n"), "\n  How fast: twice as fast.");
    EXPECT_EQ(unheldOrders("## B\n\n[A sweep](../results/s.md) has it twice as fast.\n"), "");
}

} // namespace
} // namespace shadowbench
