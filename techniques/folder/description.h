// A technique that is a folder of GLSL and a technique.toml (docs/technique-folders.md): what the folder says.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/shared/maps/cascade_rule.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace shadowbench::techniques {

/// What the map of a technique sees of the scene.
enum class FolderView {
    Scene,   // all of it
    Focused, // what the camera sees of it (shared/light_views/focused_view.h)
    Lispsm,  // the same, warped (shared/light_views/lispsm_view.h)
    Sample,  // all of it, from another point of an area light each frame
    Cube,    // all of it through the six sides of a cube, each in a tile of the map
    Cascades // slices of what the camera sees, each in a tile of the map (shared/maps/cascade_fit.h)
};

/// A number, or the name of the parameter that has it.
using Amount = std::variant<double, std::string>;

/// Parameters of a depth map of ours (shared/maps/depth_map.h), which the folder has after its own.
enum class MapParameters {
    None,
    DepthBias, // `map`, `bias`, `factor` and `units`
    AnyBias    // the same, and the bias may be an offset of receivers along their normals
};

/// A word, or the name of the parameter that has it.
struct FolderWord {
    std::string text;
    bool ofParameter = false;
};

/// Of `FolderView::Cascades`.
struct FolderCascades {
    Amount count = 4.0, lambda = 1.0, blend = 0.0, latency = 0.0;
    FolderWord fit{"visible"}, warp{"none"}, stable{"none"};
};

/// That a parameter of words has this one.
struct FolderCondition {
    std::string parameter, word;
    friend bool operator==(const FolderCondition&, const FolderCondition&) = default;
};

/// Points that shaders sample with.
enum class PatternKind {
    PoissonDisk,  // of the unit disk, well apart
    PoissonLight, // the same of the light's own shape: of the unit disk, or of [−1, 1]²
    Grid,         // cell centres of [−1, 1]²
    Gaussian,     // pairs of taps
    Jitter        // a table (shared/filters/jitter_table.h)
};

struct FolderPattern {
    std::string name;
    PatternKind kind;
    Amount sigma = 0.0; // of a Gaussian, in steps
    Amount taps = 0.0;  // of a table; `sectors` of them are of a ring
    int sectors = 1;
};

struct FolderTarget {
    std::string name;
    gl::Format format;       // where a parameter says it, that of its default
    std::string chosen = {}; // the parameter that says it, if one does
    bool ofImage = true;     // as large as the image; else a square of `side` texels
    Amount side = 0.0;       // of several views: they share as many texels
    bool linear = false, compare = false, mipmaps = false;
    std::optional<FolderCondition> linearWhen = {}; // else not linear
    bool history = false;                           // its texels of the frame before can be read
};

/// What is drawn with what is there already.
enum class Blend { Add, Min, Max, Multiply };

/// Which triangles of casters are left out.
enum class Cull { None, Front, Back };

/// When a pass draws a pixel, by the stencil that is there.
enum class StencilTest { Always, Equal, NotEqual };

/// What becomes of it; whole numbers of 8 bits wrap around.
enum class StencilOperation { Keep, Replace, Increment, Decrement, Invert };

/// Of a pass with a target of depths and stencil.
struct FolderStencil {
    StencilTest test = StencilTest::Always;
    int reference = 0; // that is tested against, and replaces
    StencilOperation pass = StencilOperation::Keep, depthFail = StencilOperation::Keep, fail = StencilOperation::Keep;
};

/// What a pass runs.
enum class PassKind {
    Casters, // draws them into the map
    Screen,  // draws one triangle over the screen
    Compute
};

/// Work groups of a compute pass along one axis: as many, or a target whose texels along the axis these are.
using GroupCount = std::variant<int, std::string>;

/// Of the parameters of a depth map.
enum class MapBias {
    Own,
    Parameters,
    Slope // alone: the constant part is added where depths are made linear (shared/maps/linearised_map.h)
};

struct FolderPass {
    std::string name;
    PassKind kind = PassKind::Screen;
    std::string shader;          // file of the folder, or an embedded one; empty: depth alone
    std::vector<std::string> to; // targets, one of depth at most, or `visibility` alone
    gl::Defines defines;
    Amount slopeOffset = 0.0, unitOffset = 0.0; // of casters (shared/maps/depth_map.h, Bias)
    MapBias bias = MapBias::Own;                // whether they are those, or of the parameters of a depth map
    std::optional<glm::vec4> clear;             // of colours, before anything is drawn; of casters always
    std::optional<Blend> blend;
    Cull cull = Cull::None;
    bool depthTest = true;
    std::optional<FolderStencil> stencil = {};
    bool peels = false;                       // only casters behind the target of depths, which stays as it is
    std::optional<FolderCondition> when = {}; // else it is left out
    bool once = false;                        // drawn where light or casters have changed alone; else in each frame
    Amount repeat = 1.0;                      // how often; said by the first pass of a group
    std::vector<GroupCount> groups = {};      // of Compute, three; empty: each texel of the first target has an invocation
    std::string group;                        // passes in a row with this name are repeated in turns; "": alone
};

struct TechniqueFolder {
    std::filesystem::path path;
    Entry entry; // all but `make`
    FolderView view = FolderView::Scene;
    FolderCascades cascades;
    MapParameters mapParameters = MapParameters::None;
    std::vector<FolderPattern> patterns;
    std::vector<FolderTarget> targets;
    std::vector<FolderPass> passes;
    gl::ShaderFiles shaders;
    std::map<std::string, std::string> places; // file and line of "parameter.NAME" and "target.NAME" in technique.toml
};

/// Of a target as a row has it.
gl::Format formatOf(const FolderTarget& target, const Parameters& values);

/// Whether it is one of depths, with a stencil or without.
constexpr bool isDepth(gl::Format format) {
    return format == gl::Format::Depth32F || format == gl::Format::Depth32FStencil8;
}

/// Texels per side of a target that is no image.
inline constexpr int mostTexelsOfSide = 8192;

/// Work groups of a pass: an invocation each for the texels of the largest target.
inline constexpr std::int64_t mostGroups = std::int64_t{mostTexelsOfSide} * mostTexelsOfSide;

/// What a pass writes that is the technique's answer.
inline constexpr const char* visibilityTarget = "visibility";

/// Of samplers that have the texels of the frame before.
inline constexpr std::string_view historyPrefix = "previous_";

/// The rows of folders are `my:ID`.
inline constexpr std::string_view folderPrefix = "my:";

/// What it is with these parameters.
double valueOf(const Amount& amount, const Parameters& values);

/// Whether it holds with these parameters; where there is no condition, it does.
bool holds(const std::optional<FolderCondition>& condition, const Parameters& values);

/// Whether only passes write the target that are left out with these parameters.
bool isLeftOut(const TechniqueFolder& folder, const FolderTarget& target, const Parameters& values);

/// What the map sees with these parameters: cascades of no slice are the scene.
FolderView viewOf(const TechniqueFolder& folder, const Parameters& values);

/// How the cascades are fitted with these parameters.
CascadeRule cascadeRule(const FolderCascades& cascades, const Parameters& values);

/// What shaders call a parameter: its name in capitals; a choice is one of `name_word`. What is no letter or digit is _.
std::string macroOf(std::string name);

/// Lower-case letters, digits and -, 40 at most.
bool isFolderId(std::string_view id);

/// Throws BadInput with the file, the line and the key of what is wrong, or the file that is missing.
TechniqueFolder readTechniqueFolder(const std::filesystem::path& folder);

/// The same of texts: of technique.toml, and of the shaders that lie beside it in `folder`.
TechniqueFolder parseTechniqueFolder(const std::string& toml, const std::filesystem::path& folder, gl::ShaderFiles shaders);

} // namespace shadowbench::techniques
