// Logarithmic perspective shadow map (Lloyd, Govindaraju, Quammen, Molnar, Manocha 2008): over the light's plane, turned so
// that the view axis lies along y, a map of x / v and log v, where v is the distance from a centre: seen from the side, the
// eye's own place. A texel is as many times as long and as wide as it is far from the eye, so that perspective aliasing is
// the same at all depths; a perspective alone (`sm-lispsm`) evens it out along one axis, at both ends of the range. Straight
// edges are curves in such a map, and a rasteriser knows none: as in the paper's section on rasterisation, a rectangle
// around each triangle is drawn, and the fragment shader tests the triangle's sides on the light's plane, where they are
// straight.
// Departures: the near distance of the warp follows from eye depths along the map, as for `sm-lispsm`, where the paper
// derives it from the angle between view and light; depths are the light's own, not warped; and with light and view along
// one line there is one map that is hardly warped, where the paper cuts the frustum into faces. What is even is the error
// at all depths of the view frustum within the scene's box: where the camera's near plane lies long before the first
// receiver, the texels between them show nothing, and `sm-lispsm`, whose error is least in the middle of the range, may err
// less.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/api.h"
#include "techniques/gl/program.h"
#include "techniques/maps/sm-log/log_view.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/triangle_rectangles.h"

#include <cmath>
#include <memory>

namespace shadowbench::techniques {
namespace {

class SmLog final : public Technique {
public:
    explicit SmLog(const Parameters& parameters)
        : side_(parameters.integer("map")), bias_(biasFrom(parameters)),
          depth_(gl::Format::Depth32F, {side_, side_}, gl::Filter::Nearest, gl::Wrap::BorderFar), target_{&depth_} {
        depth_.compareDepth();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitLog(frame.hardLight, frame.snapshot, frame.snapshot.camera, frame.aspect());
        draw(frame);
        place(resolve_);
        resolve_.set("positions", frame.gbuffer.position()).set("depthMap", depth_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, side_);
    }

private:
    void place(gl::Program& program) const {
        program.set("planeFromWorld", glm::mat4(view_.planeFromWorld))
            .set("slopes", glm::vec2(view_.left, view_.right - view_.left))
            .set("warp", glm::vec2(view_.near, std::log(view_.far / view_.near)));
    }

    void draw(const Frame& frame) {
        const auto pass = frame.pass("depth map");
        target_.clearDepth(1);
        target_.bind();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDisable(GL_CULL_FACE);
        place(triangles_);
        triangles_.set("texel", 1.0F / static_cast<float>(side_))
            .set("factor", bias_.factor)
            .set("units", static_cast<float>(bias_.units * depthStep));
        drawTriangleRectangles(frame, triangles_);
    }

    int side_;
    Bias bias_;
    LogView view_;
    gl::Texture depth_;
    gl::RenderTarget target_;
    gl::Program triangles_{"maps/sm-log/triangle.vert", "maps/sm-log/triangle.frag"};
    gl::Program resolve_ = gl::Program::screen("maps/sm-log/sm-log.frag");
};

} // namespace

Entry smLog() {
    return {.id = "sm-log",
            .title = "Logarithmic perspective shadow map",
            .source = {Document::Other, "Lloyd et al. 2008"},
            .answer = Answer::Hard,
            .parameters = depthMapParameters(),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<SmLog>(p); }};
}

} // namespace shadowbench::techniques
