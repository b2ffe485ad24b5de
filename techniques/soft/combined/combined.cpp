// Combined shadow map method (Zápotocký 4.4.3): percentage-closer soft shadows with jittered taps.
// 1. blocker search with 16 jittered taps  2. penumbra width from similar triangles (eq. 3.3)  3. the share of 32 jittered
// taps over that width that pass: the 8 of the outermost ring first, and where they disagree all others.
// A rectangular light stretches the disk that the taps fill by its own width along each side (4.4.1, which interpolates
// between the two by an angle; here map and light are parallel). With `depth=midpoint` (his /m/) the map holds the mean of
// first and second surface, drawn without a bias. Departures: as for `pcss`, the search window is the light's
// own projection on the map's near plane, where the thesis scales an empirical offset; hence the search has taps of its own
// over all of the window, where the thesis takes the innermost 16 of the filter's; with bias=slope every tap is compared
// with the receiver's plane. As the source admits for `pcss`, blockers of different depths are fused into one of their mean;
// and where the outermost ring sees nothing of a small caster, neither does the pixel.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/jitter_table.h"
#include "techniques/shared/filters/pcss_program.h"
#include "techniques/shared/maps/stored_depth.h"

#include <memory>
#include <optional>
#include <string>

namespace shadowbench::techniques {
namespace {

constexpr JitterGrid searchGrid{4, 4}, filterGrid{8, 4};

gl::Defines tapDefines() {
    gl::Defines defines = JitterTable::defines();
    defines.emplace_back("SEARCH_TAPS", std::to_string(searchGrid.taps()));
    defines.emplace_back("FIRST_TAPS", std::to_string(filterGrid.sectors));
    defines.emplace_back("FILTER_TAPS", std::to_string(filterGrid.taps()));
    return defines;
}

class Combined final : public Technique {
public:
    explicit Combined(const Parameters& p)
        : followPlane_(p.text("bias") == "slope"), filter_(filterGrid), search_(searchGrid, jitterBlock * jitterBlock),
          map_(storedLinearisedMap(p)), resolve_(gl::Program::screen("soft/combined/combined.frag", tapDefines())) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        view_ = fitToScene(frame.snapshot.light, frame.snapshot);
        map_.draw(view_, frame);
        setBlockerSearch(resolve_, frame.snapshot.light, view_, map_, followPlane_);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("searchJitter", search_.texture())
            .set("filterJitter", filter_.texture())
            .set("jitterOrigin", JitterTable::origin(frame.seed));
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(view_, world, glm::dvec2(map_.side()));
    }

private:
    bool followPlane_;
    JitterTable filter_, search_;
    LightView view_;
    LinearisedMap map_;
    gl::Program resolve_;
};

} // namespace

Entry combined() {
    return {.id = "combined",
            .title = "Percentage-closer soft shadows with jittered taps",
            .source = {Document::Zapotocky, "4.4.3, 4.4.1"},
            .answer = Answer::Soft,
            .parameters = withDepthMapParameters({storedDepthParameter()}),
            .variants = {"", "depth=midpoint"},
            .make = [](const Parameters& p) { return std::make_unique<Combined>(p); }};
}

} // namespace shadowbench::techniques
