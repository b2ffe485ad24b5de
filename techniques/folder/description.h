// A technique that is a folder of GLSL and a technique.toml (docs/technique-folders.md): what the folder says.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"

#include <filesystem>
#include <glm/vec4.hpp>
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
    Sample   // all of it, from another point of an area light each frame
};

/// A number, or the name of the parameter that has it.
using Amount = std::variant<double, std::string>;

/// Parameters of a depth map of ours (shared/maps/depth_map.h), which the folder has after its own.
enum class MapParameters {
    None,
    DepthBias, // `map`, `bias`, `factor` and `units`
    AnyBias    // the same, and the bias may be an offset of receivers along their normals
};

struct FolderTarget {
    std::string name;
    gl::Format format;
    bool ofImage = true; // as large as the image; else a square of `side` texels
    Amount side = 0.0;
    bool linear = false, compare = false, mipmaps = false;
    bool history = false; // its texels of the frame before can be read
};

/// What is drawn with what is there already.
enum class Blend { Add, Min, Max, Multiply };

/// Which triangles of casters are left out.
enum class Cull { None, Front, Back };

struct FolderPass {
    std::string name;
    bool casters = false;        // draws them into the map; else one triangle over the screen
    std::string fragment;        // file of the folder, or an embedded one; empty: depth alone
    std::vector<std::string> to; // targets, one of depth at most, or `visibility` alone
    gl::Defines defines;
    Amount slopeOffset = 0.0, unitOffset = 0.0; // of casters (shared/maps/depth_map.h, Bias)
    bool biased = false;                        // they are those of the parameters of a depth map
    std::optional<glm::vec4> clear;             // of colours, before anything is drawn; of casters always
    std::optional<Blend> blend;
    Cull cull = Cull::None;
    bool depthTest = true;
    Amount repeat = 1.0; // how often; said by the first pass of a group
    std::string group;   // passes in a row with this name are repeated in turns; "": alone
};

struct TechniqueFolder {
    std::filesystem::path path;
    Entry entry; // all but `make`
    FolderView view = FolderView::Scene;
    MapParameters mapParameters = MapParameters::None;
    std::vector<FolderTarget> targets;
    std::vector<FolderPass> passes;
    gl::ShaderFiles shaders;
};

/// Texels per side of a target that is no image.
inline constexpr int mostTexelsOfSide = 8192;

/// What a pass writes that is the technique's answer.
inline constexpr const char* visibilityTarget = "visibility";

/// Of samplers that have the texels of the frame before.
inline constexpr std::string_view historyPrefix = "previous_";

/// The rows of folders are `my:ID`.
inline constexpr std::string_view folderPrefix = "my:";

/// What shaders call a parameter: its name in capitals; a choice is one of `name_word`. What is no letter or digit is _.
std::string macroOf(std::string name);

/// Lower-case letters, digits and -, 40 at most.
bool isFolderId(std::string_view id);

/// Throws BadInput with the file, the line and the key of what is wrong, or the file that is missing.
TechniqueFolder readTechniqueFolder(const std::filesystem::path& folder);

/// The same of texts: of technique.toml, and of the shaders that lie beside it in `folder`.
TechniqueFolder parseTechniqueFolder(const std::string& toml, const std::filesystem::path& folder, gl::ShaderFiles shaders);

} // namespace shadowbench::techniques
