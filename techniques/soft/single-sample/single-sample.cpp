// Single sample soft shadows (Brabec and Seidel 2002), after Scherzer 2.3.1, eq. 2.1:
// 1. a map from the light's centre holds depths and surface ids;
// 2. a receiver that the centre lights searches the map for the nearest texel in which another surface is nearer to the
//    light, one in hard shadow for the nearest texel in which there is none;
// 3. r_max is the penumbra's reach to each side of the hard edge by similar triangles, from the depths of receiver and
//    occluder, but never more than the search's radius; visibility is ½ (1 + r / r_max) outside and ½ (1 − r / r_max)
//    inside the hard shadow.
// As the source has it, texels of the receiver's own id hide nothing: a surface never shades itself wrongly, and what it
// casts on itself is lost. Departures: distances are shares of a rectangle's own width and height (the paper's light is a
// sphere); whether another surface is nearer is decided against the receiver's plane; tiles of the map that hold the
// receiver's surface alone end the search before it begins.
#include "techniques/contract/applicability.h"
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/nearest_texel.h"
#include "techniques/shared/maps/linear_depth_map.h"

namespace shadowbench::techniques {
namespace {

constexpr int tileSide = 16;

gl::Defines tileDefines() { return {{"TILE_SIDE", std::to_string(tileSide)}}; }

class SingleSample final : public Technique {
public:
    explicit SingleSample(const Parameters& p)
        : radius_(p.integer("radius")), followPlane_(p.text("bias") == "slope"),
          map_(p.integer("map"), biasFrom(p), Texel::DepthAndSurface),
          tiles_(gl::Format::RG32F, glm::ivec2((map_.side() + tileSide - 1) / tileSide)),
          tile_(gl::Program::screen("soft/single-sample/tile.frag", tileDefines())),
          resolve_(gl::Program::screen("soft/single-sample/single-sample.frag", tileDefines())) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        tile_.set("idMap", map_.texture());
        resolve(frame, {&tiles_}, tile_, "tile ids");

        setNearestTexel(resolve_, frame.snapshot.light, view_, map_.side(), radius_, followPlane_);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("ids", frame.gbuffer.id())
            .set("idMap", map_.texture())
            .set("tiles", tiles_)
            .set("nearDepth", static_cast<float>(view_.near));
        resolve(frame, {&visibility}, resolve_, "neighbourhood search");
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    int radius_;
    bool followPlane_;
    LightView view_;
    LinearDepthMap map_;
    gl::Texture tiles_;
    gl::Program tile_, resolve_;
};

} // namespace

Entry singleSample() {
    std::vector<Parameter> parameters = depthMapParameters();
    parameters.push_back({"radius", std::to_string(widestSearch), IntegerRange{1, widestSearch},
                          "texels after which a search ends, and the greatest reach of a penumbra", ""});
    return {.id = "single-sample",
            .title = "Single sample soft shadows",
            .source = {Document::Dissertation, "2.3.1, eq. 2.1"},
            .answer = Answer::Soft,
            .notApplicable = lightWithoutArea,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<SingleSample>(p); }};
}

} // namespace shadowbench::techniques
