// Virtual shadow maps in a clipmap of cached pages, as engines ship them. Olsson et al. 2014: of maps over the lights' image
// planes those pages alone are there that the camera's points need. Epic's documents and Frogfood (figures: pages of 128²,
// levels of 4096²): under the sun levels lie around the eye, each twice as wide as the one before, and pages are kept.
// 1. Each pixel asks for the page that holds its point, at the coarsest level whose texels are no longer than the pixel is
// wide at that depth. 2. The program reads how many pixels ask for each page. 3. Pages that are not kept are drawn, into the
// slots of a pool of map² texels whose pages have not been asked for the longest. 4. Each pixel is tested in its page.
// A page is kept as long as the light stands and no caster moves in it. Under the sun it is a square of the world, so that
// it is kept while the eye moves, too. Where the pool is too small, pages that the fewest pixels ask for are left out; these
// pixels are tested in the finest coarser page that is there, and are lit where there is none. What is kept is what would be
// drawn, and no image depends on the frames before it.
// Of lights other than the sun each image plane, or each of six around the light, has the levels of a mipmap (Olsson et
// al.). Departures: the paper asks by clusters of pixels, not by each; engines have tables whose addresses wrap around,
// where here a table is written in each frame from pages' numbers in the world; they allocate on the GPU, which waits for
// nothing, and filter, where here a pixel is tested against one depth; Unreal has no shadow where its pool is too small
// (spear-sim/spear#228).
// Unreal's pool has 4,096 pages, for images of millions of pixels; the default's 1,024 are for a quarter of them.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/gl/read_buffer.h"
#include "techniques/modern/sm-clipmap/clipmap.h"
#include "techniques/modern/sm-clipmap/page_budget.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/maps/page_cache.h"
#include "techniques/shared/maps/page_maps.h"
#include "techniques/shared/maps/stale_pages.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace shadowbench::techniques {
namespace {

std::optional<std::string> pagesWithoutRoom(const Parameters& p) {
    const int page = p.integer("page"), extent = p.integer("extent"), map = p.integer("map");
    if (page > map)
        return fmt::format("a page of {0}² texels does not fit into a map of {1}²: page must be at most map", page, map);
    // Four, so that a coarser window always holds what a finer one does; a power of two, so that pages halve.
    constexpr std::array<int, 6> along{4, 8, 16, 32, 64, 128};
    if (extent % page == 0 && std::ranges::find(along, extent / page) != along.end()) return std::nullopt;
    return fmt::format(
        "levels of {0}² texels are not cut into pages of {1}²: extent must be 4, 8, 16, 32, 64 or 128 times page", extent,
        page);
}

ClipmapRule ruleFrom(const Parameters& p) {
    return {p.integer("page"), p.integer("extent"), p.integer("levels"), p.real("density")};
}

gl::Defines definesOf(const ClipmapRule& rule) { return {{"LEVELS", std::to_string(rule.levels)}}; }

class ClipmapShadows final : public Technique {
public:
    explicit ClipmapShadows(const Parameters& p)
        : rule_(ruleFrom(p)), keeps_(p.text("cache") == "on"), maps_(rule_.texels, p.integer("map"), biasFrom(p)),
          cache_(maps_.slots()), marking_(gl::Program::compute("modern/sm-clipmap/marking.comp", definesOf(rule_))),
          test_(gl::Program::screen("modern/sm-clipmap/sm-clipmap.frag", definesOf(rule_))) {}

    void reset() override {
        cache_.clear();
        stale_.forget();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        clipmap_.emplace(rule_, frame.hardLight, frame.snapshot, frame.size);
        mark(frame);
        allocate(frame);
        draw(frame);
        test(frame, visibility);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& /*frame*/) const override {
        double pixels = 0, served = 0;
        for (const auto& [page, count] : asked_) pixels += count;
        for (const Page& page : pages_)
            if (const auto found = asked_.find(page); found != asked_.end()) served += found->second;
        return {{"asked", static_cast<double>(asked_.size())},
                {"pages", static_cast<double>(pages_.size())},
                {"drawn", static_cast<double>(std::ranges::count(held_, false, &HeldPage::kept))},
                {"coarser", pixels > 0 ? 1 - served / pixels : 0}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        const PointInPages point = clipmap_->placeOf(world);
        for (std::size_t window = point.window; window < clipmap_->windows().size(); ++window) {
            const glm::dvec2 at = clipmap_->inWindow(point, window);
            const auto entry = clipmap_->entryOf(point.plane, window, glm::ivec2(glm::floor(at)));
            if (entry && slots_[*entry] > 0) return static_cast<double>(rule_.texels) * at;
        }
        return std::nullopt;
    }

private:
    void mark(const Frame& frame) {
        const auto pass = frame.pass("page marking");
        askedOfEntry_.clear(clipmap_->entries() * sizeof(std::uint32_t));
        askedOfEntry_.bindStorage(3);
        clipmap_->bindTo(marking_);
        marking_.set("positions", frame.gbuffer.position());
        marking_.dispatch(static_cast<std::size_t>(frame.size.x) * static_cast<std::size_t>(frame.size.y));
        const std::vector<std::uint32_t> pixels = gl::readWords(askedOfEntry_, clipmap_->entries());
        asked_.clear();
        for (std::size_t entry = 0; entry < pixels.size(); ++entry)
            if (pixels[entry] > 0) asked_.emplace(clipmap_->pageOf(entry), pixels[entry]);
    }

    void allocate(const Frame& frame) {
        const auto pass = frame.pass("page allocation");
        pages_ = pagesThatFit(asked_, clipmap_->windows().back().level, static_cast<std::size_t>(maps_.slots()));
        stale_.drop(cache_, frame.snapshot, clipmap_->planes(), [&](const Page& page) { return clipmap_->viewOf(page); });
        if (!keeps_) cache_.clear();
        const std::vector<Filling> fillings = cache_.place(pages_); // one, for all fit
        held_ = fillings.empty() ? Filling() : fillings.front();
        slots_.assign(clipmap_->entries(), 0);
        const int finest = clipmap_->windows().front().level;
        for (const HeldPage& held : held_) {
            const Page& page = pages_[held.number];
            const auto window = static_cast<std::size_t>(page.level - finest);
            slots_[clipmap_->entryOf(page.plane, window, page.at).value()] = static_cast<std::uint32_t>(held.slot) + 1;
        }
    }

    void draw(const Frame& frame) {
        if (std::ranges::all_of(held_, &HeldPage::kept)) return;
        const auto pass = frame.pass("depth map");
        const std::vector<glm::dvec3> corners = boundingCorners(frame.snapshot);
        for (const HeldPage& held : held_) {
            if (held.kept) continue;
            const LightView view = clipmap_->viewOf(pages_[held.number]);
            maps_.draw(held.slot, view, frame.scene, castersIn(view, corners));
        }
    }

    void test(const Frame& frame, const gl::Texture& visibility) {
        table_.upload(slots_.data(), slots_.size() * sizeof(std::uint32_t));
        table_.bindStorage(4);
        clipmap_->bindTo(test_);
        test_.set("positions", frame.gbuffer.position())
            .set("depths", maps_.texture())
            .set("texels", rule_.texels)
            .set("columns", maps_.columns());
        resolve(frame, {&visibility}, test_);
    }

    ClipmapRule rule_;
    bool keeps_;
    PageMaps maps_;
    PageCache cache_;
    StalePages stale_;
    gl::Buffer askedOfEntry_, table_;
    gl::Program marking_, test_;

    // Of the frame last rendered.
    std::optional<Clipmap> clipmap_;
    AskedPages asked_;
    std::vector<Page> pages_;
    Filling held_;
    std::vector<std::uint32_t> slots_; // by entry: 0, or 1 + the slot
};

} // namespace

Entry smClipmap() {
    std::vector<Parameter> parameters = {
        {"page", "128", IntegerRange{16, 256}, "texels per side of a page", "Epic, Frogfood"},
        {"extent", "4096", IntegerRange{64, 16384}, "texels per side of a level: 4 to 128 pages", "Frogfood; Epic: 16384"},
        {"levels", "16", IntegerRange{1, 16},
         "levels at most, each with texels twice as long as those of the next finer one", ""},
        {"density", "1", RealRange{0.125, 16}, "texels along a pixel, at least, where levels and pages suffice",
         "Epic: 2.83 (a bias of −1.5 levels)"},
        {"cache", "on", OneOf{{"on", "off"}}, "pages are kept from frame to frame, which changes no image", "Epic"},
    };
    for (Parameter& parameter : depthMapParameters(4096)) {
        if (parameter.name == "map") {
            parameter.meaning = "texels per side of the pool, which has (map / page)² pages";
            parameter.source = "Epic: 4,096 pages";
        }
        parameters.push_back(std::move(parameter));
    }
    return {.id = "sm-clipmap",
            .title = "Virtual shadow map in a clipmap, its pages cached",
            .source = {Document::Other, "Olsson et al. 2014; Epic's virtual shadow maps; Frogfood"},
            .answer = Answer::Hard,
            .computed =
                "pages of the map as they come into view, and again where light or casters have changed; the rest in "
                "each frame",
            .parameters = std::move(parameters),
            .contradiction = pagesWithoutRoom,
            .figures = {{"asked", "pages that pixels ask for"},
                        {"pages", "pages that the frame uses, at most (map / page)²"},
                        {"drawn", "pages drawn in the frame, one pass each; the others were kept"},
                        {"coarser", "share of pixels that are tested at a coarser level than they ask for, or not at all"}},
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<ClipmapShadows>(p); }};
}

} // namespace shadowbench::techniques
