// Tiled shadow maps (Arvo 2004): one texture of `map`² texels is cut in two again and again, and its tiles hold parts of the
// light's image plane of different size, as a heuristic says. Scherzer 2.2.2, "Subdivision". What the heuristic weighs, per
// pixel that the camera sees: how long a texel is there in the image (distance from the camera, and the slopes towards it
// and towards the light), and whether the light's depth has a discontinuity beside it, as found in a first map of the whole
// plane. That one serves the analysis alone, and needs no more texels than there are places for a cut.
// Departures: the weights are pixels of expected error, and cuts are placed where they leave the least of it; tiles are
// narrowed to what the camera sees.
// It fails where the heuristic misjudges: pixels that cannot err, or occluders that the first map misses.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/maps/sm-tiled/tiling.h"
#include "techniques/shared/maps/plane_demands.h"
#include "techniques/shared/maps/tiles_on_planes.h"

namespace shadowbench::techniques {
namespace {

constexpr int cellsPerSide = 256; // per side of a plane: where cuts may be
constexpr int longestTexel = 16;  // pixels that a texel of the whole plane's map counts at most

/// How a tile's part of its plane lies in the atlas, as sm-tiled.frag reads it.
struct Place {
    glm::vec2 offset, scale; // atlas = offset + scale · plane, both in [0, 1]
    glm::vec4 inner;         // outermost texel centres, low and high
};

Place placeOf(const PlaneTile& tile, int side) {
    const glm::dvec2 low = glm::dvec2(tile.texels.at) / static_cast<double>(side);
    const glm::dvec2 size = glm::dvec2(tile.texels.size) / static_cast<double>(side);
    const glm::dvec2 scale = size * static_cast<double>(cellsPerSide) / glm::dvec2(tile.size);
    const glm::dvec2 half(0.5 / side);
    return {glm::vec2(low - scale * glm::dvec2(tile.at) / static_cast<double>(cellsPerSide)), glm::vec2(scale),
            glm::vec4(low + half, low + size - half)};
}

class Tiled final : public Technique {
public:
    explicit Tiled(const Parameters& p)
        : side_(p.integer("map")), most_(p.integer("tiles")),
          demands_(
              static_cast<float>(longestTexel * side_),
              PlaneDemands::Discontinuity{static_cast<float>(p.real("discontinuity")), p.integer("analysis"), biasFrom(p)}),
          tiles_(cellsPerSide), atlas_(side_, biasFrom(p)), test_(gl::Program::screen("maps/sm-tiled/sm-tiled.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        chooseTiles(frame, demands_.of(frame, visibility));
        drawTiles(frame);
        tiles_.bindTo(test_);
        demands_.bindTo(test_, frame);
        test_.set("depthAtlas", atlas_.texture());
        resolve(frame, {&visibility}, test_);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& /*frame*/) const override {
        return {{"tiles", static_cast<double>(tiles_.tiles().size())},
                {"effective_resolution", tiles_.effectiveResolution()}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return tiles_.pointAt(demands_.planes(), world);
    }

private:
    void chooseTiles(const Frame& frame, const std::vector<Demand>& demands) {
        const auto pass = frame.pass("tile choice");
        const std::size_t planes = demands_.planes().size();
        tiles_.set(tilesFor(demands, static_cast<int>(planes), cellsPerSide, side_, most_), planes);
        std::vector<Place> places;
        for (const PlaneTile& tile : tiles_.tiles()) places.push_back(placeOf(tile, side_));
        placeBuffer_.upload(places.data(), places.size() * sizeof(Place));
        placeBuffer_.bindStorage(4); // sm-tiled.frag
    }

    void drawTiles(const Frame& frame) {
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        std::vector<Tile> rectangles;
        std::vector<LightView> views;
        std::vector<std::vector<bool>> casters;
        for (const PlaneTile& tile : tiles_.tiles()) {
            rectangles.push_back(tile.texels);
            views.push_back(tiles_.viewOf(tile, demands_.planes()));
            casters.push_back(castersIn(views.back(), corners));
        }
        atlas_.setTiles(std::move(rectangles));
        atlas_.draw(views, frame, casters);
    }

    int side_, most_;
    PlaneDemands demands_;
    TilesOnPlanes tiles_;
    gl::Buffer placeBuffer_;
    DepthAtlas atlas_;
    gl::Program test_;
};

} // namespace

Entry smTiled() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"tiles", "16", IntegerRange{1, 64}, "parts of the texture, at most; six around a light inside the scene",
         "dissertation, 2.2.2"},
        {"discontinuity", "0.9", RealRange{0, 1},
         "share of a pixel's weight that it has only beside a depth discontinuity of the light's view",
         "dissertation, 2.2.2"},
        {"analysis", "256", IntegerRange{16, 4096},
         "texels per side of the first map, in which discontinuities are found; cuts lie on a grid of 256 per side",
         "dissertation, 2.2.2"},
    });
    return {.id = "sm-tiled",
            .title = "Tiled shadow map",
            .source = {Document::Dissertation, "2.2.2, Subdivision"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .figures = {{"tiles", "tiles drawn, one pass each"}, effectiveResolutionFigure()},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Tiled>(p); }};
}

} // namespace shadowbench::techniques
