// Tiled shadow maps (Arvo 2004): one texture of `map`² texels is cut in two again and again, and its tiles hold parts of the
// light's image plane of different size, as a heuristic says. Scherzer 2.2.2, "Subdivision". What the heuristic weighs, per
// pixel that the camera sees: how long a texel is there in the image (distance from the camera, and the slopes towards it
// and towards the light), and whether the light's depth has a discontinuity beside it, as found in a first map of the whole
// plane, drawn into the same texture.
// Departures: the weights are pixels of expected error, and cuts are placed where they leave the least of it; tiles are
// narrowed to what the camera sees.
// It fails where the heuristic misjudges: pixels that cannot err, or occluders that the first map misses.
#include "techniques/contract/entry.h"
#include "techniques/maps/sm-tiled/tiling.h"
#include "techniques/shared/maps/tiled_map.h"

namespace shadowbench::techniques {
namespace {

constexpr int cells = 256;       // per side of a plane: where cuts may be
constexpr int longestTexel = 16; // pixels that a texel of the whole plane's map counts at most

class Tiled final : public Technique {
public:
    explicit Tiled(const Parameters& p)
        : side_(p.integer("map")), tiles_(p.integer("tiles")),
          maps_(side_, cells, static_cast<float>(longestTexel * side_), biasFrom(p),
                static_cast<float>(p.real("discontinuity"))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        std::vector<PlaneTile> tiles = chosenTiles(frame, maps_.demands(frame, visibility));
        const std::size_t all = tiles.size();
        maps_.shade(frame, std::move(tiles), all, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& /*frame*/) const override {
        return {{"tiles", static_cast<double>(maps_.tiles().size())}, {"effective_resolution", maps_.effectiveResolution()}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return maps_.pointAt(world); }

private:
    [[nodiscard]] std::vector<PlaneTile> chosenTiles(const Frame& frame, const std::vector<Demand>& demands) const {
        const auto pass = frame.pass("tile choice");
        return tilesFor(demands, static_cast<int>(maps_.planes().size()), cells, side_, tiles_);
    }

    int side_, tiles_;
    TiledPlanes maps_;
};

} // namespace

Entry smTiled() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"tiles", "16", IntegerRange{1, 64}, "parts of the texture, at most; six around a light inside the scene",
         "dissertation, 2.2.2"},
        {"discontinuity", "0.9", RealRange{0, 1},
         "share of a pixel's weight that it has only beside a depth discontinuity of the light's view",
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
