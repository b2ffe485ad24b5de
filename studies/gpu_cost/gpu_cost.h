// Milliseconds of frames on named cards, modelled (gpu/model.h) from what records count and what shaders cost; and beside
// what was measured, where a record was measured on such a card.
#pragma once

#include "base/error.h"
#include "gpu/model.h"
#include "harness/records/record.h"

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::gpucost {

struct ModelledPass {
    std::string name; // as in records
    gpu::Terms terms;
    std::optional<double> measured; // ms
};

/// Another frame than the standing one.
struct OtherFrame {
    double seconds = 0;
    std::vector<ModelledPass> passes; // none where it draws as the standing one does
};

/// A standing frame on one card, and what it takes in motion and from cold.
struct ModelledFrame {
    std::string scene, variant, card; // the card's id
    glm::ivec2 size{};
    gpu::FrameTime time; // s
    bool waits = false;  // for the program, in some pass: what that takes is not in `time`
    std::vector<ModelledPass> passes;
    std::optional<double> measured; // ms
    OtherFrame motion = {}, cold = {};

    /// The pass that takes longest.
    [[nodiscard]] const ModelledPass& slowest() const;
};

struct GpuCostOptions {
    std::vector<std::string> cards; // ids; empty: all
    std::vector<glm::ivec2> sizes{{1920, 1080}};
    std::filesystem::path cache; // empty: as of references
    bool quiet = false;
};

struct GpuCostResult {
    std::vector<ModelledFrame> frames;
    std::vector<std::string> errors;  // a sentence for each technique whose shaders have no figures
    std::vector<std::string> leftOut; // likewise for each technique on a scene whose counts do not suffice
    ExitCode code = ExitCode::Pass;
};

/// All frames of the sizes on all cards; then, where a record was measured on one of these cards, of the sizes that it was
/// measured on. Throws BadInput for records that cannot be joined with shaders: of other profiles than `gate`, or all
/// without counts.
GpuCostResult gpuCosts(const std::vector<Record>& records, const GpuCostOptions& options);

/// What a frame says in a record, by its name there (Record::modelled).
std::pair<std::string, ModelledCost> modelledCost(const ModelledFrame& frame);

/// Puts each frame into the first record of its technique and scene that counts work, in place of what was modelled before.
void addTo(std::vector<Record>& records, const std::vector<ModelledFrame>& frames);

/// For a terminal: a table for each scene, size and card; then, of measured frames, how near the model comes.
std::string tables(const std::vector<ModelledFrame>& frames);
std::string comparison(const std::vector<ModelledFrame>& frames);

/// How near modelled times come to measured ones.
struct Nearness {
    std::size_t count = 0;
    std::optional<double> spearman;
    double median = 1; // of max (m / p, p / m) with measured m and modelled p, after the constant
};

/// Both in one unit, equally long.
Nearness nearness(const std::vector<double>& modelled, const std::vector<double>& measured, double constant);

/// The constant by which modelled times are multiplied: the median of measured / modelled.
double fittedConstant(const std::vector<double>& modelled, const std::vector<double>& measured);

} // namespace shadowbench::gpucost
