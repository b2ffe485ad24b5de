// A technique that counts volumes against the G-buffer's own depth, with no parameter of its own.
#pragma once

#include "techniques/volumes/stencil_volumes.h"

namespace shadowbench::techniques {

class CountedVolumes final : public Technique {
public:
    explicit CountedVolumes(VolumeTest test) : volumes_(test) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        volumes_.render(frame, frame.hardLight.homogeneous(), frame.gbuffer.depthStencil(), visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        return volumes_.figures(frame.gbuffer.depthStencil());
    }

private:
    StencilVolumes volumes_;
};

} // namespace shadowbench::techniques
