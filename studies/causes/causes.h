// Why rows are wrong: `shadowbench causes`.
#pragma once

#include "base/error.h"
#include "scene/scene.h"
#include "studies/causes/explanation.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace shadowbench::causes {

struct CausesOptions {
    std::vector<std::string> scenes;     // ids or files; empty: the standard ones
    std::vector<std::string> techniques; // variants or globs; empty: all
    Profile profile = Profile::Gate;
    int casterLevel = 0; // by how many levels coarser casters are than the finest; 0: as the scene draws them
    std::uint32_t seed = 1;
    std::filesystem::path cache;
    std::filesystem::path out = "results/causes"; // of pictures
    bool quiet = false;
};

/// The rows of one scene. Their splits have been drawn as pictures and let go.
struct SceneCauses {
    std::string scene;
    std::vector<Explanation> rows;
    std::map<std::string, std::string> withoutAnswer; // variants that do not apply, and why
    std::map<std::string, std::string> errors;        // variants that could not be explained, and why
};

struct CausesResult {
    std::vector<SceneCauses> scenes;
    ExitCode code = ExitCode::Pass; // of the first row that could not be explained
};

/// Explains every row, and draws <out>/<scene>/<row>.png of each that is wrong. Must be called without a GL context. Throws
/// BadInput for unknown scenes and techniques, where none applies, and where no object of a scene has the levels that
/// `casterLevel` asks for.
CausesResult explainAll(const CausesOptions& options);

/// What casts at `frame` with every object that has levels at its `level`-th, or its coarsest: those of the scene, and
/// below the last a quarter of the triangles each (studies/recommend/caster_groups.h).
std::vector<Batch> castersAtLevel(const Scene& scene, int frame, int level);

/// "undersampled 62, bias too large 30, the method 8": in % of the error, the three largest first, and
/// what others have together.
std::string sharesText(const Explanation& explanation);

/// A table a scene, as plain text or Markdown with links to the pictures, and a legend of their colours.
std::string text(const CausesResult& result);
std::string page(const CausesResult& result);

/// A list of one object a scene: "scene" and "rows", each with "variant", "metric", "error", "causes" in the metric's unit,
/// which add up to it (a cause without an experiment is not there), and "change", what to change first.
std::string json(const CausesResult& result);

/// Where the picture of a row lies in the folder of all.
std::filesystem::path pictureOf(const Explanation& explanation);

} // namespace shadowbench::causes
