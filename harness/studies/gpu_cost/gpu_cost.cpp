#include "harness/studies/gpu_cost/gpu_cost.h"

#include "harness/studies/gpu_cost/pass_work.h"
#include "scene/load/load.h"

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

/// A technique's name → its shaders on one scene.
std::map<std::string, Drawn> drawnOn(const std::string& scene, const std::vector<std::string>& variants,
                                     const GpuCostOptions& options, GpuCostResult& result) {
    shaders::ShaderCostOptions asked;
    asked.techniques = variants;
    asked.scene = scene;
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

ModelledFrame modelled(const Record& record, const Drawn& drawn, const gpu::Card& card, glm::ivec2 size) {
    ModelledFrame frame{record.scene, record.variant, card.id, size, {}, false, {}, {}};
    std::vector<gpu::PassWork> works;
    for (const NamedWork& named : worksOf(record, drawn, size)) {
        works.push_back(named.work);
        frame.passes.push_back({named.pass, gpu::termsOf(named.work, card), {}});
        frame.waits |= frame.passes.back().terms.waits;
    }
    frame.time = gpu::frameTime(works, card);
    return frame;
}

ModelledFrame beside(ModelledFrame frame, const DeviceCost& cost) {
    frame.measured = cost.median;
    for (ModelledPass& pass : frame.passes)
        for (const PassRecord& measured : cost.passes)
            if (measured.name == pass.name) pass.measured = measured.milliseconds;
    return frame;
}

std::vector<ModelledFrame> framesOf(const Record& record, const Drawn& drawn, const std::vector<gpu::Card>& cards,
                                    glm::ivec2 size) {
    std::vector<ModelledFrame> frames;
    for (const gpu::Card& card : cards) {
        frames.push_back(modelled(record, drawn, card, size));
        if (!wasMeasuredOn(record, card)) continue;
        for (const DeviceCost& cost : record.deviceCosts)
            frames.push_back(beside(modelled(record, drawn, card, {cost.width, cost.height}), cost));
    }
    return frames;
}

void addFrames(const Record& record, const Drawn& drawn, const std::vector<gpu::Card>& cards, glm::ivec2 size,
               GpuCostResult& result) {
    try {
        std::ranges::move(framesOf(record, drawn, cards, size), std::back_inserter(result.frames));
    } catch (const BadInput& error) {
        result.leftOut.emplace_back(error.what());
    }
}

} // namespace

const ModelledPass& ModelledFrame::slowest() const {
    return *std::ranges::max_element(passes, {}, [](const ModelledPass& pass) { return pass.terms.seconds(); });
}

GpuCostResult gpuCosts(const std::vector<Record>& records, const GpuCostOptions& options) {
    const std::vector<gpu::Card> cards = chosenCards(options.cards);
    requireJoinable(records);
    std::vector<std::string> scenes; // in the order of the records
    std::map<std::string, std::vector<std::string>> variants;
    for (const Record& record : records) {
        if (!hasCounts(record)) continue;
        if (!variants.contains(record.scene)) scenes.push_back(record.scene);
        variants[record.scene].push_back(record.variant);
    }
    GpuCostResult result;
    for (const std::string& scene : scenes) {
        const std::map<std::string, Drawn> drawn = drawnOn(scene, variants.at(scene), options, result);
        for (const Record& record : records)
            if (hasCounts(record) && record.scene == scene)
                if (const auto found = drawn.find(record.variant); found != drawn.end())
                    addFrames(record, found->second, cards, options.size, result);
    }
    return result;
}

} // namespace shadowbench::gpucost
