// Images of other people, decoded in a child that can reach nothing else (docs/threat-model.md). Our own are read by
// base/image_io.h.
#pragma once

#include "base/confined/reader.h"
#include "base/image_io.h"

#include <filesystem>
#include <string>

namespace shadowbench {

/// An EXR, PNG or PFM file: its header, and its channels as they are asked for.
class ImageReader {
public:
    /// Reads the header; of a file of another format, that is the format's name alone. Throws BadInput naming the file: not
    /// there, damaged, beyond a limit (base/limits.h), or its reader dies or hangs; so does `channel`.
    explicit ImageReader(const std::filesystem::path& file);

    [[nodiscard]] const ImageHeader& header() const { return header_; }

    /// Linear values, integers divided by their maximum, no gamma applied; finite or not. Throws BadInput for one that is
    /// not there, too.
    Image<float> channel(int index);
    Image<float> channel(const std::string& name);

private:
    std::filesystem::path file_;
    ReaderChild child_;
    ImageHeader header_;
};

/// The header of a child's answer, each of its numbers checked. Throws BadInput.
ImageHeader receivedHeader(ReaderChild& child);

} // namespace shadowbench
