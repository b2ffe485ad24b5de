#include "studies/gpu_cost/gpu_cost.h"

#include "scene/load/load.h"
#include "studies/gpu_cost/pass_work.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace shadowbench::gpucost {
namespace {

std::vector<gpu::Card> chosenCards(const std::vector<std::string>& ids) {
    if (ids.empty()) return gpu::cards();
    std::vector<gpu::Card> chosen;
    for (const std::string& id : ids) chosen.push_back(gpu::cardNamed(id));
    return chosen;
}

bool hasCounts(const Record& record) { return !record.passes.empty() || !record.deviceCosts.empty(); }

void requireJoinable(const std::vector<Record>& records) {
    for (const Record& record : records)
        if (hasCounts(record) && record.profile != "gate")
            throw BadInput(
                fmt::format("the record of {} on {} is of the profile {}, and shaders are drawn in the profile gate; "
                            "name records of that one",
                            record.variant, record.scene, record.profile));
    if (std::ranges::none_of(records, hasCounts))
        throw BadInput("no record counts the work of its passes; name records of `shadowbench run` with costs");
}

using shaders::CountedFrame;

/// A technique's name → its shaders in one frame of one scene.
std::map<std::string, Drawn> drawnOn(const std::string& scene, CountedFrame frame, const std::vector<std::string>& variants,
                                     const GpuCostOptions& options, GpuCostResult& result) {
    shaders::ShaderCostOptions asked;
    asked.techniques = variants;
    asked.scene = scene;
    asked.frame = frame;
    asked.architectures = {architecture};
    asked.cache = options.cache;
    asked.quiet = options.quiet;
    shaders::ShaderCostResult found = shaders::shaderCosts(asked);
    for (const std::string& error : found.errors) result.errors.push_back(error);
    if (found.code != ExitCode::Pass) result.code = found.code;
    const glm::ivec2 screen = loadScene(scene, Profile::Gate).size;
    std::map<std::string, Drawn> drawn;
    for (shaders::ShaderCost& shader : found.costs.shaders) drawn[shader.technique].shaders.push_back(std::move(shader));
    for (shaders::FrameMove& move : found.costs.moves) drawn[move.technique].moves.push_back(std::move(move));
    for (auto& [variant, each] : drawn) each.screen = screen;
    return drawn;
}

bool wasMeasuredOn(const Record& record, const gpu::Card& card) {
    return !record.deviceCosts.empty() && record.environment.renderer.starts_with(card.name);
}

/// The shaders of one technique on one scene, by frame; only the standing one where the others draw as it does.
using DrawnFrames = std::map<CountedFrame, Drawn>;

ModelledFrame modelled(const Cell& cell, const DrawnFrames& drawn, const gpu::Card& card, glm::ivec2 size) {
    ModelledFrame frame{cell.front()->scene, cell.front()->variant, card.id, size, {}, false, {}, {}};
    for (const auto& [which, shaders] : drawn) {
        std::vector<gpu::PassWork> works;
        std::vector<ModelledPass> passes;
        for (const NamedWork& named : worksOf(cell, shaders, size, which)) {
            works.push_back(named.work);
            passes.push_back({named.pass, gpu::termsOf(named.work, card), {}});
            frame.waits |= passes.back().terms.waits;
        }
        const gpu::FrameTime time = gpu::frameTime(works, card);
        if (which == CountedFrame::Standing) {
            frame.time = time;
            frame.passes = std::move(passes);
        } else {
            (which == CountedFrame::First ? frame.cold : frame.motion) = {time.seconds, std::move(passes)};
        }
    }
    return frame;
}

glm::ivec2 sizeOf(const DeviceCost& cost) { return {cost.width, cost.height}; }

ModelledFrame beside(ModelledFrame frame, const DeviceCost& cost) {
    frame.measured = cost.median;
    for (ModelledPass& pass : frame.passes)
        for (const PassRecord& measured : cost.passes)
            if (measured.name == pass.name) pass.measured = measured.milliseconds;
    return frame;
}

std::vector<ModelledFrame> framesOf(const Cell& cell, const DrawnFrames& drawn, const std::vector<gpu::Card>& cards,
                                    const std::vector<glm::ivec2>& sizes) {
    std::vector<ModelledFrame> frames;
    for (const gpu::Card& card : cards) {
        std::vector<const DeviceCost*> measured;
        for (const Record* record : cell)
            if (wasMeasuredOn(*record, card))
                for (const DeviceCost& cost : record->deviceCosts) measured.push_back(&cost);
        for (const glm::ivec2& size : sizes)
            if (std::ranges::none_of(measured, [&](const DeviceCost* cost) { return size == sizeOf(*cost); }))
                frames.push_back(modelled(cell, drawn, card, size));
        for (const DeviceCost* cost : measured) frames.push_back(beside(modelled(cell, drawn, card, sizeOf(*cost)), *cost));
    }
    return frames;
}

/// In milliseconds.
std::vector<PassTerms> termsOf(const std::vector<ModelledPass>& passes) {
    std::vector<PassTerms> all;
    for (const ModelledPass& pass : passes) {
        const gpu::Terms& terms = pass.terms;
        all.push_back({pass.name, 1e3 * terms.arithmetic, 1e3 * terms.texture, 1e3 * terms.output, 1e3 * terms.geometry,
                       1e3 * terms.memory, 1e3 * terms.fixed});
    }
    return all;
}

/// In the order of the records; of each, those of graphics processors first: they count on images as large as screens.
std::vector<Cell> cellsOf(const std::vector<Record>& records) {
    std::vector<Cell> cells;
    for (const Record& record : records) {
        if (!hasCounts(record)) continue;
        const auto isSame = [&](const Cell& cell) {
            return cell.front()->scene == record.scene && cell.front()->variant == record.variant;
        };
        const auto found = std::ranges::find_if(cells, isSame);
        (found == cells.end() ? cells.emplace_back() : *found).push_back(&record);
    }
    for (Cell& cell : cells)
        std::ranges::stable_partition(cell, [](const Record* record) { return !record->deviceCosts.empty(); });
    return cells;
}

} // namespace

const ModelledPass& ModelledFrame::slowest() const {
    return *std::ranges::max_element(passes, {}, [](const ModelledPass& pass) { return pass.terms.seconds(); });
}

std::pair<std::string, ModelledCost> modelledCost(const ModelledFrame& frame) {
    ModelledCost cost{1e3 * frame.time.seconds, 1e3 * frame.time.least, 1e3 * frame.time.most, frame.waits,
                      termsOf(frame.passes)};
    const auto add = [](const OtherFrame& other, std::optional<double>& milliseconds, std::vector<PassTerms>& passes) {
        if (other.passes.empty()) return;
        milliseconds = 1e3 * other.seconds;
        passes = termsOf(other.passes);
    };
    add(frame.motion, cost.motion, cost.motionPasses);
    add(frame.cold, cost.cold, cost.coldPasses);
    return {fmt::format("{}@{}x{}", frame.card, frame.size.x, frame.size.y), std::move(cost)};
}

void addTo(std::vector<Record>& records, const std::vector<ModelledFrame>& frames) {
    std::map<std::pair<std::string, std::string>, Record*> first; // by scene and variant
    for (Record& record : records) {
        record.modelled.clear();
        if (hasCounts(record)) first.try_emplace({record.scene, record.variant}, &record);
    }
    for (const ModelledFrame& frame : frames) first.at({frame.scene, frame.variant})->modelled.insert(modelledCost(frame));
}

GpuCostResult gpuCosts(const std::vector<Record>& records, const GpuCostOptions& options) {
    const std::vector<gpu::Card> cards = chosenCards(options.cards);
    requireJoinable(records);
    const std::vector<Cell> cells = cellsOf(records);
    std::map<std::pair<std::string, CountedFrame>, std::vector<std::string>> variants; // of each scene
    for (const Cell& cell : cells)
        for (const CountedFrame frame : {CountedFrame::Standing, CountedFrame::First, CountedFrame::InMotion})
            if (frame == CountedFrame::Standing ||
                std::ranges::any_of(cell, [&](const Record* record) { return !passesOf(*record, frame).empty(); }))
                variants[{cell.front()->scene, frame}].push_back(cell.front()->variant);
    std::map<std::pair<std::string, std::string>, DrawnFrames> drawn; // by scene and variant
    GpuCostResult result;
    for (const auto& [place, names] : variants)
        for (auto& [variant, each] : drawnOn(place.first, place.second, names, options, result))
            drawn[{place.first, variant}].emplace(place.second, std::move(each));
    for (const Cell& cell : cells) {
        const auto found = drawn.find({cell.front()->scene, cell.front()->variant});
        if (found == drawn.end() || !found->second.contains(CountedFrame::Standing)) continue;
        try {
            std::ranges::move(framesOf(cell, found->second, cards, options.sizes), std::back_inserter(result.frames));
        } catch (const BadInput& error) {
            result.leftOut.emplace_back(error.what());
        }
    }
    return result;
}

} // namespace shadowbench::gpucost
