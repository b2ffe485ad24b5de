// An image file of another renderer, read and checked for what can be said without the scene.
#pragma once

#include "base/image.h"
#include "harness/foreign/foreign_row.h"

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace shadowbench::foreign {

/// Linear numbers of one file, row 0 at the top.
struct ForeignImage {
    std::filesystem::path file;
    std::vector<Image<float>> channels; // one; or red, green and blue
    Image<float> alpha;                 // empty: there is none
    float step = 0;                     // between two values of an integer file, as stored; 0: floats
};

/// How a file is to be read.
struct Reading {
    glm::ivec2 size; // that it must have
    Encoding encoding = Encoding::OfFormat;
    std::string channel{}; // "": the only one, or red, green and blue
};

/// Reads an EXR, PNG or PFM file. `warnings` gets a line for a PNG with a palette. Throws BadInput, a line with the file's
/// name and the remedy: not there, damaged, of another format or size, a window of a larger image, 8 or 16 bit of no stated
/// encoding, channels among which none is meant, a number that is not finite.
ForeignImage readForeign(const std::filesystem::path& file, const Reading& reading, std::vector<std::string>& warnings);

/// As numbers without any encoding, finite or not: depths and hit masks. Of several channels the one that is called Z.
Image<float> readNumbers(const std::filesystem::path& file, glm::ivec2 size);

/// What an image of the size `given` is to one of the size `wanted`, such as "half the size", or "".
std::string sizeInWords(glm::ivec2 given, glm::ivec2 wanted);

} // namespace shadowbench::foreign
