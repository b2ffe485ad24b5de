// The contract of a level-of-detail technique: it draws instances, each with a chain of levels, and answers with colour.
// Which level an instance shows is decided once, by the harness, so that all techniques draw the same selection.
#pragma once

#include "scene/mesh.h"
#include "techniques/contract/pass.h"
#include "techniques/gl/texture.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

class LevelDrawer;

/// One representation of an object: one flat colour, linear, in [0, 1].
struct LodLevel {
    std::shared_ptr<const Mesh> mesh;
    glm::vec3 colour;
};

/// All representations of an object, finest first, never empty.
using LodChain = std::vector<LodLevel>;

/// What an instance shows: one level, or two, on its way from `level` to the next coarser one (a t-instance, dissertation
/// 5.1.2).
struct LodSelection {
    int level = 0;
    double progress = 0; // of the transition to level + 1, in [0, 1); 0: not in transition

    [[nodiscard]] bool inTransition() const { return progress > 0; }
    friend bool operator==(const LodSelection&, const LodSelection&) = default;
};

struct LodInstance {
    std::uint32_t id = 0; // from 1, below 65,536, stable over frames
    std::size_t chain = 0;
    glm::dmat4 world{1};    // affine, world from object
    glm::dmat4 previous{1}; // the same one frame earlier
    LodSelection selection;
};

/// Everything a technique may know of one frame. Colours are lit by one light without shadow (lod/shading.glsl).
struct LodFrame {
    std::span<const LodChain> chains;
    std::span<const LodInstance> instances; // those that the camera may see, by ascending id
    LevelDrawer& drawer;
    glm::dvec4 light; // homogeneous position of the hard light
    glm::ivec2 size;  // of the image, in pixels
    glm::dmat4 view, previousView;
    glm::dmat4 projection, previousProjection;
    PassListener* passes = nullptr; // learns of the frame's passes; null: nobody does

    /// Begins a pass, which ends with what is returned: `const auto pass = frame.pass("opaque levels");`.
    [[nodiscard]] Pass pass(std::string_view name) const { return {name, passes}; }
    [[nodiscard]] glm::dmat4 clipFromWorld() const { return projection * view; }
    [[nodiscard]] glm::dmat4 previousClipFromWorld() const { return previousProjection * previousView; }
};

/// Where a technique draws; the same textures from frame to frame.
struct LodPicture {
    const gl::Texture& colour; // RGBA8
    const gl::Texture& depth;  // Depth32F; techniques may draw into targets of their own over it
    const gl::RenderTarget& target;
};

/// The colour of pixels that no instance covers.
inline constexpr glm::vec4 lodBackground{0.55F, 0.65F, 0.75F, 1};

class LodTechnique {
public:
    virtual ~LodTechnique() = default;

    /// Writes the colour of every pixel of the picture.
    virtual void render(const LodFrame& frame, const LodPicture& picture) = 0;

    /// Forgets all history: the next frame is the first.
    virtual void reset() {}
};

} // namespace shadowbench::techniques
