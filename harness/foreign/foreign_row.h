// What is known of another renderer's images, before they are read: docs/score.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench::foreign {

/// What the numbers of an image say of a receiver (docs/score.md, "What the numbers mean").
enum class Definition {
    Hard,       // lit or not, from the light's centre; between 0 and 1 where edges are smoothed
    Area,       // the visible share of an area light
    Irradiance, // the share of the irradiance that arrives: of a Lambertian light, or of an environment
    SolidAngle, // the visible share of the light's solid angle
};
inline constexpr Definition allDefinitions[] = {Definition::Hard, Definition::Area, Definition::Irradiance,
                                                Definition::SolidAngle};
std::string_view name(Definition definition);      // "hard", "area", "irradiance", "solid-angle"
Definition definitionNamed(std::string_view word); // throws BadInput naming all

/// How files keep numbers.
enum class Encoding {
    OfFormat, // floats are linear; 8 and 16 bit say nothing of themselves, and must be said to be one or the other
    Linear,
    Srgb, // IEC 61966-2-1, as pictures for screens are kept
};

/// One frame's files.
struct FrameFiles {
    int frame = 0;               // of the scene's timeline
    std::filesystem::path image; // visibility; with `lit` the picture with shadows
    /// The same picture without shadows, and without that light at all (none: black). Visibility is then
    /// (image − unlit) / (lit − unlit), summed over the channels.
    std::optional<std::filesystem::path> lit{}, unlit{};
    /// What the renderer saw at each pixel: > ½ where it hit something, or how far it was.
    std::optional<std::filesystem::path> hits{}, depth{};
};

/// What a depth image holds, in metres. Nothing was hit where it is 0, infinite or at least a billion.
enum class Depth {
    AlongView, // the distance along the viewing direction: Blender's Z, −z in the eye's coordinates
    FromEye,   // the distance from the eye
};

/// A row of the tables: images of one scene by one renderer with one setting.
struct ForeignRow {
    std::string id; // lower-case letters, digits, ".", "_", "-": the record's technique is external:<id>
    Definition definition = Definition::Hard;
    Encoding encoding = Encoding::OfFormat;
    std::vector<FrameFiles> frames; // the last still one, or it and all moving ones, in their order
    std::string channel{};          // of the images; "": the only one, or the grey of R, G and B
    Depth depth = Depth::AlongView;
    bool remembers = false;     // the renderer keeps a history: ghosts are looked for
    bool leaveOutEdges = false; // scores nothing where geometry has edges
    bool force = false;         // scores what looks flipped, shifted or wrongly encoded: warns, and refuses nothing
    std::string renderer{};     // what drew them, with its version and device, for the record's environment
    std::vector<std::pair<std::string, std::string>> parameters{}; // its settings, for the record
};

} // namespace shadowbench::foreign
