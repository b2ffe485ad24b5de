// Adaptive shadow maps (Fernando et al. 2001) as fitted virtual shadow maps (Giegl, Wimmer 2007) and resolution-matched ones
// (Lefohn et al. 2007) build them: a quadtree over the light's image plane, refined where the camera's pixels need smaller
// texels. Scherzer 2.2.2, "Subdivision". Each leaf is a page of equal texels; as many pages as one map of `map`² holds are
// drawn at a time, the pixels in them are tested, and the map is used again: up to (page · 2^levels)² texels in effect.
// Departures: every pixel is asked, not those of a reduced buffer or one of each connected surface; nothing is kept from
// frame to frame; only placements whose box meets a page are drawn into it.
// Its price is passes, one a page: `pages` bounds them. Where they do not suffice, those pages stay coarse whose texels are
// too long by the least, summed over their pixels.
#include "techniques/entries.h"
#include "techniques/maps/sm-adaptive/refinement.h"
#include "techniques/maps/tiled_planes.h"

#include "harness/scene/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

/// `page` checked against the map that must hold at least one.
int pageSide(const Parameters& p) {
    const int page = p.integer("page"), map = p.integer("map");
    if (page <= map) return page;
    throw BadInput(fmt::format(
        "sm-adaptive: a page of {0}² texels does not fit into a map of {1}²: page must be at most map", page, map));
}

class Adaptive final : public Technique {
public:
    explicit Adaptive(const Parameters& p)
        : limits_{pageSide(p), p.integer("levels"), p.integer("pages"), p.real("density")},
          columns_(p.integer("map") / limits_.texels), cells_(1 << limits_.levels),
          maps_(p.integer("map"), cells_, static_cast<float>(limits_.texels) * static_cast<float>(cells_), biasFrom(p)) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const std::vector<Page> pages = refine(maps_.demands(frame, visibility), limits_);
        const std::size_t held = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_);
        for (std::size_t first = 0; first < pages.size(); first += held) {
            const std::size_t count = std::min(held, pages.size() - first);
            maps_.shade(frame, tilesOf(std::span(pages).subspan(first, count)), visibility);
        }
    }

private:
    /// The pages in their slots of the map.
    [[nodiscard]] std::vector<PlaneTile> tilesOf(std::span<const Page> pages) const {
        std::vector<PlaneTile> tiles;
        for (const Page& page : pages) {
            const int slot = static_cast<int>(tiles.size());
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
    std::vector<Parameter> parameters{
        {"page", "128", IntegerRange{16, 1024}, "texels per side of a page", ""},
        {"levels", "8", IntegerRange{0, 8}, "how often a page may be cut in four: (page · 2^levels)² texels at most",
         "dissertation, 2.2.2"},
        {"pages", "1024", IntegerRange{6, 4096}, "pages drawn a frame, at most: one pass each", ""},
        {"density", "1", RealRange{0.125, 16}, "texels along a pixel, at least, where pages and levels suffice", ""},
    };
    for (Parameter& parameter : depthMapParameters()) parameters.push_back(std::move(parameter));
    return {.id = "sm-adaptive",
            .title = "Adaptive shadow map (fitted virtual)",
            .source = {Seed::Dissertation, "2.2.2, Subdivision"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Adaptive>(p); }};
}

} // namespace shadowbench::techniques
