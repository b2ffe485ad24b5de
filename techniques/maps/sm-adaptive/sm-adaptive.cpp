// Adaptive shadow maps (Fernando et al. 2001) as fitted virtual shadow maps (Giegl, Wimmer 2007) and resolution-matched ones
// (Lefohn et al. 2007) build them: a quadtree over the light's image plane, refined where the camera's pixels need smaller
// texels. Scherzer 2.2.2, "Subdivision". Each leaf is a page of equal texels; as many pages as one map of `map`² holds are
// drawn at a time, the pixels in them are tested, and the map is used again: up to (page · 2^levels)² texels in effect.
// Departures: every pixel is asked, not those of a reduced buffer or one of each connected surface; nothing is kept from
// frame to frame; only placements whose box meets a page are drawn into it.
// It costs a pass a page: `pages` bounds them. Where they do not suffice, those pages stay coarse whose texels are
// too long by the least, summed over their pixels.
#include "techniques/contract/entry.h"
#include "techniques/maps/sm-adaptive/refinement.h"
#include "techniques/shared/maps/tiled_map.h"

#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

std::optional<std::string> pageBeyondMap(const Parameters& p) {
    const int page = p.integer("page"), map = p.integer("map");
    if (page <= map) return std::nullopt;
    return fmt::format("a page of {0}² texels does not fit into a map of {1}²: page must be at most map", page, map);
}

class Adaptive final : public Technique {
public:
    explicit Adaptive(const Parameters& p)
        : limits_{p.integer("page"), p.integer("levels"), p.integer("pages"), p.real("density")},
          columns_(p.integer("map") / limits_.texels), cells_(1 << limits_.levels),
          maps_(p.integer("map"), cells_, static_cast<float>(limits_.texels) * static_cast<float>(cells_), biasFrom(p)) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        maps_.shade(frame, chosenPages(frame, maps_.demands(frame, visibility)), slots(), visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& /*frame*/) const override {
        const std::size_t pages = maps_.tiles().size(), fillings = (pages + slots() - 1) / slots();
        return {{"pages", static_cast<double>(pages)},
                {"fillings", static_cast<double>(fillings)},
                {"effective_resolution", maps_.effectiveResolution()}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return maps_.pointAt(world); }

private:
    /// How many pages the map holds at a time.
    [[nodiscard]] std::size_t slots() const {
        return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_);
    }

    [[nodiscard]] std::vector<PlaneTile> chosenPages(const Frame& frame, std::vector<Demand> demands) const {
        const auto pass = frame.pass("refinement");
        return tilesOf(refine(std::move(demands), limits_));
    }

    /// The pages, slot after slot of the map, again from the first when all are taken.
    [[nodiscard]] std::vector<PlaneTile> tilesOf(std::span<const Page> pages) const {
        std::vector<PlaneTile> tiles;
        for (const Page& page : pages) {
            const int slot = static_cast<int>(tiles.size() % slots());
            const glm::ivec2 size(cells_ >> page.level);
            const glm::ivec2 corner = limits_.texels * glm::ivec2(slot % columns_, slot / columns_);
            tiles.push_back({page.plane, size * page.at, size, {corner, glm::ivec2(limits_.texels)}});
        }
        return tiles;
    }

    Refinement limits_;
    int columns_; // slots for pages per side of the map
    int cells_;   // per side of a plane: pages of the finest level
    TiledPlanes maps_;
};

} // namespace

Entry smAdaptive() {
    std::vector<Parameter> parameters = withDepthMapParameters({
        {"page", "128", IntegerRange{16, 1024}, "texels per side of a page", ""},
        {"levels", "8", IntegerRange{0, 8}, "how often a page may be cut in four: (page · 2^levels)² texels at most",
         "dissertation, 2.2.2"},
        {"pages", "1024", IntegerRange{6, 4096}, "pages drawn a frame, at most: one pass each", ""},
        {"density", "1", RealRange{0.125, 16}, "texels along a pixel, at least, where pages and levels suffice", ""},
    });
    return {.id = "sm-adaptive",
            .title = "Adaptive shadow map (fitted virtual)",
            .source = {Document::Dissertation, "2.2.2, Subdivision"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .contradiction = pageBeyondMap,
            .figures = {{"pages", "pages drawn, one pass each"},
                        {"fillings", "times that the map was filled with pages"},
                        effectiveResolutionFigure()},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Adaptive>(p); }};
}

} // namespace shadowbench::techniques
