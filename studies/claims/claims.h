// The seeds' claims as data (claims.json beside this file), and their verdicts, computed from records and never typed in.
#pragma once

#include "harness/records/record.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// A number of one record, or its quotient by that of another variant at the same place.
struct Figure {
    struct Divisor {
        std::string variant, metric;
    };
    std::string scene, variant;
    std::string profile; // that the record is of; "": any
    // Path in the record: "accuracy.mismatch", "cost.time.ratio", "figures.overshoot"; of a list, which has a number for
    // each frame, one of them, counted from 1 ("stability.by_frame.rmse[20]"), or with `settles` all. Several joined by
    // " + " or " - " are added up, in this order.
    std::string metric;
    std::string axis;            // of a sweep's record, else empty …
    std::optional<double> value; // … and the place on it
    std::optional<Divisor> over;
    std::optional<double> settles; // of a list: the frame from which on it is at most this; infinite if the last is not
    std::optional<std::uint32_t> seed = {}; // that the record was drawn with; nothing: any
};

/// A variant and the number that the document gives for it.
struct Published {
    std::string variant;
    double number;
};

/// Where a check is asked.
struct Case {
    Figure left;
    std::optional<Figure> right;
};

/// left ≤ factor × right, or left ≥ factor × right; without `right`, `factor` alone is the bound. With `growsOver` instead:
/// left is larger at each of these places on its axis than at the one before. With `published` instead: Spearman's rank
/// correlation (ties at their mean rank) between these numbers and ours of left's scene and metric is at least `factor`.
struct Check {
    std::string says;        // in words
    std::vector<Case> cases; // one for each scene, place or threshold that it lists; never empty
    bool atMost = true;
    double factor = 1;
    std::vector<double> growsOver;
    std::vector<Published> published;
};

struct Claim {
    std::string id;    // "K4"
    std::string says;  // in one sentence
    std::string where; // "P Fig. 4"
    std::vector<Check> checks;
    std::string untestable; // why it cannot be tested here; then there are no checks
    // "Suite.Name" of the test that computes a figure which contradicts the claim again, in double precision on the CPU;
    // empty where nothing does or the figure is a cost.
    std::string replay;
    std::string exact; // why figures have no interval, where they have none; else empty
    // Of a claim that is not reproduced, or partly: the document's own figure, what was ruled out as the cause (each check
    // that holds rules one out), and what is left, in words.
    std::string theirs;
    std::vector<Check> ruledOut;
    std::string left;
};

/// What a check found in one of its cases, in the records of one seed; figures without a record are absent.
struct Sample {
    std::optional<double> left, right;
    std::optional<double>
        margin; // by how much it holds, below 0 by how much it fails; absent where it only does or does not
    std::optional<bool> holds;
    std::vector<std::optional<double>> places = {}; // left at the places of `Check::growsOver`, or of `Check::published`
    // Half the 95 % intervals of left, right and margin over the rounds of what was timed; 0 of what is counted or scored.
    double leftWidth = 0, rightWidth = 0, marginWidth = 0;
};

/// Of one case: whether it holds, or its interval over seeds has the bound inside. Of several: `Partly` where they differ.
enum class Outcome { Yes, No, Partly, NotToldApart, NotMeasured };
std::string_view name(Outcome outcome);

struct Finding {
    std::vector<std::vector<Sample>> cases; // as Check::cases; a sample for each seed, one at least
    Outcome outcome;                        // NotMeasured if a case has no complete sample
};

enum class Verdict { Reproduced, Partly, NotReproduced, NotToldApart, NotTestable, NotMeasured };
std::string_view name(Verdict verdict);

struct Judgement {
    const Claim* claim;
    Verdict verdict;                // NotMeasured if a figure of any check is missing
    std::vector<Finding> findings;  // as Claim::checks
    std::vector<Finding> ruledOut;  // as Claim::ruledOut
    std::vector<std::string> basis; // the records that the figures are of: "basic, paper, 700²", each once
};

/// The claims that come with the program, by number.
const std::vector<Claim>& claims();

/// Throws BadInput naming claim and key for what is no list of claims.
std::vector<Claim> parseClaims(std::string_view json);

/// Spearman's rank correlation: Pearson's of the ranks, equal numbers having the mean of their ranks. Nothing for fewer than
/// two pairs, and where all numbers of one side are equal. The two are equally long.
std::optional<double> rankCorrelation(const std::vector<double>& ours, const std::vector<double>& theirs);

/// The number that a figure names, of the first record that has it: costs may stand in another file than errors. Nothing
/// where none has. `found`: learns of the records that were read.
std::optional<double> lookUp(const Figure& figure, const std::vector<Record>& records,
                             const std::function<void(const Record&)>& found = {});

/// All figures that a check compares, of any seed.
std::vector<Figure> figuresOf(const Check& check);

/// Of a case by its samples: that of the 95 % interval of their mean margin, over seeds and over rounds of times; of samples
/// without one, or with one that is infinite, that of all.
Outcome outcomeOf(const std::vector<Sample>& samples);

/// Each check is asked in each of its cases with the records of each seed.
Judgement judge(const Claim& claim, const std::vector<Record>& records);

/// What each check of a claim found, in words: "accuracy.mismatch of a on s = 0.0147 ≤ 0.5 × …: no".
std::vector<std::string> describedFindings(const Judgement& judgement);

/// "measured on basic, paper, 700²; computed again in double precision by Suite.Name"; "" where neither is known.
std::string basisOf(const Judgement& judgement);

/// Whether less was found than the document says.
bool isShort(Verdict verdict);

/// Of such a claim the document's figure, ours, what was ruled out and what is left; else "".
std::string paragraphOf(const Judgement& judgement);

/// "text" for a terminal, "md" or "json": every claim with its verdict and the figures it rests on.
std::string claimsReport(const std::vector<Judgement>& judgements, const std::string& format);

} // namespace shadowbench
