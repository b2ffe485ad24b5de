// Adaptive shadow maps (Fernando et al. 2001) as fitted virtual shadow maps (Giegl, Wimmer 2007) and resolution-matched ones
// (Lefohn et al. 2007) build them: a quadtree over the light's image plane, refined where the camera's pixels need smaller
// texels. Scherzer 2.2.2, "Subdivision". Each leaf is a page of equal texels: up to (page · 2^levels)² texels in effect. As
// in the first of these papers, pages are kept from frame to frame in a fixed memory, that of one map of `map`² texels. A
// page is drawn again when the light or its plane has changed, or a caster whose box meets the page has moved; so what is
// kept is what would be drawn, and no image depends on the frames before it. Where the pages of one frame do not fit, the
// memory is filled again, and each filling tests the pixels that lie in its pages.
// A page is refined while more than 1 − `share` of its pixels are too short for its texels: the first paper weighs the
// pixels that a finer page would improve against the cost of drawing it, and leaves pages that few pixels ask for.
// Departures: every pixel is asked, not those at shadow edges (Fernando), of a reduced buffer (Giegl) or one of each
// connected surface (Lefohn); only placements whose box meets a page are drawn into it.
// It costs a pass a page: `pages` bounds them. Where they do not suffice, those pages stay coarse whose texels are
// too long by the least, summed over their pixels.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/maps/sm-adaptive/refinement.h"
#include "techniques/shared/maps/page_cache.h"
#include "techniques/shared/maps/page_maps.h"
#include "techniques/shared/maps/plane_demands.h"
#include "techniques/shared/maps/stale_pages.h"
#include "techniques/shared/maps/tiles_on_planes.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

std::optional<std::string> pageBeyondMap(const Parameters& p) {
    const int page = p.integer("page"), map = p.integer("map");
    if (page <= map) return std::nullopt;
    return fmt::format("a page of {0}² texels does not fit into a map of {1}²: page must be at most map", page, map);
}

Refinement limitsFrom(const Parameters& p) {
    return {p.integer("page"), p.integer("levels"), p.integer("pages"), p.real("density"), p.real("share")};
}

/// A page's place in its plane, and that of its map, as sm-adaptive.frag reads them.
struct alignas(8) Place {
    glm::ivec2 page, corner;
    int pagesPerPlane;
};

class Adaptive final : public Technique {
public:
    explicit Adaptive(const Parameters& p)
        : limits_(limitsFrom(p)), keeps_(p.text("cache") == "on"), cells_(1 << limits_.levels),
          demands_(static_cast<float>(limits_.texels) * static_cast<float>(cells_)), tiles_(cells_),
          maps_(limits_.texels, p.integer("map"), biasFrom(p)), cache_(maps_.slots()),
          test_(gl::Program::screen("maps/sm-adaptive/sm-adaptive.frag")) {}

    void reset() override {
        cache_.clear();
        stale_.forget();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        choosePages(frame, demands_.of(frame, visibility));
        dropStalePages(frame.snapshot);
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        const std::vector<Filling> fillings = cache_.place(pages_);
        drawn_ = 0;
        for (const Filling& filling : fillings) {
            draw(filling, frame, corners);
            test(filling, frame, visibility);
        }
        fillings_ = fillings.size();
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& /*frame*/) const override {
        return {{"pages", static_cast<double>(pages_.size())},
                {"drawn", static_cast<double>(drawn_)},
                {"fillings", static_cast<double>(fillings_)},
                {"effective_resolution", tiles_.effectiveResolution()}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return tiles_.pointAt(demands_.planes(), world);
    }

private:
    void choosePages(const Frame& frame, const std::vector<Demand>& demands) {
        const auto pass = frame.pass("refinement");
        pages_ = refine(demands, limits_);
        std::vector<PlaneTile> tiles;
        for (const Page& page : pages_) tiles.push_back(tileOf(page));
        tiles_.set(std::move(tiles), demands_.planes().size());
    }

    [[nodiscard]] PlaneTile tileOf(const Page& page) const {
        const glm::ivec2 size(cells_ >> page.level);
        return {page.plane, size * page.at, size, {{0, 0}, glm::ivec2(limits_.texels)}};
    }

    void dropStalePages(const Snapshot& snapshot) {
        const std::vector<LightView>& planes = demands_.planes();
        stale_.drop(cache_, snapshot, planes, [&](const Page& page) { return tiles_.viewOf(tileOf(page), planes); });
        if (!keeps_) cache_.clear();
    }

    void draw(const Filling& filling, const Frame& frame, const std::vector<glm::dvec3>& corners) {
        if (std::ranges::all_of(filling, &HeldPage::kept)) return;
        const auto pass = frame.pass("depth map");
        for (const HeldPage& held : filling) {
            if (held.kept) continue;
            const LightView view = tiles_.viewOf(tiles_.tiles()[held.number], demands_.planes());
            maps_.draw(held.slot, view, frame.scene, castersIn(view, corners));
            ++drawn_;
        }
    }

    void test(const Filling& filling, const Frame& frame, const gl::Texture& visibility) {
        std::vector<Place> places;
        for (const Page& page : pages_) places.push_back({page.at, glm::ivec2(-1), 1 << page.level});
        for (const HeldPage& held : filling) places[held.number].corner = maps_.cornerOf(held.slot);
        placeBuffer_.upload(places.data(), places.size() * sizeof(Place));
        placeBuffer_.bindStorage(4);
        tiles_.bindTo(test_);
        demands_.bindTo(test_, frame);
        test_.set("depths", maps_.texture()).set("texels", limits_.texels);
        resolve(frame, {&visibility}, test_);
    }

    Refinement limits_;
    bool keeps_;
    int cells_; // per side of a plane: pages of the finest level
    PlaneDemands demands_;
    TilesOnPlanes tiles_; // of `pages_`
    PageMaps maps_;
    PageCache cache_;
    StalePages stale_;
    gl::Buffer placeBuffer_;
    gl::Program test_;

    std::vector<Page> pages_; // of the frame last rendered, as are the next
    std::size_t drawn_ = 0, fillings_ = 0;
};

} // namespace

Entry smAdaptive() {
    std::vector<Parameter> parameters = {
        {"page", "128", IntegerRange{16, 1024}, "texels per side of a page", ""},
        {"levels", "8", IntegerRange{0, finestLevel},
         "how often a page may be cut in four: (page · 2^levels)² texels at most", "dissertation, 2.2.2"},
        {"pages", "1024", IntegerRange{6, 4096}, "pages that a frame uses, at most: one pass each that is drawn", ""},
        {"density", "1", RealRange{0.125, 16}, "texels along a pixel, at least, where pages and levels suffice", ""},
        {"share", "0.99", RealRange{0, 1}, "of a page's pixels that must have so many texels, else it is refined", ""},
        {"cache", "on", OneOf{{"on", "off"}}, "pages are kept from frame to frame, which changes no image",
         "Fernando et al. 2001"},
    };
    // The memory of the paper's results: 16 MB, that of a map of 2048².
    for (Parameter& parameter : depthMapParameters(2048)) parameters.push_back(std::move(parameter));
    return {.id = "sm-adaptive",
            .title = "Adaptive shadow map (fitted virtual)",
            .source = {Document::Dissertation, "2.2.2, Subdivision"},
            .answer = Answer::Hard,
            .parameters = std::move(parameters),
            .contradiction = pageBeyondMap,
            .figures = {{"pages", "pages that the frame uses"},
                        {"drawn", "pages drawn in the frame, one pass each; the others were kept"},
                        {"fillings", "times that the memory was filled with pages"},
                        effectiveResolutionFigure()},
            .variants = {"", "cache=off"},
            .make = [](const Parameters& p) { return std::make_unique<Adaptive>(p); }};
}

} // namespace shadowbench::techniques
