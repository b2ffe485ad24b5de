// The claims that come with the program, and what is published of them.
#include "base/files.h"
#include "studies/claims/claims.h"
#include "tests/support/tests_of_the_tree.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <iterator>

namespace shadowbench {
namespace {

/// All records that `tools/publish claims` reads, in the order in which a shell lists them.
std::vector<Record> publishedRecords() {
    const std::filesystem::path results = std::filesystem::path(SOURCE_FOLDER) / "results";
    std::vector<std::filesystem::path> files{results / "published/results.jsonl", results / "failures/results.jsonl"};
    for (const char* folder : {"papers", "sweeps", "seeds"}) {
        std::vector<std::string> inside;
        for (const auto& entry : std::filesystem::directory_iterator(results / folder))
            for (const char* name : {"results.jsonl", "sweep.jsonl"})
                if (exists(entry.path() / name)) inside.push_back((entry.path() / name).string());
        std::ranges::sort(inside);
        files.insert(files.end(), inside.begin(), inside.end());
    }
    std::vector<Record> all;
    for (const std::filesystem::path& file : files) std::ranges::move(readRecords(file), std::back_inserter(all));
    return all;
}

TEST(ProgramsClaims, AreInOrder) {
    EXPECT_FALSE(claims().empty());
    for (std::size_t i = 1; i < claims().size(); ++i)
        EXPECT_LT(std::stoi(claims()[i - 1].id.substr(1)), std::stoi(claims()[i].id.substr(1)));
}

TEST(ProgramsClaims, NameReplaysThatExist) {
    const std::set<std::string> tests = testsOfTheTree();
    for (const Claim& claim : claims()) {
        if (claim.replay.empty()) continue;
        EXPECT_TRUE(tests.contains(claim.replay)) << claim.id << ": " << claim.replay;
    }
}

class PublishedClaims : public testing::Test {
public:
    static void SetUpTestSuite() {
        const std::vector<Record> records = publishedRecords();
        for (const Claim& claim : claims()) judgements.push_back(judge(claim, records));
    }

    static inline std::vector<Judgement> judgements;
};

TEST_F(PublishedClaims, AreThoseOfTheRecords) {
    EXPECT_EQ(claimsReport(judgements, "md"), readFile(std::filesystem::path(SOURCE_FOLDER) / "results/claims.md"))
        << "run tools/publish claims";
}

TEST_F(PublishedClaims, AreAllMeasured) {
    EXPECT_EQ(judgements.size(), 59U);
    for (const Judgement& judgement : judgements) EXPECT_NE(judgement.verdict, Verdict::NotMeasured) << judgement.claim->id;
}

TEST_F(PublishedClaims, HaveAnIntervalOrTheReasonWhyNone) {
    for (const Judgement& judgement : judgements) {
        const bool spread = std::ranges::all_of(judgement.findings, [](const Finding& finding) {
            const std::vector<Sample>& first = finding.cases.front();
            return finding.cases.size() > 1 || first.size() > 1 || first.front().leftWidth > 0;
        });
        EXPECT_TRUE(spread || !judgement.claim->exact.empty()) << judgement.claim->id;
    }
}

TEST_F(PublishedClaims, ThatDoNotHoldSayWhatWasRuledOutAndWhatIsLeft) {
    for (const Judgement& judgement : judgements) {
        if (!isShort(judgement.verdict)) continue;
        const Claim& claim = *judgement.claim;
        EXPECT_FALSE(claim.theirs.empty()) << claim.id;
        EXPECT_FALSE(claim.left.empty()) << claim.id;
        EXPECT_FALSE(claim.ruledOut.empty()) << claim.id;
        for (std::size_t i = 0; i < claim.ruledOut.size(); ++i)
            for (const std::vector<Sample>& samples : judgement.ruledOut[i].cases) {
                const Outcome outcome = outcomeOf(samples); // the page says where times are not told apart
                EXPECT_TRUE(outcome == Outcome::Yes || outcome == Outcome::NotToldApart)
                    << claim.id << ": " << claim.ruledOut[i].says;
            }
    }
}

} // namespace
} // namespace shadowbench
