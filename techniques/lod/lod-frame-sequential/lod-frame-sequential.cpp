// Frame-sequential interpolation of levels (Scherzer and Wimmer 2008, dissertation chapter 5, listings 5.1 and 6.3): an
// instance in transition is drawn at one of its two levels a frame, stippled in object space by a visibility texture; the
// buffers of this frame and the last one are combined on the screen.
// Departures: ids are integers of eight bits in colour's alpha, and depth is the depth buffer's, of 32 bits, as the older
// camera saw it; the dissertation keeps both, as 16-bit floats, in a second target (listing 5.1), where ids are exact up to
// 2,048 and steps of depth a hand's breadth wide at 10 m. Here ids are exact as long as 255 instances are in transition in
// two frames; its scenes of 4,000 objects have fewer in view. The screen is combined only where an instance in transition
// may be; elsewhere both fragments are of n-instances, and the newer one is kept (5.1.4, case 1). The texel of the older
// buffer is read without filter; an instance that enters its transition shows its wholly visible level first; the first
// frame fills both buffers.
#include "techniques/contract/entry.h"
#include "techniques/contract/lod_technique.h"
#include "techniques/gl/api.h"
#include "techniques/gl/context.h"
#include "techniques/gl/program.h"
#include "techniques/lod/lod-frame-sequential/alternation.h"
#include "techniques/lod/lod-frame-sequential/combined_tiles.h"
#include "techniques/lod/lod-frame-sequential/visibility_texture.h"

#include <glm/matrix.hpp>
#include <optional>

namespace shadowbench::techniques {
namespace {

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

/// Of every chain the box of all its levels.
std::vector<Bounds> boundsOf(std::span<const LodChain> chains) {
    std::vector<Bounds> result;
    for (const LodChain& chain : chains) {
        Bounds& bounds = result.emplace_back();
        for (const LodLevel& level : chain) bounds.add(level.mesh->bounds());
    }
    return result;
}

/// Colour with the instance's id in alpha, and depth.
struct LodBuffer {
    gl::Texture colour, depth;
    gl::RenderTarget target;
    std::vector<SeenBox> inTransition; // the instances that are

    explicit LodBuffer(glm::ivec2 size)
        : colour(gl::Format::RGBA8, size), depth(gl::Format::Depth32F, size), target{&colour, &depth} {}

    void clear() const {
        target.clearColour(0, glm::vec4(glm::vec3(lodBackground), 0));
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
          combine_("lod/lod-frame-sequential/combine.vert", "lod/lod-frame-sequential/combine.frag",
                   {{"REPROJECT", std::to_string(static_cast<int>(reproject_))}}) {}

    void render(const LodFrame& frame, const LodPicture& picture) override {
        const bool first = !newer_;
        if (first) {
            bounds_ = boundsOf(frame.chains);
            newer_.emplace(frame.size);
            older_.emplace(frame.size);
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
    void draw(const LodFrame& frame, LodBuffer& buffer) {
        const auto pass = frame.pass("LOD buffer");
        std::vector<LevelDraw> still;
        inTransition_.clear();
        for (const LevelDraw& draw : alternation_.next(frame.instances))
            (draw.id == 0 ? still : inTransition_).push_back(draw);
        buffer.clear();
        buffer.target.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        drawWith(still_, frame, still);
        buffer.inTransition.clear();
        if (inTransition_.empty()) return;
        for (const LevelDraw& draw : inTransition_)
            buffer.inTransition.push_back(
                seenBox(bounds_[draw.instance->chain], frame.clipFromWorld() * draw.instance->world, frame.size));
        stippled_.set("visibilityTexture", visibility_);
        drawWith(stippled_, frame, inTransition_);
    }

    static void drawWith(gl::Program& program, const LodFrame& frame, const std::vector<LevelDraw>& draws) {
        program.set("clipFromWorld", glm::mat4(frame.clipFromWorld())).set("light", glm::vec4(frame.light));
        program.use();
        frame.drawer.draw(frame.chains, draws);
    }

    /// `first`: both buffers are of this very frame.
    void combine(const LodFrame& frame, const LodPicture& picture, bool first) {
        const auto pass = frame.pass("combination");
        glCopyImageSubData(newer_->colour.id(), GL_TEXTURE_2D, 0, 0, 0, 0, picture.colour.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                           frame.size.x, frame.size.y, 1);
        const glm::dmat4 oldClip = first ? frame.clipFromWorld() : frame.previousClipFromWorld();
        const glm::dmat4 oldProjection = first ? frame.projection : frame.previousProjection;
        const glm::dmat4 worldFromNew = glm::inverse(frame.clipFromWorld());
        const glm::dmat4 newFromOld = frame.clipFromWorld() * glm::inverse(oldClip);
        CombinedTiles tiles(frame.size);
        for (const SeenBox& box : newer_->inTransition) tiles.mark(box.pixels);
        for (const SeenBox& box : older_->inTransition)
            tiles.mark(reproject_ == Reproject::Off ? box.pixels : rectangleBehind(box, oldProjection, newFromOld));
        combine_.set("newColour", newer_->colour)
            .set("newDepth", newer_->depth)
            .set("oldColour", older_->colour)
            .set("oldDepth", older_->depth);
        if (reproject_ != Reproject::Off) combine_.set("oldFromNew", glm::mat4(oldClip * worldFromNew));
        if (reproject_ == Reproject::Motion) setMotions(oldClip, worldFromNew, first);
        picture.target.bind();
        drawRectangles(tiles.rectangles());
    }

    void setMotions(const glm::dmat4& oldClip, const glm::dmat4& worldFromNew, bool first) {
        std::vector<glm::mat4> motions(first ? 0 : Alternation::ids + 1, glm::mat4(oldClip * worldFromNew));
        for (const LevelDraw& draw : inTransition_) {
            const LodInstance& instance = *draw.instance;
            if (first || instance.world == instance.previous) continue;
            motions[draw.id] = glm::mat4(oldClip * instance.previous * glm::inverse(instance.world) * worldFromNew);
        }
        motions_.upload(motions.data(), motions.size() * sizeof(glm::mat4));
        motions_.bindStorage(0);
        combine_.set("motions", static_cast<int>(motions.size()));
    }

    void drawRectangles(std::span<const glm::vec4> rectangles) {
        constexpr std::size_t most = 256; // of combine.vert
        gl::Context& context = gl::Context::current();
        glBindVertexArray(context.noAttributes());
        glDisable(GL_DEPTH_TEST);
        for (std::size_t first = 0; first < rectangles.size(); first += most) {
            const auto part = rectangles.subspan(first, std::min(most, rectangles.size() - first));
            combine_.set("rectangles", part).use();
            glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * part.size()));
            ++context.tally().draws;
        }
    }

    Reproject reproject_;
    gl::Texture visibility_;
    gl::Program still_, stippled_, combine_;
    gl::Buffer motions_;
    Alternation alternation_;
    std::vector<Bounds> bounds_;          // by chain
    std::vector<LevelDraw> inTransition_; // in the newer buffer
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
