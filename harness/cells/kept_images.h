// What every run keeps of its images, so that pages can show each pixel: the scored frame of a cell losslessly, its sequence
// in 8 bits, and every truth once a scene.
//   <images>/<scene>/<variant>/visibility.exr      channel V
//   <images>/<scene>/<variant>/sequence.png        V of the scored frame and of the moving ones, one below the other
//   <images>/<scene>/<variant>/flicker.png         what each of them changes beyond the truth
//   <images>/<scene>/truth-<name>.exr              channels V, sigma, surface, edge, id
//   <images>/<scene>/truth-<name>-sequence.png
//   <images>/<scene>/shading.exr                   what makes shaded pictures of visibility: channels R, G, B, direct
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"
#include "harness/cells/shading.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

struct CellImages;

/// The scored frame's truth as it was kept; `surface` and `id` are those of groundtruth::Reference as numbers.
struct KeptTruth {
    Image<float> visibility, sigma, surface, edgeDistance, id;
};

/// Where things lie.
std::filesystem::path cellFolder(const std::filesystem::path& images, const std::string& scene, const std::string& variant);
std::filesystem::path truthFile(const std::filesystem::path& images, const std::string& scene, std::string_view truth);
std::filesystem::path truthSequenceFile(const std::filesystem::path& images, const std::string& scene,
                                        std::string_view truth);
std::filesystem::path shadingFile(const std::filesystem::path& images, const std::string& scene);

/// Whether a scene's or variant's name is one that lies in a folder of its own: records of strangers may hold any text.
bool isFolderName(const std::string& name);

/// Names of the truths that are kept of a scene, sorted: "hard", "pixel-area", "soft" …
std::vector<std::string> keptTruths(const std::filesystem::path& images, const std::string& scene);

void keepCell(const std::filesystem::path& folder, const CellImages& images);
void keepTruth(const std::filesystem::path& file, const groundtruth::Reference& truth);
void keepSequence(const std::filesystem::path& file, const std::vector<Image<float>>& frames);
void keepShading(const std::filesystem::path& file, const PictureShading& shading);

/// Throws BadInput for a file that cannot be read or lacks a channel.
KeptTruth readTruth(const std::filesystem::path& file);

/// Nothing where there is none: a run of an older program has kept none. Throws BadInput as above.
std::optional<PictureShading> readShading(const std::filesystem::path& file);

} // namespace shadowbench
