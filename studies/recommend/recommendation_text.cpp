#include "studies/recommend/recommendation_text.h"

#include "report/costing.h"
#include "report/text_table.h"
#include "studies/causes/causes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench::recommend {
namespace {

using nlohmann::ordered_json;

/// Three digits: a tolerance may be missed by little.
std::string asText(const std::string& metric, double value) {
    return report::isShare(metric) ? fmt::format("{:.3g} %", 100 * value) : fmt::format("{:.3g}", value);
}

/// The errors that have a tolerance.
std::string asText(const Errors& errors, const Errors& tolerance) {
    std::vector<std::string> parts;
    for (const auto& [metric, error] : errors)
        if (tolerance.contains(metric)) parts.push_back(metric + " " + asText(metric, error));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string distances(const GroupLevel& group) {
    if (std::isinf(group.until)) return group.from == 0 ? "all" : fmt::format("from {:g} m", group.from);
    return fmt::format("{:g} to {:g} m", group.from, group.until);
}

/// Such a group has no coarser level anywhere.
bool castsNothing(const GroupLevel& group) { return group.chain[group.level] == 0; }

std::string groupTable(const CasterRecommendation& c) {
    report::TextTable table{{"casters", "distance", "instances", "levels", "cast at", "triangles", "one level coarser"}, {}};
    for (const GroupLevel& group : c.groups) {
        const std::string coarser = group.coarser         ? asText(group.coarser->verified, c.tolerance)
                                    : castsNothing(group) ? "there is none"
                                                          : "none in the chain";
        table.rows.push_back({group.object, distances(group), fmt::format("{}", group.instances),
                              fmt::format("{}", fmt::join(group.chain, " ")), fmt::format("{}", group.chain[group.level]),
                              fmt::format("{}", group.triangles()), coarser});
    }
    return report::aligned(table);
}

/// How many groups could cast at a coarser level of their chain, and how many are at its end and cast all the same.
std::size_t coarserLevels(const CasterRecommendation& c) {
    return static_cast<std::size_t>(
        std::ranges::count_if(c.groups, [](const GroupLevel& g) { return g.coarser.has_value(); }));
}

std::size_t endsOfChains(const CasterRecommendation& c) {
    return static_cast<std::size_t>(
        std::ranges::count_if(c.groups, [](const GroupLevel& g) { return !g.coarser && !castsNothing(g); }));
}

std::string verification(const CasterRecommendation& c) {
    std::string line = fmt::format("{} by {}: at these levels {}", c.verified ? "verified" : "NOT VERIFIED", c.verifier,
                                   asText(c.verifiedErrors, c.tolerance));
    if (c.verified && coarserLevels(c) > 0) line += ", with any one group a level coarser above tolerance";
    if (const std::size_t ends = endsOfChains(c); ends > 0)
        line +=
            fmt::format("; {} of {} groups cast at the end of their chain, and nothing says that a coarser level would not "
                        "do: give more with --levels",
                        ends, c.groups.size());
    return line;
}

std::string text(const CasterRecommendation& c) {
    const auto saved = [&](std::size_t triangles) {
        return 100 - 100 * static_cast<double>(triangles) / static_cast<double>(c.finestTriangles);
    };
    std::string lines = fmt::format(" coarsest shadow casters within {} of their finest levels · {} · frame {}\n",
                                    asText(c.tolerance, c.tolerance), c.profile, c.frame);
    lines += groupTable(c);
    lines +=
        fmt::format(" triangles: {} of {}, {:.0f} % saved, at {} ({}; {} of {} choices judged)\n", c.triangles,
                    c.finestTriangles, saved(c.triangles), asText(c.errors, c.tolerance), c.oracle, c.tried, c.possible);
    lines += fmt::format(" cast at the levels that are drawn: {} triangles, {:.0f} % saved, at {}: {} tolerance\n",
                         c.drawnTriangles, saved(c.drawnTriangles), asText(c.drawnErrors, c.tolerance),
                         within(c.drawnErrors, c.tolerance) ? "within" : "above");
    lines += fmt::format(" {}\n", verification(c));
    lines +=
        fmt::format(" counted on objects without levels: {} of {} receiver pixels\n", c.receiverPixels, c.allReceiverPixels);
    return lines;
}

/// `unit` is that of the amounts.
std::string leastTable(const std::string& what, const std::string& unit, const std::vector<Least>& all,
                       const std::vector<report::Tolerance>& tolerances) {
    const std::string heading = fmt::format(" {} within {}", what, report::formatBounds(tolerances));
    if (all.empty()) return heading + ": no technique that was tried has one\n";
    report::TextTable table{{"technique", unit, "error"}, {}};
    for (const Least& least : all)
        table.rows.push_back(
            {least.variant, fmt::format("{:g}", least.amount), asText(tolerances.front().metric, least.error)});
    return heading + "\n" + report::aligned(table);
}

std::string unitOf(const std::string& card) {
    return card.empty() ? "frames of sm-uniform" : fmt::format("ms on {}, modelled", report::cardAndSize(card));
}

std::string cheapestLine(const std::optional<Cheapest>& technique, const std::vector<report::Tolerance>& tolerances) {
    const std::string heading = fmt::format(" cheapest technique within {}", report::formatBounds(tolerances));
    if (!technique) return heading + ": none\n";
    return fmt::format("{}: {}, at {} and {:.2f} {}, {}\n", heading, technique->variant,
                       asText(tolerances.front().metric, technique->error), technique->cost, unitOf(technique->card),
                       technique->moving ? "the dearer of standing and in motion" : "standing");
}

/// What is left of the error of the advised row, or of the best.
std::string leftLine(const causes::Explanation& left) {
    if (left.isRight()) return "";
    return fmt::format("   the error of {}, in %: {}; change first: {}\n", left.variant, causes::sharesText(left),
                       left.change);
}

std::vector<std::string> idsOf(const Recommendations& all) {
    std::vector<std::string> ids;
    for (const Recommendation& one : all.scenes) ids.push_back(one.scene);
    return ids;
}

bool asksForTechnique(const Recommendations& all) {
    return all.scenes.size() > 1 && std::ranges::any_of(all.scenes, [](const Recommendation& one) {
               return one.questions.contains(Question::Technique);
           });
}

ordered_json toJson(const GroupLevel& group) {
    ordered_json result{{"object", group.object}, {"from", group.from}};
    if (!std::isinf(group.until)) result["until"] = group.until;
    result["instances"] = group.instances;
    result["levels"] = group.chain;
    result["level"] = group.level;
    result["triangles"] = group.chain[group.level];
    if (group.coarser)
        result["coarser"] = {{"level", group.coarser->level},
                             {"errors", group.coarser->errors},
                             {"verified_errors", group.coarser->verified}};
    return result;
}

ordered_json toJson(const CasterRecommendation& c) {
    ordered_json result{{"profile", c.profile}, {"frame", c.frame}, {"size", {c.size.x, c.size.y}}};
    for (const auto& [metric, worst] : c.tolerance) result["tolerance"][metric] = worst;
    for (const GroupLevel& group : c.groups) result["groups"].push_back(toJson(group));
    result["oracle"] = c.oracle;
    result["errors"] = c.errors;
    result["all_triangles"] = c.triangles;
    result["finest"] = {{"all_triangles", c.finestTriangles}};
    result["drawn"] = {{"all_triangles", c.drawnTriangles}, {"errors", c.drawnErrors}};
    result["verifier"] = c.verifier;
    result["verified_errors"] = c.verifiedErrors;
    result["verified"] = c.verified;
    result["receiver_pixels"] = c.receiverPixels;
    result["all_receiver_pixels"] = c.allReceiverPixels;
    return result;
}

ordered_json toJson(const std::vector<Least>& all, const std::string& amount) {
    ordered_json result = ordered_json::array();
    for (const Least& least : all)
        result.push_back({{"variant", least.variant}, {amount, least.amount}, {"error", least.error}});
    return result;
}

ordered_json toJson(const Recommendation& r) {
    ordered_json result{{"scene", r.scene}};
    if (r.casters) result["casters"] = toJson(*r.casters);
    for (const report::Tolerance& limit : r.tolerances) result["tolerance"][limit.metric] = limit.value;
    if (r.technique)
        result["technique"] = {{"variant", r.technique->variant},
                               {"error", r.technique->error},
                               {"cost", r.technique->cost},
                               {"in_motion", r.technique->moving}};
    if (r.technique && !r.technique->card.empty()) result["technique"]["modelled_on"] = r.technique->card;
    if (!r.techniqueNotes.empty()) result["notes"] = r.techniqueNotes;
    if (r.left) {
        ordered_json& left = result["left"] = {{"variant", r.left->variant}, {r.left->metric, r.left->error}};
        for (const auto& [cause, error] : r.left->parts) left["causes"][std::string(causes::name(cause))] = error;
        if (!r.left->isRight()) left["change"] = r.left->change;
    }
    if (r.questions.contains(Question::Map)) result["map"] = toJson(r.maps, "texels");
    if (r.questions.contains(Question::Samples)) result["samples"] = toJson(r.samples, "samples");
    return result;
}

} // namespace

std::string text(const Recommendation& r) {
    std::string lines = fmt::format(" scene: {}\n", r.scene);
    if (r.casters) lines += text(*r.casters);
    if (r.questions.contains(Question::Technique)) lines += cheapestLine(r.technique, r.tolerances);
    for (const std::string& note : r.techniqueNotes) lines += fmt::format("   {}\n", note);
    if (r.questions.contains(Question::Map)) lines += leastTable("smallest map", "texels a side", r.maps, r.tolerances);
    if (r.questions.contains(Question::Samples)) lines += leastTable("fewest samples", "samples", r.samples, r.tolerances);
    if (r.left) lines += leftLine(*r.left);
    return lines;
}

std::string commonText(const Recommendations& all) {
    if (!asksForTechnique(all)) return "";
    const std::string heading = fmt::format(" one technique for {}", fmt::join(idsOf(all), ", "));
    if (!all.common) return heading + ": none is within tolerance on all of them\n";
    return fmt::format("{}: {}, at most {:.2f} {} (on {})\n", heading, all.common->variant, all.common->cost,
                       unitOf(all.common->card), all.common->dearest);
}

std::string json(const Recommendations& all) {
    ordered_json list = ordered_json::array();
    for (const Recommendation& one : all.scenes) list.push_back(toJson(one));
    if (asksForTechnique(all)) {
        ordered_json technique;
        if (all.common)
            technique = {
                {"variant", all.common->variant}, {"cost", all.common->cost}, {"dearest_scene", all.common->dearest}};
        list.push_back({{"scenes", idsOf(all)}, {"technique", technique}});
    }
    return list.dump(2);
}

} // namespace shadowbench::recommend
