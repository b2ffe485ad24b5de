// Sample-based visibility over alias-free lists (Sintorn, Eisemann, Assarsson 2008): Scherzer 2.3.5, Fig. 2.23. Pixels are
// kept in lists over the light's view, as in sm-alias-free. A triangle is tested against the pixels of all cells that it may
// shade from any point of the light: the light's outline is projected through its corners onto the deepest receiver. A pixel
// and the triangle's edges span three planes; the light samples behind all three, and behind the triangle, are those that
// the triangle hides; their bits are OR'd into those of the pixel. The share of bits that stay clear is the visibility.
// What N samples see is exact, for open meshes too. Departures: the paper looks up the samples behind a plane in a table
// over the plane's rounded orientation and distance, here each sample is tested; the light's outline is its bounding
// rectangle instead of a hexagon; for the lists see techniques/shared/maps/pixel_lists.h.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/light_views/focused_view.h"
#include "techniques/shared/maps/pixel_lists.h"
#include "techniques/shared/sampling/light_points.h"

#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace shadowbench::techniques {
namespace {

constexpr int wordBits = 32, groupSize = 4; // sampled/soft-alias-free/samples.glsl

/// For each large triangle: a round of each of the two loops of shadeLarge() (cast.comp), and a share of the rounds that end
/// them and of the loop over blocks of triangles (shared/maps/cast_triangles.glsl).
constexpr int roundsOfBlocks = 3;

constexpr int lightCorners = 4;

int wordsFor(int samples) { return (samples + wordBits - 1) / wordBits; }

gl::Defines definesFor(int samples) { return {{"WORDS", std::to_string(wordsFor(samples))}}; }

std::vector<glm::dvec4> cornersOf(const Light& light) {
    std::vector<glm::dvec4> corners;
    for (const double u : {-0.5, 0.5})
        for (const double v : {-0.5, 0.5}) corners.emplace_back(light.centre + u * light.u + v * light.v, 1);
    return corners;
}

/// Two directions of unit length that span a light's plane; the second is 0 for a linear light.
struct LightPlane {
    explicit LightPlane(const Light& light) : right(glm::normalize(light.u)) {
        const glm::dvec3 across = light.v - glm::dot(light.v, right) * right;
        if (glm::length(across) > 0) up = glm::normalize(across);
    }
    glm::dvec3 right, up{0};
};

class SoftAliasFree final : public Technique {
public:
    explicit SoftAliasFree(const Parameters& p)
        : count_(p.integer("n")), pattern_(p.text("pattern")), slack_(p.real("slack")),
          lists_("sampled/soft-alias-free/cast.comp", definesFor(count_), p.integer("grid"), wordsFor(count_), lightCorners,
                 roundsOfBlocks + wordsFor(count_) + 1),
          resolve_(gl::Program::screen("sampled/soft-alias-free/soft-alias-free.frag", definesFor(count_))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const Light& light = frame.snapshot.light;
        lists_.gather(frame, fitFocused(light, frame.snapshot, frame.snapshot.camera, frame.aspect()), cornersOf(light));
        lists_.cast(frame, [&](gl::Program& program) { setLight(program, frame); });
        resolve_.set("width", frame.size.x).set("samples", count_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        const auto tests = lists_.tests(frame, [&](gl::Program& program) { setLight(program, frame); });
        return {{"tests", static_cast<double>(tests)}};
    }

private:
    void setLight(gl::Program& program, const Frame& frame) const {
        const Light& light = frame.snapshot.light;
        const LightPlane plane(light);
        const Bounds bounds = frame.snapshot.bounds();
        // In groups, across the light and up; past the last sample, its centre.
        const std::size_t groups = static_cast<std::size_t>(wordsFor(count_)) * (wordBits / groupSize);
        std::vector<glm::vec4> across(groups, glm::vec4(0)), up(groups, glm::vec4(0));
        std::size_t i = 0;
        for (const glm::dvec3& point : lightPoints(light, pattern_, count_, frame.seed)) {
            const auto group = i / groupSize;
            const auto place = static_cast<glm::length_t>(i++ % groupSize);
            across[group][place] = static_cast<float>(glm::dot(point - light.centre, plane.right));
            up[group][place] = static_cast<float>(glm::dot(point - light.centre, plane.up));
        }
        program.set("samplesAcross", across)
            .set("samplesUp", up)
            .set("lightCentre", glm::vec3(light.centre))
            .set("lightRight", glm::vec3(plane.right))
            .set("lightUp", glm::vec3(plane.up))
            .set("halfLight", glm::vec2(halfSize(light.u, light.v, plane.right), halfSize(light.u, light.v, plane.up)))
            .set("slack", static_cast<float>(slack_ * glm::distance(bounds.low, bounds.high)));
    }

    static double halfSize(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& along) {
        return 0.5 * (glm::abs(glm::dot(u, along)) + glm::abs(glm::dot(v, along)));
    }

    int count_;
    std::string pattern_;
    double slack_;
    mutable PixelLists lists_; // `figures` makes the tests again
    gl::Program resolve_;
};

} // namespace

Entry softAliasFree() {
    return {.id = "soft-alias-free",
            .title = "Alias-free lists with the hidden light samples as bits",
            .source = {Document::Dissertation, "2.3.5, Fig. 2.23"},
            .answer = Answer::Soft,
            .parameters = {{"n", "64", IntegerRange{1, 256}, "light samples, a bit of a pixel each",
                            "Zápotocký 5.2 (64 and 100)"},
                           lightPatternParameter(),
                           {"grid", "256", IntegerRange{1, 2048}, "cells per side of the grid over the light's view", ""},
                           {"slack", "1e-5", RealRange{0, 1},
                            "of the scene's diagonal: a receiver closer than this to a triangle's plane lies on it", ""}},
            .figures = {{"tests", "tests of a triangle against a pixel"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<SoftAliasFree>(p); }};
}

} // namespace shadowbench::techniques
