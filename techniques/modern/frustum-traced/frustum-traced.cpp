// Frustum-traced raster shadows (Wyman, Hoetzlein, Lefohn 2015): an irregular z-buffer in the graphics pipeline. 1. grids
// are fitted to the visible points in the light's view  2. pixels are put into lists, one a cell  3. cells without pixels
// are closed to fragments by depth  4. each triangle is rasterised conservatively from the light, and its fragments test it
// against the pixels of their cells: a pixel is in shadow where its point lies behind the triangle's plane and within the
// three planes of light and edge  5. a full-screen pass reads the answers. So shadows are exact at the pixel's centre, and
// what a map's fit does for its resolution it does here for the lengths of lists, which are the cost.
// Departures: one sample a pixel, its centre, where the paper also has 32 over the pixel's footprint, which are answers for
// antialiased images; pixels that are found in shadow stay in their lists and are passed over; llvmpipe has no conservative
// rasterisation, so that the triangle's bounding rectangle is drawn and fragments of untouched cells end at once. Around a
// light that single views cannot hold there are six grids, over the sides of a cube.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/gl/read_buffer.h"
#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/receiver_bounds.h"
#include "techniques/shared/maps/single_map.h"
#include "techniques/shared/maps/triangle_rectangles.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t);
constexpr std::size_t most = 65000; // pixels of a list: llvmpipe ends a shader's loops after 65,535 rounds
constexpr unsigned testsBinding = 7;

gl::Defines defines() { return {{"MOST", std::to_string(most) + "u"}}; }

gl::Defines counting() {
    gl::Defines all = defines();
    all.emplace_back("COUNT_TESTS", "1");
    return all;
}

std::size_t pixelsOf(const Frame& frame) {
    return static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y);
}

/// The part of `box` that a view of a cube holds; nothing where they are apart.
std::optional<Bounds> withinSide(const Bounds& box) {
    Bounds part;
    part.low = glm::max(box.low, glm::dvec3(-1));
    part.high = glm::min(box.high, glm::dvec3(1));
    if (part.low.x > part.high.x || part.low.y > part.high.y) return std::nullopt;
    return part;
}

/// A grid over `box`, which is of the view: a hundredth wider, since positions are rounded, and no narrower than a
/// thousandth of the view, below which rounding would show.
glm::mat4 gridOver(const Bounds& box, const glm::dmat4& clipFromWorld) {
    constexpr double margin = 0.01, leastHalf = 1e-3;
    const glm::dvec3 middle = 0.5 * (box.low + box.high), half = glm::max(0.5 * (box.high - box.low), glm::dvec3(leastHalf));
    Bounds grid;
    grid.add(middle - half);
    grid.add(middle + half);
    return mapFromClip() * fitMatrix(grid, margin) * clipFromWorld;
}

class FrustumTraced final : public Technique {
public:
    explicit FrustumTraced(const Parameters& p)
        : grid_(p.integer("grid")), slack_(p.real("slack")), open_(gl::Format::Depth32F, {grid_, grid_}), target_{&open_} {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        fit(frame);
        gather(frame);
        cast(frame);
        resolve_.set("width", frame.size.x);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        const std::vector<std::uint32_t> counts = gl::readWords(counts_, 1 + cells());
        gl::Program program("modern/frustum-traced/triangle.vert", "modern/frustum-traced/triangle.frag", counting());
        gl::Buffer tests;
        tests.clear(word);
        tests.bindStorage(testsBinding);
        bind();
        draw(frame, program);
        return {{"tests", static_cast<double>(gl::readWords(tests, 1).front())},
                {"longest_list", static_cast<double>(*std::max_element(counts.begin() + 1, counts.end()))}};
    }

private:
    /// One grid over a view towards the visible points, or six around a light that has some of them beside it or behind.
    void fit(const Frame& frame) {
        constexpr double leastShare = 0.1; // of the depth of the farthest visible point: that of the nearest, in one view
        mapsFromWorld_.clear();
        const LightView view = uniformView(frame);
        const std::optional<DepthRange> depths = bounds_.depths(frame, view.depthFromWorld);
        if (!depths) return;
        if (!view.perspective || depths->near >= leastShare * depths->far) {
            mapsFromWorld_.push_back(gridOver(*visibleBox(frame, view), view.clipFromWorld));
            return;
        }
        for (const LightView& side : cubeViews(frame.hardLight.centre, boundingCorners(frame.snapshot))) {
            const std::optional<Bounds> box = visibleBox(frame, side);
            const std::optional<Bounds> part = box ? withinSide(*box) : std::nullopt;
            if (part) mapsFromWorld_.push_back(gridOver(*part, side.clipFromWorld));
        }
    }

    std::optional<Bounds> visibleBox(const Frame& frame, const LightView& view) {
        return bounds_.boxes(frame, view.depthFromWorld, {DepthRange{}}, view.clipFromWorld).front();
    }

    void gather(const Frame& frame) {
        const auto pass = frame.pass("pixel lists");
        const std::size_t pixels = pixelsOf(frame);
        heads_.clear((cells() + pixels / most + 1) * word);
        nexts_.clear(pixels * word);
        results_.clear(pixels * word);
        counts_.clear((1 + cells()) * word);
        bind();
        if (mapsFromWorld_.empty()) return;
        bin_.set("positions", frame.gbuffer.position())
            .set("pixels", static_cast<int>(pixels))
            .set("grid", grid_)
            .set("views", static_cast<int>(mapsFromWorld_.size()))
            .set("mapFromWorld", std::span<const glm::mat4>(mapsFromWorld_));
        bin_.dispatch(pixels);
    }

    void bind() const {
        unsigned binding = 3; // modern/frustum-traced/lists.glsl
        for (const gl::Buffer* buffer : {&heads_, &nexts_, &results_, &counts_}) buffer->bindStorage(binding++);
    }

    [[nodiscard]] std::size_t cells() const {
        return mapsFromWorld_.size() * static_cast<std::size_t>(grid_) * static_cast<std::size_t>(grid_);
    }

    void cast(const Frame& frame) {
        const auto pass = frame.pass("triangle tests");
        draw(frame, triangles_);
    }

    void draw(const Frame& frame, gl::Program& program) const {
        const std::size_t beyond = gl::readWords(counts_, 1).front();
        const int parts = 1 + static_cast<int>((beyond + most - 1) / most);
        program.set("positions", frame.gbuffer.position())
            .set("grid", grid_)
            .set("cell", 1.0F / static_cast<float>(grid_))
            .set("views", static_cast<int>(mapsFromWorld_.size()))
            .set("light", glm::vec4(frame.hardLight.homogeneous()))
            .set("slack", static_cast<float>(slack_));
        for (std::size_t view = 0; view < mapsFromWorld_.size(); ++view) {
            closeEmpty(static_cast<int>(view));
            program.set("view", static_cast<int>(view)).set("mapFromWorld", mapsFromWorld_[view]);
            for (int part = 0; part < parts; ++part) {
                program.set("part", part);
                drawTriangleRectangles(frame, program);
            }
        }
        glDepthMask(GL_TRUE);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }

    void closeEmpty(int view) const {
        target_.bind();
        empty_.set("grid", grid_).set("view", view);
        empty_.drawScreenDepth();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_FALSE);
        glDisable(GL_CULL_FACE);
    }

    int grid_;
    double slack_;
    ReceiverBounds bounds_{1};
    std::vector<glm::mat4> mapsFromWorld_; // of the frame rendered last
    gl::Buffer heads_, nexts_, results_, counts_;
    gl::Texture open_; // depth: which cells have pixels
    gl::RenderTarget target_;
    gl::Program bin_ = gl::Program::compute("modern/frustum-traced/bin.comp", defines());
    mutable gl::Program empty_ = gl::Program::screen("modern/frustum-traced/empty.frag"); // `figures` draws again
    gl::Program triangles_{"modern/frustum-traced/triangle.vert", "modern/frustum-traced/triangle.frag", defines()};
    gl::Program resolve_ = gl::Program::screen("shared/maps/unhidden.frag");
};

} // namespace

Entry frustumTraced() {
    return {
        .id = "frustum-traced",
        .title = "Frustum-traced raster shadows (irregular z-buffer, rasterised)",
        .source = {Document::Other, "Wyman, Hoetzlein, Lefohn 2015"},
        .answer = Answer::Hard,
        .parameters =
            {{"grid", "256", IntegerRange{1, 2048}, "cells per side of a grid over the light's view", ""},
             {"slack", "1e-5", RealRange{0, 1},
              "of the longest vector that is computed with: a receiver closer than this to a triangle's plane lies on it",
              ""}},
        .figures = {{"tests", "tests of a triangle against a pixel"},
                    {"longest_list", "pixels of the cell that has the most"}},
        .variants = {""},
        .make = [](const Parameters& p) { return std::make_unique<FrustumTraced>(p); }};
}

} // namespace shadowbench::techniques
