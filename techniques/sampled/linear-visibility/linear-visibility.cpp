// Soft shadow maps for linear lights (Heidrich, Brabec, Seidel 2000): course, "Linear Light Sources"; Scherzer 2.3.5.
// 1. a shadow map from each end of the light  2. depth discontinuities in each  3. the polygons across them, skins, warped
// into the map of the other end and drawn into its visibility map, black on the occluder, white on the receiver, linear
// between  4. a receiver has ½ from each end that sees it outside penumbrae, within a penumbra the visibility map's value,
// and nothing from an end that does not see it. The light may be subdivided: `samples` ends make one linear light less.
// Where only the middle of a light is seen, both ends see nothing.
// Departures: a discontinuity is where the planes on both sides do not continue, by more than a penumbra of one texel,
// where the paper takes the Laplacian of a Gaussian; receivers are compared on their own plane, instead of a bias in the
// maps; of skins that overlap, the least visibility is kept, as each hides the light from its own edge on (the course says
// nothing of overlaps); all work is the GPU's (compute, an indirect draw).
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/sampled/linear-visibility/skins.h"
#include "techniques/shared/light_views/light_planes.h"

#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {
namespace {

class LinearVisibility final : public Technique {
public:
    explicit LinearVisibility(const Parameters& p)
        : segments_(p.integer("samples") - 1), ends_{LineEnd(p.integer("map")), LineEnd(p.integer("map"))},
          skins_(p.integer("map")), test_(gl::Program::screen("sampled/linear-visibility/linear-visibility.frag")),
          mean_(gl::Program::screen("shared/sampling/mean.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (!sum_ || sum_->size() != frame.size) sum_.emplace(gl::Format::R32F, frame.size);
        gl::RenderTarget({&*sum_}).clearColour(0, glm::vec4(0));
        skins_.beginFrame();
        drawEnd(0, frame);
        for (int segment = 0; segment < segments_; ++segment) {
            drawEnd(segment + 1, frame);
            const double length = glm::length(frame.snapshot.light.u) / segments_;
            skins_.draw(frame, ends_[0], ends_[1], length);
            skins_.draw(frame, ends_[1], ends_[0], length);
            addTest(frame, length);
        }
        mean_.set("sum", *sum_).set("count", static_cast<float>(segments_));
        resolve(frame, {&visibility}, mean_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame&) const override {
        return {{"skins", static_cast<double>(skins_.count())}};
    }

private:
    /// Draws the map of an end, which takes the place of the one before the last.
    void drawEnd(int number, const Frame& frame) {
        const Light& light = frame.snapshot.light;
        LineEnd& end = ends_[static_cast<std::size_t>(number) % 2];
        const glm::dvec3 point = light.centre + (static_cast<double>(number) / segments_ - 0.5) * light.u;
        // A rim of two texels that hold nothing: the outline of what reaches the view's end is a discontinuity too.
        const glm::dvec2 rim(2.0 / end.map.side());
        end.view = partOf(fitFromSample(light, point, frame.snapshot), -rim, 1.0 + rim);
        end.map.draw(end.view, frame);
    }

    void addTest(const Frame& frame, double length) {
        const auto pass = frame.pass("shadow test");
        const std::array maps{mapFromWorld(ends_[0].view), mapFromWorld(ends_[1].view)};
        const std::array texels{glm::mat4(worldFromTexel(ends_[0].view)), glm::mat4(worldFromTexel(ends_[1].view))};
        test_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("mapsFromWorld", std::span<const glm::mat4>(maps))
            .set("worldFromTexels", std::span<const glm::mat4>(texels))
            .set("leastGap", static_cast<float>(gapOfOneTexel(ends_[0], length)))
            .set("depths0", ends_[0].map.texture())
            .set("depths1", ends_[1].map.texture())
            .set("visibilities0", ends_[0].visibility)
            .set("visibilities1", ends_[1].visibility);
        const gl::RenderTarget target({&*sum_});
        target.bind();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        test_.drawScreen();
        glDisable(GL_BLEND);
    }

    int segments_;
    std::array<LineEnd, 2> ends_;
    Skins skins_;
    gl::Program test_, mean_;
    std::optional<gl::Texture> sum_;
};

std::optional<std::string> lightThatIsNoLine(const Scene& scene) {
    if (!scene.light.isArea() || scene.light.kind == LightKind::Line) return std::nullopt;
    return fmt::format("interpolates between the ends of a linear light; the light of {} is a {}", scene.id,
                       name(scene.light.kind));
}

} // namespace

Entry linearVisibility() {
    return {.id = "linear-visibility",
            .title = "Soft shadow maps for linear lights",
            .source = {Document::Course, "Linear Light Sources; dissertation 2.3.5"},
            .answer = Answer::Soft,
            .notApplicable = lightThatIsNoLine,
            .parameters = {{"samples", "2", IntegerRange{2, 16},
                            "shadow maps along the light: both ends, and where it is subdivided",
                            "course, Sampling the Light Source"},
                           mapParameter()},
            .figures = {{"skins", "quads across depth discontinuities, of all maps"}},
            .variants = {"", "samples=5"},
            .make = [](const Parameters& p) { return std::make_unique<LinearVisibility>(p); }};
}

} // namespace shadowbench::techniques
