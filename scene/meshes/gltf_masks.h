// The alpha tests of a glTF file's materials, in the child that reads meshes.
#pragma once

#include "scene/meshes/alpha_mask.h"
#include "scene/meshes/gltf_buffers.h"

#include <map>
#include <memory>
#include <optional>

namespace shadowbench {

struct GltfMask {
    std::shared_ptr<const AlphaMask> mask;
    std::string coordinates; // attribute with the places in it; empty where all of it has one alpha
};

/// Members throw as GltfBuffers' do.
class GltfMasks {
public:
    /// `texels`: per side of a mask at most, as a level of a mipmap has; 0: as its texture has.
    GltfMasks(GltfBuffers& buffers, int texels) : buffers_(buffers), texels_(texels) {}

    /// Of the primitive's material; nothing unless its alphaMode is MASK. An alpha of vertices is not read.
    const std::optional<GltfMask>& of(const GltfJson& primitive);

private:
    GltfMask read(const GltfJson& material);
    /// Returns the attribute with the places in it.
    std::string readTexture(const GltfJson& use, AlphaMask& mask);

    GltfBuffers& buffers_;
    int texels_;
    std::map<std::size_t, std::optional<GltfMask>> known_; // by material
};

} // namespace shadowbench
