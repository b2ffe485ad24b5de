// What each shader of a frame costs on graphics processors that are not there, by AMD's compiler in Mesa: static figures, of
// which docs/gpu-cost.md says what they are worth.
#pragma once

#include "base/error.h"
#include "gpu/executed.h"
#include "gpu/observer.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench::shaders {

/// What the draws of a pipeline write; of a dispatch only `extents`.
struct Output {
    std::vector<std::string> colours = {}; // formats
    bool blends = false;
    std::string depth = {}; // format; "" where there is none
    bool writesDepth = false;
    gpu::Extents extents = {}; // as of gpu::Use
};

/// Of the image on which dispatches are counted again, to each side that of the scene's: what they do may grow with the
/// pixels.
inline constexpr int largerBy = 4;

/// A dispatch on that image.
struct Larger {
    gpu::Extents extents;
    gpu::Executed executed;
};

/// One shader of one pass on one architecture.
struct ShaderCost {
    std::string technique; // variant; "" of a file of the user's
    std::string scene;     // "" of such a file
    std::string frame; // hash of what the steady frame shows: counts of two programs are of one frame where it is the same
    std::string pass;  // "" of such a file, and of what is drawn between passes
    gpu::Stage stage;
    std::string source;      // file of the shader
    int number = 1;          // 2 and more: others of the same technique, pass, stage and source, in order
    std::uint64_t draws = 0; // and dispatches, of the steady frame; 0: of others only
    std::string architecture;
    std::vector<std::pair<std::string, std::uint64_t>> statistics; // as gpu::StageFigures
    std::optional<gpu::Executed> executed = {};                    // of the steady frame's fragment and compute shaders
    std::size_t marks = 0;             // of its text, which what is executed was counted by; 0 where nothing is counted
    std::optional<Larger> larger = {}; // of its dispatches
    Output output = {};                // empty of a file of the user's, and in older lines

    /// What is the same of one shader in two programs.
    [[nodiscard]] std::string name() const;

    /// The same without its technique: "resolve fragment soft/pcss/pcss.frag".
    [[nodiscard]] std::string place() const;

    /// 0 where the compiler does not give it.
    [[nodiscard]] std::uint64_t of(const std::string& statistic) const;
};

/// What a pass of the steady frame clears, copies or reads back.
struct FrameMove {
    std::string technique, scene, pass;
    gpu::MoveKind kind;
    std::string format = {}; // "" of what is read back
    gpu::Extents extents = {};
};

struct ShaderCosts {
    std::string compiler; // with its version
    std::vector<ShaderCost> shaders;
    std::vector<FrameMove> moves = {}; // none in older lines
};

/// The frame whose shaders are counted: the standing one; the first, with what is done once; or the same after light and
/// casters were elsewhere (harness/render/motion.h).
enum class CountedFrame { Standing, First, InMotion };

struct ShaderCostOptions {
    std::vector<std::string> files;              // shaders; empty: those of the catalogue
    std::vector<std::string> techniques;         // variants or globs; empty: all
    std::string scene;                           // id or file; empty: for each variant the first that it applies to
    std::vector<std::string> architectures;      // empty: all
    CountedFrame frame = CountedFrame::Standing; // of levels of detail always that
    std::filesystem::path cache;                 // empty: as of references
    bool quiet = false;
};

struct ShaderCostResult {
    ShaderCosts costs;
    ExitCode code = ExitCode::Pass;
    std::vector<std::string> errors;                  // a sentence for each variant or program that has no figures
    std::map<std::string, std::string> notApplicable; // variant → why it has none on the scene that was asked for
};

/// All shaders that are asked for, in the order of the catalogue or of the files, architecture by architecture. Throws
/// Inconclusive, saying what to install, without the driver, and BadInput for what is not there.
ShaderCostResult shaderCosts(const ShaderCostOptions& options);

/// Nothing that the program writes depends on the machine or the time: a line of JSON for each shader and move.
std::string toLines(const ShaderCosts& costs);

/// Throws BadInput naming file and line.
ShaderCosts readLines(const std::filesystem::path& file);

/// For a terminal: a row a shader; figures of several architectures are separated by strokes.
std::string table(const ShaderCosts& costs);

/// What changed, as Mesa's shader-db reports it: totals, then each changed shader.
std::string changes(const ShaderCosts& before, const ShaderCosts& after);

} // namespace shadowbench::shaders
