// What the child does that decodes an image (base/confined/image_reader.h): other people's bytes become pixels, through
// OpenImageIO. Nothing here protects the process that calls it. It brings OpenImageIO.
#pragma once

#include "base/image_input.h"

#include <OpenImageIO/filesystem.h>
#include <memory>
#include <string>

namespace shadowbench {

/// An EXR, PNG, PFM or other PNM in memory. The format is chosen by the first bytes, and no other library is asked.
class DecodedImage {
public:
    /// Reads the header. Throws BadInput with the reason, without a file's name.
    explicit DecodedImage(std::string bytes);

    /// Of another format than those: its name and no more.
    [[nodiscard]] const ImageHeader& header() const { return header_; }

    /// Throws BadInput as above, and where there are more pixels than Limit::Pixels or no such channel.
    Image<float> channel(int index);

private:
    void open();

    std::string bytes_;
    OIIO::Filesystem::IOMemReader memory_; // must outlive what reads it
    std::unique_ptr<OIIO::ImageInput> input_;
    ImageHeader header_;
    bool isRead_ = false; // since it was opened
};

} // namespace shadowbench
