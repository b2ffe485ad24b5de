// One cell of a level-of-detail technique: a variant on a scene's walk.
#pragma once

#include "harness/cells/lod_reference.h"
#include "harness/records/record.h"
#include "techniques/contract/entry.h"

#include <memory>
#include <optional>

namespace shadowbench::lod {

/// A scene's walk with what its cells share, made when first asked for.
class LodScene {
public:
    explicit LodScene(const Scene& scene) : scene_(scene) {}

    [[nodiscard]] const Scene& scene() const { return scene_; }
    LodStage& stage();
    LodStage& reversedStage(); // the same with all triangles drawn the other way round
    const LodReference& reference(const Progress& progress = [](double, std::string_view) {});

private:
    const Scene& scene_;
    std::optional<Scene> reversed_;
    std::unique_ptr<LodStage> stage_, reversedStage_;
    std::optional<LodReference> reference_;
};

/// Why the scene has nothing for level-of-detail techniques; nothing if it has.
std::optional<std::string> notApplicable(const Scene& scene);

/// Hash of everything a cell's scores depend on.
std::string lodCellId(const Scene& scene, const techniques::Variant& variant);

/// Fills in status, frames, work and the scores of a blank record. Pictures of the walk go to `keep` frame by frame, if it
/// is set.
using KeepPicture = std::function<void(int frame, const metrics::ColourImage& picture)>;
void scoreLodCell(LodScene& lodScene, const techniques::Variant& variant, Record& record, const Progress& progress,
                  const KeepPicture& keep);

/// Fills in the times of a scored record.
void timeLodCell(LodScene& lodScene, const techniques::Variant& variant, Record& record);

/// The frame with most transitions on an image of another size (timing::otherScreen).
OtherScreen measureOtherScreen(LodScene& lodScene, const techniques::Variant& variant);

} // namespace shadowbench::lod
