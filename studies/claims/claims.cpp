// Verdicts on claims, from records.
#include "studies/claims/claims.h"

#include "harness/metrics/scores.h"
#include "report/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool matches(const Record& record, const Figure& figure) {
    if (!figure.profile.empty() && record.profile != figure.profile) return false;
    if (figure.seed && record.seed != *figure.seed) return false;
    if (record.scene != figure.scene || record.sweep.has_value() != figure.value.has_value()) return false;
    if (!record.sweep) return record.variant == figure.variant;
    return record.sweep->axis == figure.axis && record.sweep->value == *figure.value &&
           record.sweep->curve == figure.variant;
}

/// The number in brackets that a path ends with; 0 if it ends with none.
std::size_t frameOf(const std::string& path) {
    const std::size_t bracket = path.find('[');
    return bracket == std::string::npos ? 0 : std::stoul(path.substr(bracket + 1));
}

/// What stands at a path of the record, whose keys are joined by dots; null if nothing does.
Json valueAt(const Record& record, const std::string& path) {
    Json json = Json::parse(toJson(record));
    const std::string keys = path.substr(0, path.find('['));
    for (std::size_t start = 0; start <= keys.size();) {
        const std::size_t end = std::min(keys.find('.', start), keys.size());
        const std::string key = keys.substr(start, end - start);
        if (!json.is_object() || !json.contains(key)) return {};
        Json inner = std::move(json[key]);
        json = std::move(inner);
        start = end + 1;
    }
    const std::size_t frame = frameOf(path);
    if (frame == 0) return json;
    return json.is_array() && frame <= json.size() ? json[frame - 1] : Json();
}

std::optional<double> numberIn(const Json& json) {
    return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

/// The frame, counted from 1, from which on all numbers are at most `bound`.
std::optional<double> settledFrom(const Json& list, double bound) {
    if (!list.is_array() || list.empty()) return std::nullopt;
    std::size_t restless = list.size(); // frames up to the last that exceeds the bound
    while (restless > 0 && list[restless - 1].get<double>() <= bound) --restless;
    return restless == list.size() ? infinity : static_cast<double>(restless + 1);
}

/// What stands at a path, or at several that are added up.
std::optional<double> numberOf(const Figure& figure, const Record& record) {
    if (figure.settles) return settledFrom(valueAt(record, figure.metric), *figure.settles);
    std::istringstream words(figure.metric);
    std::string path;
    double sum = 0, sign = 1;
    while (words >> path) {
        if (path == "+" || path == "-") {
            sign = path == "+" ? 1 : -1;
            continue;
        }
        const std::optional<double> term = numberIn(valueAt(record, path));
        if (!term) return std::nullopt;
        sum += sign * *term;
    }
    return sum;
}

/// Half the 95 % interval of a time of the record, as a share of it: that of its rounds. Of other metrics none.
double timeSpread(const Record& record, const std::string& metric) {
    if (metric.starts_with("cost.time.")) return report::spreadOf(record.values.list("cost.time.samples"));
    if (metric.starts_with("cost.motion.time.")) return report::spreadOf(record.values.list("cost.motion.time.samples"));
    return 0;
}

/// A figure in the records of one seed, or of any.
class LookUp {
public:
    LookUp(const std::vector<Record>& records, std::optional<std::uint32_t> seed) : records_(records), seed_(seed) {}

    std::optional<double> operator()(Figure figure) {
        if (seed_) figure.seed = seed_;
        width_ = 0;
        const std::optional<double> number = lookUp(figure, records_, [&](const Record& record) {
            read_.push_back(&record);
            width_ = std::hypot(width_, timeSpread(record, figure.metric));
        });
        width_ *= std::abs(number.value_or(0));
        return number;
    }

    /// Half the 95 % interval of the last number.
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] const std::vector<const Record*>& read() const { return read_; }

private:
    const std::vector<Record>& records_;
    std::optional<std::uint32_t> seed_;
    double width_ = 0;
    std::vector<const Record*> read_;
};

Figure atPlace(Figure figure, double place) {
    figure.value = place;
    return figure;
}

Figure ofVariant(Figure figure, const std::string& variant) {
    figure.variant = variant;
    return figure;
}

void decide(Sample& sample, double margin) {
    sample.margin = margin;
    sample.holds = margin >= 0;
}

Sample examineGrowth(const Check& check, const Figure& left, LookUp& number) {
    Sample sample;
    for (const double place : check.growsOver) sample.places.push_back(number(atPlace(left, place)));
    if (std::ranges::any_of(sample.places, [](const auto& value) { return !value; })) return sample;
    sample.holds = std::ranges::adjacent_find(sample.places, std::greater_equal<>()) == sample.places.end();
    return sample;
}

Sample examineOrder(const Check& check, const Figure& left, LookUp& number) {
    Sample sample;
    std::vector<double> ours, theirs;
    for (const Published& row : check.published) {
        sample.places.push_back(number(ofVariant(left, row.variant)));
        if (!sample.places.back()) continue;
        ours.push_back(*sample.places.back());
        theirs.push_back(row.number);
    }
    if (ours.size() < check.published.size()) return sample;
    sample.left = rankCorrelation(ours, theirs);
    if (sample.left) decide(sample, *sample.left - check.factor);
    return sample;
}

Sample examine(const Check& check, const Case& place, LookUp& number) {
    if (!check.growsOver.empty()) return examineGrowth(check, place.left, number);
    if (!check.published.empty()) return examineOrder(check, place.left, number);
    Sample sample{number(place.left), {}, {}, {}};
    sample.leftWidth = number.width();
    if (place.right) {
        sample.right = number(*place.right);
        sample.rightWidth = number.width();
    }
    if (!sample.left || (place.right && !sample.right)) return sample;
    const double bound = check.factor * sample.right.value_or(1);
    decide(sample, *sample.left == bound ? 0 : check.atMost ? bound - *sample.left : *sample.left - bound);
    sample.marginWidth = std::hypot(sample.leftWidth, check.factor * sample.rightWidth);
    return sample;
}

/// The seeds of all records that a case may be asked of.
std::set<std::uint32_t> seedsOf(const std::vector<Figure>& figures, const std::vector<Record>& records) {
    std::set<std::uint32_t> seeds;
    for (const Record& record : records)
        if (std::ranges::any_of(figures, [&](const Figure& figure) { return matches(record, figure); }))
            seeds.insert(record.seed);
    return seeds;
}

std::vector<Figure> figuresOf(const Check& check, const Case& place) {
    std::vector<Figure> figures;
    for (const double value : check.growsOver) figures.push_back(atPlace(place.left, value));
    for (const Published& row : check.published) figures.push_back(ofVariant(place.left, row.variant));
    if (figures.empty()) figures.push_back(place.left);
    if (place.right) figures.push_back(*place.right);
    return figures;
}

/// A sample for each seed of which there are all figures; if there is none, one that says what is missing.
std::vector<Sample> samplesOf(const Check& check, const Case& place, const std::vector<Record>& records,
                              const std::function<void(const Record&)>& found) {
    std::vector<Sample> complete;
    for (const std::uint32_t seed : seedsOf(figuresOf(check, place), records)) {
        LookUp number(records, seed);
        const Sample sample = examine(check, place, number);
        if (!sample.holds) continue;
        complete.push_back(sample);
        for (const Record* record : number.read()) found(*record);
    }
    if (!complete.empty()) return complete;
    LookUp number(records, {});
    const Sample sample = examine(check, place, number);
    for (const Record* record : number.read()) found(*record);
    return {sample};
}

Finding examine(const Check& check, const std::vector<Record>& records, const std::function<void(const Record&)>& found) {
    Finding finding{{}, Outcome::NotMeasured};
    std::vector<Outcome> outcomes;
    for (const Case& place : check.cases) {
        finding.cases.push_back(samplesOf(check, place, records, found));
        outcomes.push_back(outcomeOf(finding.cases.back()));
    }
    const auto isFirst = [&](Outcome outcome) { return outcome == outcomes.front(); };
    if (std::ranges::find(outcomes, Outcome::NotMeasured) == outcomes.end())
        finding.outcome = std::ranges::all_of(outcomes, isFirst) ? outcomes.front() : Outcome::Partly;
    return finding;
}

Verdict verdictOf(const std::vector<Finding>& findings) {
    std::size_t held = 0, failed = 0, cases = 0;
    for (const Finding& finding : findings) {
        if (finding.outcome == Outcome::NotMeasured) return Verdict::NotMeasured;
        held += std::ranges::count(finding.cases, Outcome::Yes, outcomeOf);
        failed += std::ranges::count(finding.cases, Outcome::No, outcomeOf);
        cases += finding.cases.size();
    }
    if (held == cases) return Verdict::Reproduced;
    if (held > 0) return Verdict::Partly;
    return failed > 0 ? Verdict::NotReproduced : Verdict::NotToldApart;
}

/// The place of each number among all, from 1; equal ones have the mean of their places.
std::vector<double> meanRanks(const std::vector<double>& numbers) {
    std::vector<double> ranks;
    for (const double number : numbers) {
        const auto below = std::ranges::count_if(numbers, [&](double other) { return other < number; });
        const auto equal = std::ranges::count(numbers, number);
        ranks.push_back(static_cast<double>(below) + 0.5 * static_cast<double>(equal + 1));
    }
    return ranks;
}

} // namespace

std::optional<double> lookUp(const Figure& figure, const std::vector<Record>& records,
                             const std::function<void(const Record&)>& found) {
    std::optional<double> number;
    for (const Record& record : records) {
        if (number || !matches(record, figure)) continue;
        number = numberOf(figure, record);
        if (number && found) found(record);
    }
    if (!number || !figure.over) return number;
    Figure divisor = figure;
    divisor.variant = figure.over->variant;
    divisor.metric = figure.over->metric;
    divisor.over.reset();
    const std::optional<double> divided = lookUp(divisor, records, found);
    return divided && *divided != 0 ? std::optional(*number / *divided) : std::nullopt;
}

std::vector<Figure> figuresOf(const Check& check) {
    std::vector<Figure> all;
    for (const Case& place : check.cases)
        for (Figure& figure : figuresOf(check, place)) all.push_back(std::move(figure));
    return all;
}

Outcome outcomeOf(const std::vector<Sample>& samples) {
    std::vector<double> margins;
    double timesWidth = 0; // of their mean
    for (const Sample& sample : samples) {
        if (!sample.holds) return Outcome::NotMeasured;
        timesWidth = std::hypot(timesWidth, sample.marginWidth / static_cast<double>(samples.size()));
        if (sample.margin && std::isfinite(*sample.margin)) margins.push_back(*sample.margin);
    }
    if (margins.size() < samples.size()) {
        const auto held = std::ranges::count_if(samples, [](const Sample& sample) { return *sample.holds; });
        return held == 0 ? Outcome::No : held == std::ssize(samples) ? Outcome::Yes : Outcome::NotToldApart;
    }
    const auto [mean, seedsWidth] = metrics::meanInterval(margins);
    const double halfWidth = std::hypot(seedsWidth, timesWidth);
    return mean - halfWidth >= 0 ? Outcome::Yes : mean + halfWidth < 0 ? Outcome::No : Outcome::NotToldApart;
}

std::string_view name(Outcome outcome) {
    switch (outcome) {
    case Outcome::Yes:
        return "yes";
    case Outcome::No:
        return "no";
    case Outcome::Partly:
        return "partly";
    case Outcome::NotToldApart:
        return "not told apart";
    case Outcome::NotMeasured:
        return "not measured";
    }
    return "";
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
    case Verdict::Reproduced:
        return "reproduced";
    case Verdict::Partly:
        return "partly";
    case Verdict::NotReproduced:
        return "not reproduced";
    case Verdict::NotToldApart:
        return "not told apart";
    case Verdict::NotTestable:
        return "not testable here";
    case Verdict::NotMeasured:
        return "not measured";
    }
    return "";
}

std::optional<double> rankCorrelation(const std::vector<double>& ours, const std::vector<double>& theirs) {
    const std::vector<double> a = meanRanks(ours), b = meanRanks(theirs);
    const double middle = 0.5 * static_cast<double>(a.size() + 1);
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - middle) * (b[i] - middle);
        aa += (a[i] - middle) * (a[i] - middle);
        bb += (b[i] - middle) * (b[i] - middle);
    }
    return aa > 0 && bb > 0 ? std::optional(ab / std::sqrt(aa * bb)) : std::nullopt;
}

Judgement judge(const Claim& claim, const std::vector<Record>& records) {
    if (!claim.untestable.empty()) return {&claim, Verdict::NotTestable, {}, {}, {}};
    std::vector<std::string> basis;
    const auto found = [&](const Record& record) {
        const std::string name = fmt::format("{}, {}, {}", record.scene, record.profile, report::imageSize(record));
        if (std::ranges::find(basis, name) == basis.end()) basis.push_back(name);
    };
    Judgement judgement{&claim, Verdict::NotMeasured, {}, {}, {}};
    for (const Check& check : claim.checks) judgement.findings.push_back(examine(check, records, found));
    for (const Check& check : claim.ruledOut) judgement.ruledOut.push_back(examine(check, records, found));
    judgement.verdict = verdictOf(judgement.findings);
    judgement.basis = std::move(basis);
    return judgement;
}

} // namespace shadowbench
