// Frame-sequential interpolation of levels (Scherzer and Wimmer 2008, dissertation chapter 5, listings 5.1 and 6.3): an
// instance in transition is drawn at one of its two levels a frame, stippled in object space by a visibility texture; the
// buffers of this frame and the last one are combined on the screen.
// Departures: depth is stored in metres along the view direction, since a 16-bit float of window depth has steps of a
// hand's breadth already at 10 m, and compared as the older camera saw it; ids are 16-bit integers, which are exact where a
// 16-bit float ends at 2,048; the texel of the older buffer is read without filter; an instance that enters its transition
// shows its wholly visible level first (alternation.h); the first frame fills both buffers.
#include "techniques/contract/entry.h"
#include "techniques/contract/lod_technique.h"
#include "techniques/gl/api.h"
#include "techniques/gl/program.h"
#include "techniques/lod/lod-frame-sequential/alternation.h"
#include "techniques/lod/lod-frame-sequential/visibility_texture.h"

#include <glm/matrix.hpp>
#include <optional>

namespace shadowbench::techniques {
namespace {

constexpr unsigned farthestDepth = 0x7BFF; // bits of the largest 16-bit float: what the background is at

enum class Reproject { Off, Camera, Motion };

Reproject reprojectNamed(const std::string& word) {
    if (word == "off") return Reproject::Off;
    return word == "camera" ? Reproject::Camera : Reproject::Motion;
}

gl::Texture uploaded(const Image<std::uint8_t>& texels) {
    gl::Texture texture(gl::Format::R8, {texels.width(), texels.height()});
    texture.upload(texels);
    return texture;
}

/// Colour, and depth with instance id; depth-tested against the picture's own depth.
struct LodBuffer {
    gl::Texture colour, data;
    gl::RenderTarget target;

    LodBuffer(glm::ivec2 size, const gl::Texture& depth)
        : colour(gl::Format::RGBA8, size), data(gl::Format::R32UI, size), target{&colour, &data, &depth} {}

    void clear() const {
        target.clearColour(0, lodBackground);
        target.clearColour(1, farthestDepth);
        target.clearDepth(1);
    }
};

class FrameSequential final : public LodTechnique {
public:
    explicit FrameSequential(const Parameters& parameters)
        : reproject_(reprojectNamed(parameters.text("reproject"))),
          visibility_(uploaded(visibilityTexture(parameters.text("vis")))),
          still_("lod/instance.vert", "lod/lod-frame-sequential/lod_buffer.frag"),
          stippled_("lod/instance.vert", "lod/lod-frame-sequential/lod_buffer.frag", {{"TRANSITION", "1"}}),
          combine_(gl::Program::screen("lod/lod-frame-sequential/combine.frag",
                                       {{"REPROJECT", std::to_string(static_cast<int>(reproject_))}})) {}

    void render(const LodFrame& frame, const LodPicture& picture) override {
        const bool first = !newer_;
        if (first) {
            newer_.emplace(frame.size, picture.depth);
            older_.emplace(frame.size, picture.depth);
            draw(frame, *newer_);
        }
        std::swap(newer_, older_);
        draw(frame, *newer_);
        combine(frame, picture, first);
    }

    void reset() override {
        newer_.reset();
        older_.reset();
        alternation_.reset();
    }

private:
    void draw(const LodFrame& frame, const LodBuffer& buffer) {
        const auto pass = frame.pass("LOD buffer");
        std::vector<LevelDraw> still, inTransition;
        for (const LevelDraw& draw : alternation_.next(frame.instances))
            (draw.id == 0 ? still : inTransition).push_back(draw);
        buffer.clear();
        buffer.target.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        drawWith(still_, frame, still);
        if (inTransition.empty()) return;
        stippled_.set("visibilityTexture", visibility_);
        drawWith(stippled_, frame, inTransition);
    }

    static void drawWith(gl::Program& program, const LodFrame& frame, const std::vector<LevelDraw>& draws) {
        program.set("clipFromWorld", glm::mat4(frame.clipFromWorld())).set("light", glm::vec4(frame.light));
        program.use();
        frame.drawer.draw(frame.chains, draws);
    }

    /// `first`: both buffers are of this very frame.
    void combine(const LodFrame& frame, const LodPicture& picture, bool first) {
        const auto pass = frame.pass("combination");
        combine_.set("newColour", newer_->colour)
            .set("newData", newer_->data)
            .set("oldColour", older_->colour)
            .set("oldData", older_->data);
        if (reproject_ != Reproject::Off) {
            const glm::dmat4 oldClip = first ? frame.clipFromWorld() : frame.previousClipFromWorld();
            const glm::dmat4 worldFromNew = glm::inverse(frame.clipFromWorld());
            combine_.set("oldFromNew", glm::mat4(oldClip * worldFromNew))
                .set("clipDepth", glm::vec2(-frame.projection[2][2], frame.projection[3][2]));
            if (reproject_ == Reproject::Motion) setMotions(frame, oldClip, worldFromNew, first);
        }
        picture.target.bind();
        combine_.drawScreen();
    }

    void setMotions(const LodFrame& frame, const glm::dmat4& oldClip, const glm::dmat4& worldFromNew, bool first) {
        std::vector<glm::mat4> motions;
        for (const LodInstance& instance : frame.instances) {
            if (first || !instance.selection.inTransition() || instance.world == instance.previous) continue;
            motions.resize(instance.id + 1, glm::mat4(oldClip * worldFromNew));
            motions.back() = glm::mat4(oldClip * instance.previous * glm::inverse(instance.world) * worldFromNew);
        }
        motions_.upload(motions.data(), motions.size() * sizeof(glm::mat4));
        motions_.bindStorage(0);
        combine_.set("motions", static_cast<int>(motions.size()));
    }

    Reproject reproject_;
    gl::Texture visibility_;
    gl::Program still_, stippled_, combine_;
    gl::Buffer motions_;
    Alternation alternation_;
    std::optional<LodBuffer> newer_, older_;
};

} // namespace

Entry lodFrameSequential() {
    return {.id = "lod-frame-sequential",
            .title = "Frame-sequential interpolation of levels",
            .source = {Document::Dissertation, "chapter 5, listings 5.1 and 6.3"},
            .answer = Answer::Colour,
            .temporal = true,
            .parameters = {{"vis", "noise", OneOf{{"noise", "checker", "centre-out"}},
                            "visibility texture: the order in which fragments appear", "5.1.3"},
                           {"reproject", "camera", OneOf{{"off", "camera", "motion"}},
                            "what the older buffer is back-projected for; motion: of camera and instances", "eq. 5.2"}},
            .variants = {"", "vis=checker", "vis=centre-out", "reproject=off"},
            .makeLod = [](const Parameters& p) { return std::make_unique<FrameSequential>(p); }};
}

} // namespace shadowbench::techniques
