#include "report/text_table.h"
#include "studies/claims/claims.h"
#include "studies/gpu_cost/gpu_cost.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace shadowbench::gpucost {
namespace {

constexpr std::size_t shownMisses = 10;

/// Below it a pass is its fixed costs, and the clock's own steps show.
constexpr double leastPass = 0.01; // ms

double medianOf(std::vector<double> values) {
    if (values.empty()) return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

double error(double modelled, double measured) { return std::max(modelled / measured, measured / modelled); }

std::string nearnessText(const Nearness& near) { return near.spearman ? fmt::format("{:.3f}", *near.spearman) : "–"; }

/// Times in ms, modelled beside measured.
struct Pairs {
    std::vector<double> modelled, measured;

    void add(double model, double measure) {
        modelled.push_back(model);
        measured.push_back(measure);
    }
};

struct Group {
    Pairs frames, passes;
    std::size_t waiting = 0;
};

using Groups = std::map<std::tuple<std::string, std::string, int, int>, Group>; // card, scene, width, height

Groups groupsOf(const std::vector<ModelledFrame>& frames) {
    Groups groups;
    for (const ModelledFrame& frame : frames) {
        if (!frame.measured) continue;
        Group& group = groups[{frame.card, frame.scene, frame.size.x, frame.size.y}];
        for (const ModelledPass& pass : frame.passes)
            if (!pass.terms.waits && pass.measured.value_or(0) >= leastPass)
                group.passes.add(1e3 * pass.terms.seconds(), *pass.measured);
        if (frame.waits)
            ++group.waiting;
        else
            group.frames.add(1e3 * frame.time.seconds, *frame.measured);
    }
    return groups;
}

double constantOf(const Groups& groups) {
    Pairs all;
    for (const auto& [key, group] : groups)
        for (std::size_t i = 0; i < group.frames.modelled.size(); ++i)
            all.add(group.frames.modelled[i], group.frames.measured[i]);
    return fittedConstant(all.modelled, all.measured);
}

std::string nearnessTable(const Groups& groups, double constant) {
    report::TextTable table{{"card, scene, image", "frames", "that wait", "Spearman", "median error", "passes",
                             "Spearman of passes", "median error of passes"},
                            {}};
    for (const auto& [key, group] : groups) {
        const auto& [card, scene, width, height] = key;
        const Nearness frames = nearness(group.frames.modelled, group.frames.measured, constant);
        const Nearness passes = nearness(group.passes.modelled, group.passes.measured, constant);
        table.rows.push_back({fmt::format("{} {} {}×{}", card, scene, width, height), fmt::format("{}", frames.count),
                              fmt::format("{}", group.waiting), nearnessText(frames), fmt::format("×{:.2f}", frames.median),
                              fmt::format("{}", passes.count), nearnessText(passes), fmt::format("×{:.2f}", passes.median)});
    }
    return report::aligned(table);
}

/// The pass whose modelled and measured times are furthest apart, in ms.
const ModelledPass* furthest(const ModelledFrame& frame, double constant) {
    const ModelledPass* found = nullptr;
    double most = 0;
    for (const ModelledPass& pass : frame.passes) {
        const double miss = std::abs(constant * 1e3 * pass.terms.seconds() - pass.measured.value_or(0));
        if (!pass.measured || miss < most) continue;
        found = &pass;
        most = miss;
    }
    return found;
}

std::string missesTable(const std::vector<ModelledFrame>& frames, double constant) {
    std::vector<std::pair<double, const ModelledFrame*>> misses;
    for (const ModelledFrame& frame : frames)
        if (frame.measured && !frame.waits)
            misses.emplace_back(error(constant * 1e3 * frame.time.seconds, *frame.measured), &frame);
    std::ranges::stable_sort(misses, std::ranges::greater(), &std::pair<double, const ModelledFrame*>::first);
    misses.resize(std::min(misses.size(), shownMisses));
    report::TextTable table{
        {"frame", "error", "modelled ms", "measured ms", "pass furthest off", "modelled ms", "by", "measured ms"}, {}};
    for (const auto& [miss, frame] : misses) {
        const ModelledPass* pass = furthest(*frame, constant);
        if (pass == nullptr) continue;
        table.rows.push_back({fmt::format("{} {} {}×{}", frame->scene, frame->variant, frame->size.x, frame->size.y),
                              fmt::format("×{:.2f}", miss), fmt::format("{:.3f}", constant * 1e3 * frame->time.seconds),
                              fmt::format("{:.3f}", *frame->measured), pass->name,
                              fmt::format("{:.3f}", constant * 1e3 * pass->terms.seconds()),
                              std::string(gpu::name(pass->terms.limit())), fmt::format("{:.3f}", *pass->measured)});
    }
    return report::aligned(table);
}

/// Of measured frames that do not wait: "2 of 3".
std::string withinIntervals(const std::vector<ModelledFrame>& frames) {
    std::size_t within = 0, all = 0;
    for (const ModelledFrame& frame : frames) {
        if (!frame.measured || frame.waits) continue;
        ++all;
        if (1e3 * frame.time.least <= *frame.measured && *frame.measured <= 1e3 * frame.time.most) ++within;
    }
    return fmt::format("{} of {}", within, all);
}

} // namespace

Nearness nearness(const std::vector<double>& modelled, const std::vector<double>& measured, double constant) {
    Nearness near{modelled.size(), rankCorrelation(modelled, measured), 1};
    std::vector<double> errors;
    for (std::size_t i = 0; i < modelled.size(); ++i) errors.push_back(error(constant * modelled[i], measured[i]));
    near.median = medianOf(std::move(errors));
    return near;
}

double fittedConstant(const std::vector<double>& modelled, const std::vector<double>& measured) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < modelled.size(); ++i) ratios.push_back(measured[i] / modelled[i]);
    return medianOf(std::move(ratios));
}

std::string comparison(const std::vector<ModelledFrame>& frames) {
    const Groups groups = groupsOf(frames);
    if (groups.empty()) return "";
    const double constant = constantOf(groups);
    return fmt::format(
        "Modelled against measured, after one constant for all frames: × {:.2f}. Frames that wait for the "
        "program are left out, and passes below {} ms.\n{}{} measured frames are within the modelled interval, "
        "without the constant.\n\nFurthest off:\n{}",
        constant, leastPass, nearnessTable(groups, constant), withinIntervals(frames), missesTable(frames, constant));
}

} // namespace shadowbench::gpucost
