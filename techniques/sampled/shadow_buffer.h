// The shadow buffer of soft shadows that are sampled over time (Scherzer 4.1.2): what each frame's sample of the light adds
// to what the frames before have left, reprojected from frame to frame. Its shader side is sampled/shadow_buffer.glsl.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"
#include "techniques/gl/gbuffer.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// `depth-test`, `epsilon` and `overscan`.
std::vector<Parameter> shadowBufferParameters();

/// What ShadowBuffer::figures reports.
std::vector<Figure> shadowBufferFigures();

/// What sampled/shadow_buffer.glsl has to be compiled with.
gl::Defines shadowBufferDefines(const Parameters& parameters);

/// The view of the frame's own Halton point of the light.
LightView lightSampleView(const Frame& frame);

/// RGBA16F, double-buffered, with overscan.
class ShadowBuffer {
public:
    /// `parameters` hold shadowBufferParameters.
    explicit ShadowBuffer(const Parameters& parameters);

    void reset() { images_.reset(); }

    /// Draws what the overscan adds to the frame's G-buffer, as a pass "overscan G-buffer".
    void begin(const Frame& frame);

    /// Runs `resolve`, a program over sampled/shadow_buffer.glsl with its own uniforms set, on every pixel of the buffer (a
    /// pass "temporal resolve"), and copies what it shows of the image into `visibility` (a pass "crop").
    void update(const Frame& frame, gl::Program& resolve, const gl::Texture& visibility);

    /// Of the frame that was updated last; a pixel that it began anew counts for `firstSamples`.
    [[nodiscard]] std::map<std::string, double> figures(int firstSamples) const;

private:
    struct Images {
        Images(glm::ivec2 size, glm::ivec2 border);
        glm::ivec2 inner; // size of the image
        bool fresh = true;
        gl::GBuffer overscan; // its border alone is drawn, where the stencil is 0: the frame has the rest
        gl::Texture read, write, shown;
    };

    void setReprojection(const Frame& frame, gl::Program& resolve) const;
    void drawInner(const Frame& frame, gl::Program& resolve) const;
    void drawOverscan(gl::Program& resolve) const;
    void crop(const Frame& frame, const gl::Texture& visibility) const;

    float epsilon_;
    double overscan_;
    std::optional<Images> images_;
};

} // namespace shadowbench::techniques
