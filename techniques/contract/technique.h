// The contract of a shadow technique: what it is given and what it must return (how it is described: entry.h).
// Level-of-detail techniques are in the same catalogue but have a contract of their own.
#pragma once

#include "scene/snapshot.h"
#include "techniques/contract/pass.h"
#include "techniques/gl/gbuffer.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace shadowbench::techniques {

/// Everything a technique may know of one frame. The G-buffer has already been drawn.
struct Frame {
    const Snapshot& snapshot;
    const Light& hardLight; // the snapshot's as a hard-shadow technique sees it: an area light's centre alone
    const gl::SceneBuffers& scene;
    const gl::GBuffer& gbuffer;
    glm::ivec2 size;                  // of the image, in pixels
    glm::dmat4 clipFromWorld;         // camera: projection · view
    glm::dmat4 previousClipFromWorld; // the same one frame earlier
    int index;                        // frame number from 0
    std::uint32_t seed;               // of pseudo-random choices; 1 is the default
    PassListener* passes = nullptr;   // learns of the frame's passes; null: nobody does

    [[nodiscard]] double aspect() const { return static_cast<double>(size.x) / size.y; }
    [[nodiscard]] bool cameraMoved() const { return clipFromWorld != previousClipFromWorld; }

    /// Begins a pass, which ends with what is returned: `const auto pass = frame.pass("blur");`.
    [[nodiscard]] Pass pass(std::string_view name) const { return {name, passes}; }
};

class Technique {
public:
    virtual ~Technique() = default;

    /// Writes the visible fraction of the light at every pixel (R32F in [0, 1], 1 = lit) into `visibility`. Background and
    /// surfaces that face away from the light are masked by the harness: any value will do there.
    virtual void render(const Frame& frame, const gl::Texture& visibility) = 0;

    /// Forgets all history and whatever else is kept from frame to frame for a light or for casters: the next frame is the
    /// first and does its work, with programs compiled before and what depends on meshes alone.
    virtual void reset() {}

    /// Numbers of `frame`, the one that was rendered last, that only the technique knows, by names that its entry declares.
    /// The work of counting them belongs here, where it is not timed.
    [[nodiscard]] virtual std::map<std::string, double> figures([[maybe_unused]] const Frame& frame) const { return {}; }

    /// Where `world` lies in the map that it was tested against in the frame rendered last: in texels, continuous within a
    /// map; how several maps lie to each other does not matter, nor does a normal offset, which moves a plane's points
    /// alike. Nothing where no map holds the point (beside it, behind the light) and from techniques without a map. The
    /// shader computes the same point on its own: a test compares the two (tests/techniques/gl/map_point_test.cpp).
    [[nodiscard]] virtual std::optional<glm::dvec2> mapPoint([[maybe_unused]] const glm::dvec3& world) const { return {}; }
};

} // namespace shadowbench::techniques
