// What the child does that decodes an image (base/confined/image_reader.h): other people's bytes become pixels. Nothing here
// protects the process that calls it.
#pragma once

#include "base/image_io.h"

#include <string>

namespace shadowbench {

/// An EXR, PNG, PFM or other PNM in memory.
class DecodedImage {
public:
    /// Reads the header. Throws BadInput with the reason, without a file's name.
    explicit DecodedImage(std::string bytes);

    /// Of another format than those: its name and no more.
    [[nodiscard]] const ImageHeader& header() const { return header_; }

    /// Throws BadInput as above, and where there are more pixels than Limit::Pixels or no such channel.
    Image<float> channel(int index) const;

private:
    std::string bytes_;
    ImageHeader header_;
};

} // namespace shadowbench
