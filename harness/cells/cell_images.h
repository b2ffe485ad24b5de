// The pictures of one cell: visibility, reference and error, as EXR and PNG, and the scene with these shadows.
#pragma once

#include "harness/cells/cell.h"
#include "harness/cells/shading.h"

#include <filesystem>

namespace shadowbench {

/// Error as a picture: grey where right, red where the technique is too dark (false shadow), blue where too bright (leak),
/// dark background outside the receivers.
Image<glm::vec3> errorPicture(const Image<float>& v, const groundtruth::Reference& truth);

/// Writes <folder>/{visibility,reference,error}.{exr,png} of the scored frame, shaded as {visibility,reference}-shaded.png,
/// and, where others move after it, all of them as frame-<index>.exr, which `score` reads.
void writeCellImages(const std::filesystem::path& folder, const CellImages& images, const PictureShading& shading);

/// A variant's name as a file name: "pcss:taps=32+32" → "pcss_taps=32+32".
std::string fileName(const std::string& variant);

} // namespace shadowbench
