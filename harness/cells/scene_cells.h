// The cells of one scene, shadows and levels of detail alike, with what they share.
#pragma once

#include "base/error.h"
#include "harness/cells/cell.h"
#include "harness/cells/lod_cell.h"
#include "harness/cells/measure_options.h"
#include "harness/cells/neighbours.h"
#include "harness/cells/scene_frames.h"
#include "harness/cells/shading.h"
#include "harness/cells/truths.h"
#include "harness/measure/device_cost.h"
#include "harness/records/record.h"
#include "techniques/contract/entry.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {

struct CellImages;

class SceneCells {
public:
    /// Scene and cache must outlive the object.
    SceneCells(const Scene& scene, const groundtruth::Cache& cache, MeasureOptions options);
    explicit SceneCells(Scene&&, const groundtruth::Cache&, MeasureOptions) = delete;

    /// Why the variant has no cell here; nothing if it has.
    [[nodiscard]] std::optional<std::string> notApplicable(const techniques::Variant& variant) const;

    /// The `cell` of its record. Computes no truth and needs no GL context; throws Inconclusive if a tool that a truth
    /// depends on is missing.
    [[nodiscard]] std::string id(const techniques::Variant& variant) const;

    /// What is known before it runs: of a variant that does not apply, all. Needs a GL context, as all that follows.
    [[nodiscard]] Record blank(const techniques::Variant& variant) const;

    /// The record of a cell that `error` ended.
    [[nodiscard]] Record failed(const techniques::Variant& variant, const std::string& cell, const Error& error) const;

    /// The truths that the variant's scores need, frame by frame; none of a level-of-detail technique.
    [[nodiscard]] std::vector<std::pair<Truth, int>> truthsOf(const techniques::Variant& variant) const;

    /// Whether the cache holds a truth, which may be damaged.
    [[nodiscard]] bool isKept(Truth truth, int frame) const { return truths_.isKept(truth, frame); }

    /// Makes sure that it does. Needs no GL context.
    void computeTruth(Truth truth, int frame, const Progress& progress);

    /// Fills in the blank record of a variant that applies, all but times, and writes the images. Truths come first, with
    /// their own progress: they are the long part of an empty cache. Throws what rendering and truths throw.
    void score(const techniques::Variant& variant, Record& record, const Progress& progress);

    /// Fills in the times of a scored record that are asked for, which need an idle core.
    void time(const techniques::Variant& variant, Record& record);

    /// Both.
    void measure(const techniques::Variant& variant, Record& record, const Progress& progress);

private:
    [[nodiscard]] Record described(const techniques::Variant& variant) const;
    void scoreBeside(const techniques::Variant& variant, Record& record);
    void scoreOwn(const techniques::Variant& variant, Record& record, CellImages& images);
    void scoreLod(const techniques::Variant& variant, Record& record, const Progress& progress);
    void timeLod(const techniques::Variant& variant, Record& record);
    timing::DeviceMeter& device();
    SceneFrames& frames();
    void keepImages(const techniques::Variant& variant, const CellImages& images);
    std::vector<Image<float>> truthSequence(Truth truth);

    /// What the changes of a variant's images from frame to frame are compared with.
    [[nodiscard]] Truth movingTruth(const techniques::Variant& variant) const;
    [[nodiscard]] std::filesystem::path imageFolder(const techniques::Variant& variant) const;

    const Scene& scene_;
    MeasureOptions options_;
    const groundtruth::Cache& cache_;
    Truths truths_;
    lod::LodScene lodScene_;
    std::optional<SceneFrames> frames_;
    std::unique_ptr<timing::DeviceMeter> device_;
    std::unique_ptr<ChangedScene> neighbour_;
    std::vector<std::unique_ptr<ChangedScene>> otherViews_;
    std::set<Truth> keptTruths_, keptSequences_; // whose files this object has written
    std::optional<PictureShading> shading_;      // the same: once it is made, it is written
};

} // namespace shadowbench
