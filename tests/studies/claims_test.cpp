// Verdicts follow from records.
#include "base/error.h"
#include "studies/claims/claims.h"
#include "tests/support/records_examples.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

Record with(const std::string& variant, double mismatch) {
    Record record = test::hardRecord();
    record.variant = variant;
    record.values["accuracy.mismatch"] = mismatch;
    return record;
}

std::string check(const std::string& left, const std::string& is, const std::string& rest) {
    return R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": ")" + left +
           R"(", "metric": "accuracy.mismatch"}, "is": ")" + is + "\", " + rest + "}";
}

std::string claim(const std::string& checks) {
    return R"([{"id": "K0", "says": "s", "where": "w", "checks": [)" + checks + "]}]";
}

const std::string against =
    R"("times": 0.5, "right": {"scene": "dueling-frusta", "variant": "b", "metric": "accuracy.mismatch"})";

Verdict verdict(const std::string& json, const std::vector<Record>& records) {
    const std::vector<Claim> parsed = parseClaims(json);
    return judge(parsed.front(), records).verdict;
}

TEST(Claims, VerdictsCountTheChecksThatHold) {
    const std::vector<Record> records{with("a", 0.001), with("b", 0.01)};
    const std::string holds = check("a", "at most", against), fails = check("a", "at least", against);
    EXPECT_EQ(verdict(claim(holds), records), Verdict::Reproduced);
    EXPECT_EQ(verdict(claim(fails), records), Verdict::NotReproduced);
    EXPECT_EQ(verdict(claim(holds + "," + fails), records), Verdict::Partly);
    EXPECT_EQ(verdict(claim(check("a", "at most", "\"bound\": 0.001")), records), Verdict::Reproduced); // equal is at most
}

TEST(Claims, AReportNamesTheRecordsItRestsOnAndTheReplay) {
    std::string json = claim(check("a", "at most", against) + "," + check("b", "at most", "\"bound\": 1"));
    json.replace(json.find("\"checks\""), 0, "\"replay\": \"Suite.Name\", ");
    const std::vector<Claim> parsed = parseClaims(json);
    Record large = with("b", 0.02);
    large.profile = "paper";
    large.width = large.height = 1024;
    Record small = with("a", 0.001);
    small.profile = "gate";
    small.width = small.height = 256;
    const Judgement judgement = judge(parsed.front(), {small, large});
    EXPECT_EQ(judgement.basis, (std::vector<std::string>{"dueling-frusta, gate, 256²", "dueling-frusta, paper, 1024²"}));
    EXPECT_NE(claimsReport({judgement}, "text")
                  .find("    measured on dueling-frusta, gate, 256²; dueling-frusta, paper, 1024²; computed again in double "
                        "precision by Suite.Name\n"),
              std::string::npos)
        << claimsReport({judgement}, "text");
}

TEST(Claims, AMissingFigureIsNoVerdict) {
    const std::string holds = check("a", "at most", against);
    EXPECT_EQ(verdict(claim(holds), {with("a", 0.001)}), Verdict::NotMeasured);
    EXPECT_EQ(verdict(claim(check("a", "at most", "\"bound\": 1")), {}), Verdict::NotMeasured);
    Record unscored = with("a", 0.001);
    unscored.values["accuracy.mismatch"].reset();
    EXPECT_EQ(verdict(claim(holds), {unscored, with("b", 1)}), Verdict::NotMeasured);
}

TEST(Claims, AFigureIsOfTheFirstRecordThatHasIt) {
    Record uncounted = with("a", 0.001);
    uncounted.values["accuracy.mismatch"].reset();
    const std::string small = claim(check("a", "at most", "\"bound\": 0.01"));
    EXPECT_EQ(verdict(small, {uncounted, with("a", 0.001), with("a", 1)}), Verdict::Reproduced);
}

TEST(Claims, AProfileIsAsked) {
    const std::string paper =
        claim(R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": "a", "profile": "paper", )"
              R"("metric": "accuracy.mismatch"}, "is": "at most", "bound": 0.01})");
    Record large = with("a", 0.001);
    large.profile = "paper";
    EXPECT_EQ(verdict(paper, {with("a", 0.5)}), Verdict::NotMeasured);
    EXPECT_EQ(verdict(paper, {with("a", 0.5), large}), Verdict::Reproduced);
}

TEST(Claims, FiguresOfASweepAreTakenFromItsCurveOnly) {
    Record swept = with("a:map=512", 0.5);
    swept.sweep = SweepStep{"map", "texels", "a", 512, {}};
    const std::string ofSweep =
        R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": "a", "metric": "accuracy.mismatch", "axis": "map", "value": 512}, "is": "at least", "bound": 0.4})";
    EXPECT_EQ(verdict(claim(ofSweep), {with("a", 0.001), swept}), Verdict::Reproduced);
    EXPECT_EQ(verdict(claim(check("a", "at most", "\"bound\": 0.01")), {swept, with("a", 0.001)}), Verdict::Reproduced);
}

/// Records of variant `curve` swept over casters, with one figure.
std::vector<Record> swept(const std::string& curve, const std::string& figure, const std::vector<double>& numbers) {
    std::vector<Record> records;
    double casters = 1;
    for (const double number : numbers) {
        Record record = with(curve, 0.1);
        record.figures = {{figure, number}};
        record.sweep = SweepStep{"casters", "", curve, casters, {}};
        records.push_back(record);
        casters *= 2;
    }
    return records;
}

const std::string bytesOverCasters =
    R"("left": {"scene": "dueling-frusta", "variant": "a", "metric": "figures.bytes", "over": {"variant": "b", "metric": "figures.size"}, "axis": "casters")";

TEST(Claims, QuotientsAreTakenAtTheSamePlace) {
    std::vector<Record> records = swept("a", "bytes", {6, 20});
    for (const Record& record : swept("b", "size", {3, 5})) records.push_back(record);
    const auto bounded = [](const std::string& rest) { return claim(R"({"says": "s", )" + bytesOverCasters + rest + "}"); };
    EXPECT_EQ(verdict(bounded(R"(, "value": 1}, "is": "at most", "bound": 2)"), records), Verdict::Reproduced);
    EXPECT_EQ(verdict(bounded(R"(, "value": 2}, "is": "at least", "bound": 4)"), records), Verdict::Reproduced);
    EXPECT_EQ(verdict(bounded(R"(, "value": 2}, "is": "at least", "bound": 4.1)"), records), Verdict::NotReproduced);
    EXPECT_EQ(verdict(bounded(R"(, "value": 4}, "is": "at least", "bound": 0)"), records), Verdict::NotMeasured);
    records[2].figures["size"] = 0; // no quotient by zero
    EXPECT_EQ(verdict(bounded(R"(, "value": 1}, "is": "at least", "bound": 0)"), records), Verdict::NotMeasured);
}

TEST(Claims, GrowthIsStrictAndNeedsEveryPlace) {
    const std::string grows =
        claim(R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": "a", "metric": "figures.bytes", "axis": )"
              R"("casters"}, "grows over": [1, 2, 4]})");
    EXPECT_EQ(verdict(grows, swept("a", "bytes", {1, 2, 3})), Verdict::Reproduced);
    EXPECT_EQ(verdict(grows, swept("a", "bytes", {1, 2, 2})), Verdict::NotReproduced);
    EXPECT_EQ(verdict(grows, swept("a", "bytes", {3, 2, 4})), Verdict::NotReproduced);
    EXPECT_EQ(verdict(grows, swept("a", "bytes", {1, 2})), Verdict::NotMeasured);

    const std::vector<Claim> parsed = parseClaims(grows);
    EXPECT_NE(claimsReport({judge(parsed.front(), swept("a", "bytes", {1, 2}))}, "text")
                  .find("figures.bytes of a on dueling-frusta at casters 1, 2, 4 = 1, 2, missing grows: not measured"),
              std::string::npos);
    EXPECT_NE(claimsReport({judge(parsed.front(), swept("a", "bytes", {1, 2, 3}))}, "json").find("\"holds\": true"),
              std::string::npos);
}

TEST(Claims, AListIsReadAtAFrameOrWhereItSettles) {
    Record record = with("a", 0.1);
    record.values.list("stability.by_frame.rmse") = {0.5, 0.1, 0.3, 0.2, 0.1};
    const auto judged = [&](const std::string& rest, const std::string& is, double bound) {
        return verdict(claim(fmt::format(R"({{"says": "s", "left": {{"scene": "dueling-frusta", "variant": "a", "metric": )"
                                         R"("stability.by_frame.rmse{}}}, "is": "{}", "bound": {}}})",
                                         rest, is, bound)),
                       {record});
    };
    EXPECT_EQ(judged("[3]\"", "at least", 0.3), Verdict::Reproduced);
    EXPECT_EQ(judged("[3]\"", "at most", 0.29), Verdict::NotReproduced);
    EXPECT_EQ(judged("[6]\"", "at most", 1), Verdict::NotMeasured);
    EXPECT_EQ(judged("\"", "at most", 1), Verdict::NotMeasured);                  // a list is no number
    EXPECT_EQ(judged("\", \"settles\": 0.2", "at most", 4), Verdict::Reproduced); // frame 2 was there before, and left again
    EXPECT_EQ(judged("\", \"settles\": 0.2", "at most", 3), Verdict::NotReproduced);
    EXPECT_EQ(judged("\", \"settles\": 0.6", "at most", 1), Verdict::Reproduced);
    EXPECT_EQ(judged("\", \"settles\": 0.05", "at most", 1000), Verdict::NotReproduced); // never
    EXPECT_EQ(judged("\", \"settles\": 0.05", "at least", 1000), Verdict::Reproduced);
    record.values.list("stability.by_frame.rmse").clear();
    EXPECT_EQ(judged("\", \"settles\": 0.05", "at least", 1000), Verdict::NotMeasured);
}

TEST(Claims, RankCorrelationIsSpearmansWithMeanRanks) {
    EXPECT_NEAR(*rankCorrelation({1, 2, 3, 4}, {10, 20, 30, 40}), 1, 1e-12);
    EXPECT_NEAR(*rankCorrelation({1, 2, 3, 4}, {4, 3, 2, 1}), -1, 1e-12);
    EXPECT_NEAR(*rankCorrelation({1, 2, 3}, {1, 3, 2}), 0.5, 1e-12);     // 1 − 6 Σd² / (n (n² − 1))
    EXPECT_NEAR(*rankCorrelation({5, 5, 9}, {1, 2, 3}), 0.866025, 1e-6); // ranks 1½, 1½, 3
    EXPECT_FALSE(rankCorrelation({5, 5}, {1, 2}));
    EXPECT_FALSE(rankCorrelation({5}, {1}));
}

TEST(Claims, AnOrderIsComparedWithThePublishedOne) {
    const std::string order = claim(R"({"says": "s", "left": {"scene": "dueling-frusta", "metric": "accuracy.mismatch"}, )"
                                    R"("published": {"a": 90, "b": 80, "c": 70}, "rank correlation at least": 0.9})");
    EXPECT_EQ(verdict(order, {with("a", 0.9), with("b", 0.5), with("c", 0.1)}), Verdict::Reproduced);
    EXPECT_EQ(verdict(order, {with("a", 0.5), with("b", 0.9), with("c", 0.1)}), Verdict::NotReproduced); // 0.5
    EXPECT_EQ(verdict(order, {with("a", 0.5), with("b", 0.9)}), Verdict::NotMeasured);
    const std::vector<Claim> parsed = parseClaims(order);
    const std::string text = claimsReport({judge(parsed.front(), {with("a", 0.5), with("b", 0.9), with("c", 0.1)})}, "text");
    EXPECT_NE(text.find("accuracy.mismatch on dueling-frusta: rank correlation 0.5 ≥ 0.9: no; theirs and ours, "
                        "accuracy.mismatch: a 90, 0.5; b 80, 0.9; c 70, 0.1\n"),
              std::string::npos)
        << text;
}

TEST(Claims, MistakesNameClaimAndKey) {
    const auto message = [](const std::string& json) -> std::string {
        try {
            parseClaims(json);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message(claim(check("a", "below", against))),
              "reading claims: K0: \"is\" must be \"at most\" or \"at least\", not \"below\"");
    EXPECT_EQ(message(claim("")), "reading claims: K0: \"checks\" is empty");
    EXPECT_EQ(message(R"([{"id": "K0", "says": "s", "wehre": "w", "checks": []}])"),
              "reading claims: K0: \"wehre\" is no key");
    EXPECT_EQ(message("{}"), "reading claims: not a JSON list");
    const auto left = [&](const std::string& members) {
        return message(claim(R"({"says": "s", "left": {"variant": "a", "metric": "m", )" + members +
                             R"(}, "is": "at most", "bound": 1})"));
    };
    EXPECT_EQ(left("\"axis\": \"map\""), "reading claims: K0: \"scene\" is missing");
    EXPECT_EQ(left("\"scene\": []"), "reading claims: K0: \"scene\" lists nothing");
    EXPECT_EQ(left("\"scene\": \"s\", \"axis\": \"map\""), "reading claims: K0: \"axis\" and \"value\" go together");
    EXPECT_EQ(left("\"scene\": " + nlohmann::json(std::vector<std::string>(1001, "s")).dump()),
              "reading claims: K0: more than 1000 cases are asked in one check");
    EXPECT_EQ(message(claim(R"({"says": "s", )" + bytesOverCasters + R"(}, "grows over": [1]})")),
              "reading claims: K0: \"grows over\" must list two values of the axis or more");
    EXPECT_EQ(message(claim(R"({"says": "s", "left": {"scene": "x", "metric": "m"}, "published": {"a": 1}, )"
                            R"("rank correlation at least": 1})")),
              "reading claims: K0: \"published\" must give the document's numbers of two variants or more");
    const auto order = [&](const std::string& published) {
        return message(claim(R"({"says": "s", "left": {"scene": "x", "metric": "m"}, "published": )" + published +
                             R"(, "rank correlation at least": 1})"));
    };
    EXPECT_EQ(order("[1, 2]"), "reading claims: K0: \"published\" must give the document's numbers of two variants or more");
    EXPECT_EQ(order(R"({"a": 1, "b": "2"})"), "reading claims: K0: the published number of b must be a number");
    EXPECT_EQ(message(R"([{"id": "K0", "says": "s", "where": "w", "untestable": "u", "checks": []}])"),
              "reading claims: K0: a claim has either \"checks\" or \"untestable\"");
    EXPECT_EQ(message(R"([{"id": "K0", "says": "s", "where": "w", "untestable": "nobody measured it"}])"), "");
}

TEST(Claims, TheReportNamesTheFigures) {
    const std::vector<Claim> parsed = parseClaims(claim(check("a", "at most", against)));
    const std::string text = claimsReport({judge(parsed.front(), {with("a", 0.001), with("b", 0.01)})}, "text");
    EXPECT_EQ(text, "K0: reproduced\n    s (w)\n    - s\n      accuracy.mismatch of a on dueling-frusta = 0.001 ≤ 0.5 × "
                    "accuracy.mismatch of b on dueling-frusta = 0.01: yes\n    measured on dueling-frusta, gate, 256²\n");
}

Record of(const std::string& scene, const std::string& variant, double mismatch, std::uint32_t seed = 1) {
    Record record = with(variant, mismatch);
    record.scene = scene;
    record.seed = seed;
    return record;
}

std::string text(const std::string& json, const std::vector<Record>& records) {
    const std::vector<Claim> parsed = parseClaims(json);
    return claimsReport({judge(parsed.front(), records)}, "text");
}

TEST(Claims, ACheckIsAskedOnEachSceneThatItLists) {
    const std::string listed =
        claim(R"({"says": "s", "left": {"scene": ["s1", "s2", "s3"], "variant": "a", "metric": "accuracy.mismatch"}, "is": )"
              R"("at most", "times": 0.5, "right": {"variant": "b"}})"); // of the same scene and metric
    std::vector<Record> records{of("s1", "a", 0.1), of("s1", "b", 0.2), of("s2", "a", 0.2), of("s2", "b", 0.4)};
    EXPECT_EQ(verdict(listed, records), Verdict::NotMeasured) << "one scene is missing";
    records.push_back(of("s3", "a", 0.3));
    records.push_back(of("s3", "b", 0.6));
    EXPECT_EQ(verdict(listed, records), Verdict::Reproduced);
    records[0] = of("s1", "a", 0.11);
    EXPECT_EQ(verdict(listed, records), Verdict::Partly);
    EXPECT_NE(
        text(listed, records)
            .find("accuracy.mismatch of a ≤ 0.5 × that of b: on s1 = 0.11 ≤ 0.5 × 0.2; on s2 = 0.2 ≤ 0.5 × 0.4; on s3 = "
                  "0.3 ≤ 0.5 × 0.6: yes in 2, no in 1 of 3\n"),
        std::string::npos)
        << text(listed, records);
    for (const int i : {2, 4}) records[i].values["accuracy.mismatch"] = 0.5;
    EXPECT_EQ(verdict(listed, records), Verdict::NotReproduced);
}

TEST(Claims, ListsOfOneCheckAreCombined) {
    const std::vector<Claim> parsed = parseClaims(claim(
        R"({"says": "s", "left": {"scene": ["s1", "s2"], "variant": "a", "metric": "stability.by_frame.rmse", "settles": )"
        R"([0.1, 0.2, 0.3]}, "is": "at most", "bound": 3})"));
    EXPECT_EQ(parsed[0].checks[0].cases.size(), 6U);
    EXPECT_EQ(parsed[0].checks[0].cases[5].left.scene, "s2");
    EXPECT_EQ(parsed[0].checks[0].cases[5].left.settles, 0.3);
}

TEST(Claims, ChecksThatNameNoSceneAreAskedOnTheClaims) {
    std::string json = claim(R"({"says": "s", "left": {"variant": "a", "metric": "accuracy.mismatch"}, "is": "at most", )"
                             R"("bound": 1})");
    json.replace(json.find("\"checks\""), 0, R"("scene": ["s1", "s2"], )");
    EXPECT_EQ(verdict(json, {of("s1", "a", 0.5), of("s2", "a", 0.5)}), Verdict::Reproduced);
    EXPECT_EQ(verdict(json, {of("s1", "a", 0.5)}), Verdict::NotMeasured);
}

/// Records of variant a under seeds 1, 2, …
std::vector<Record> seeds(const std::vector<double>& mismatches) {
    std::vector<Record> records;
    for (const double mismatch : mismatches)
        records.push_back(of("dueling-frusta", "a", mismatch, static_cast<std::uint32_t>(records.size() + 1)));
    return records;
}

TEST(Claims, AnIntervalOverSeedsThatHasTheBoundInsideIsNotToldApart) {
    // mean 0.01, standard error 0.001, t of two degrees of freedom 4.303
    const std::vector<Record> records = seeds({0.01 - 0.001 * std::sqrt(3), 0.01, 0.01 + 0.001 * std::sqrt(3)});
    const auto below = [&](double bound) { return claim(check("a", "at most", fmt::format("\"bound\": {}", bound))); };
    EXPECT_EQ(verdict(below(0.0144), records), Verdict::Reproduced);
    EXPECT_EQ(verdict(below(0.0142), records), Verdict::NotToldApart);
    EXPECT_EQ(verdict(below(0.0058), records), Verdict::NotToldApart);
    EXPECT_EQ(verdict(below(0.0056), records), Verdict::NotReproduced);
    EXPECT_NE(text(below(0.0142), records).find("= 0.01 ± 0.0043 ≤ 0.0142 (3 seeds): not told apart\n"), std::string::npos)
        << text(below(0.0142), records);
    EXPECT_EQ(
        verdict(claim(check("a", "at most", "\"bound\": 0.0144") + "," + check("a", "at most", "\"bound\": 0.01")), records),
        Verdict::Partly)
        << "one check holds";
}

TEST(Claims, TimesAreToldApartByTheIntervalsOfTheirRounds) {
    const auto timed = [](const std::string& variant, double ratio, double spread) {
        Record record = with(variant, 0.1);
        record.values["cost.time.ratio"] = ratio;
        record.values.list("cost.time.samples") = {20 * (1 - spread), 20, 20 * (1 + spread)};
        return record;
    };
    const auto asked = [](const std::string& rest) {
        return claim(R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": "a", "metric": "cost.time.ratio"}, )"
                     R"("is": "at most", )" +
                     rest + "}");
    };
    const std::string bound = asked(R"("bound": 1.11)");
    EXPECT_EQ(verdict(bound, {timed("a", 1.13, 0.01)}), Verdict::NotReproduced); // ± 0.0113
    EXPECT_EQ(verdict(bound, {timed("a", 1.13, 0.02)}), Verdict::NotToldApart);
    EXPECT_EQ(verdict(bound, {timed("a", 1.09, 0.02)}), Verdict::NotToldApart);
    EXPECT_EQ(verdict(bound, {timed("a", 1.09, 0.01)}), Verdict::Reproduced);
    const std::string other = asked(R"("times": 2, "right": {"variant": "b"})");
    EXPECT_EQ(verdict(other, {timed("a", 1.9, 0.02), timed("b", 1, 0.02)}),
              Verdict::Reproduced); // √(0.038² + 0.04²) = 0.055
    EXPECT_EQ(verdict(other, {timed("a", 1.9, 0.02), timed("b", 1, 0.05)}), Verdict::NotToldApart);
    const std::vector<Claim> parsed = parseClaims(other);
    EXPECT_EQ(describedFindings(judge(parsed.front(), {timed("a", 1.9, 0.02), timed("b", 1, 0.05)})).front(),
              "cost.time.ratio of a on dueling-frusta = 1.9 ± 0.038 ≤ 2 × cost.time.ratio of b on dueling-frusta = 1 ± "
              "0.05: not told apart");
}

TEST(Claims, FiguresThatDoNotDependOnTheSeedHaveNoWidth) {
    const std::string bounded = claim(check("a", "at most", "\"bound\": 0.01"));
    EXPECT_EQ(verdict(bounded, seeds({0.01, 0.01, 0.01})), Verdict::Reproduced);
    EXPECT_EQ(verdict(bounded, seeds({0.0101, 0.0101, 0.0101})), Verdict::NotReproduced);
}

TEST(Claims, OfSeedsThatNeverSettleAllMustAgree) {
    const std::string settles =
        claim(R"({"says": "s", "left": {"scene": "dueling-frusta", "variant": "a", "metric": "stability.by_frame.rmse", )"
              R"("settles": 0.1}, "is": "at most", "bound": 2})");
    std::vector<Record> records = seeds({0, 0});
    records[0].values.list("stability.by_frame.rmse") = {0.5, 0.1};
    records[1].values.list("stability.by_frame.rmse") = {0.5, 0.5}; // never
    EXPECT_EQ(verdict(settles, records), Verdict::NotToldApart);
    EXPECT_NE(text(settles, records).find("= 2 to none ≤ 2"), std::string::npos) << text(settles, records);
    records[0].values.list("stability.by_frame.rmse") = {0.5, 0.5};
    EXPECT_EQ(verdict(settles, records), Verdict::NotReproduced);
}

TEST(Claims, FiguresOfOneSeedAreCompared) {
    const std::string paired = claim(check("a", "at most", against)); // a ≤ ½ b
    const std::vector<Record> records{of("dueling-frusta", "a", 0.1, 1), of("dueling-frusta", "b", 0.2, 1),
                                      of("dueling-frusta", "a", 0.4, 2), of("dueling-frusta", "b", 0.8, 2)};
    EXPECT_EQ(verdict(paired, records), Verdict::Reproduced) << "though 0.4 is more than half of 0.2";
    const std::vector<Claim> parsed = parseClaims(paired);
    const Judgement judged = judge(parsed.front(), {records[0], records[1], records[2]});
    EXPECT_EQ(judged.findings[0].cases[0].size(), 1U) << "of the other seed there is one figure alone";
    EXPECT_EQ(judged.verdict, Verdict::Reproduced);
}

TEST(Claims, FiguresAreAddedUp) {
    Record record = with("a", 0.1);
    record.figures = {{"drawn", 3}, {"read", 4}, {"saved", 2}};
    const auto bounded = [](const std::string& metric, double bound) {
        return claim(fmt::format(R"({{"says": "s", "left": {{"scene": "dueling-frusta", "variant": "a", "metric": "{}"}}, )"
                                 R"("is": "at most", "bound": {}}})",
                                 metric, bound));
    };
    EXPECT_EQ(verdict(bounded("figures.drawn + figures.read - figures.saved", 5), {record}), Verdict::Reproduced);
    EXPECT_EQ(verdict(bounded("figures.drawn + figures.read - figures.saved", 4.9), {record}), Verdict::NotReproduced);
    EXPECT_EQ(verdict(bounded("figures.drawn + figures.lost", 9), {record}), Verdict::NotMeasured);
}

TEST(Claims, AParagraphSaysWhatTheDocumentHasWhatWeHaveAndWhatWasRuledOut) {
    const std::string json = R"([{"id": "K0", "says": "s", "where": "w", "checks": [)" +
                             check("a", "at most", "\"bound\": 0.01") +
                             R"(], "theirs": "0.01", "left": "the weather", "replay": "Suite.Name", "ruled out": [)" +
                             check("a", "at least", "\"bound\": 0.05") + "," + check("a", "at least", "\"bound\": 0.9") +
                             "," + check("c", "at least", "\"bound\": 0") + "]}]";
    const std::vector<Claim> parsed = parseClaims(json);
    EXPECT_EQ(
        paragraphOf(judge(parsed.front(), {with("a", 0.1)})),
        "The document: 0.01. Here: s (0.1: no). Ruled out: s (0.1: yes); our code, whose figures a test computes again "
        "in double precision. Not ruled out: s (0.1: no); s (missing: not measured). What is left: the weather.");
    EXPECT_EQ(paragraphOf(judge(parsed.front(), {with("a", 0.001)})), "") << "the claim is reproduced";
    EXPECT_EQ(paragraphOf(judge(parsed.front(), {})), "") << "it is not measured";

    const auto asJson = [&](const std::vector<Record>& records) {
        return nlohmann::json::parse(claimsReport({judge(parsed.front(), records)}, "json")).at(0);
    };
    const nlohmann::json refuted = asJson({with("a", 0.1)}), reproduced = asJson({with("a", 0.001)});
    EXPECT_EQ(refuted["paragraph"], paragraphOf(judge(parsed.front(), {with("a", 0.1)})));
    EXPECT_FALSE(reproduced.contains("paragraph"));
    EXPECT_FALSE(reproduced.contains("no interval"));
    EXPECT_TRUE(asJson({})["checks"][0]["cases"].is_array());
    EXPECT_EQ(refuted["replay"], "Suite.Name");
    const nlohmann::json& sample = refuted["checks"][0]["cases"][0][0];
    EXPECT_EQ(sample["left"], 0.1);
    EXPECT_EQ(sample["holds"], false);
    EXPECT_EQ(refuted["ruled out"].size(), 3U);
}

} // namespace
} // namespace shadowbench
