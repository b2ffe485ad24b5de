// Jittered percentage-closer filtering (Uralsky 2005; Zápotocký 3.4): the share of a disk's shadow tests that pass. The disk
// is cut into cells of equal area with one tap at random in each (eq. 3.1–3.2), from a table of sets that neighbouring
// pixels do not share, so that what is left of the error is noise instead of bands.
// 1. the 8 taps of the disk's outermost ring  2. where they disagree, all others.
// Departures: the source leaves the disk's size open (here as for `pcf-poisson`, texels around the receiver); as for `pcf`,
// with a bias that follows slopes each tap is compared with the depth of the receiver's plane at the tap. As the source
// admits, the penumbra is as wide wherever the occluder is; and where the outermost ring sees nothing of a small caster,
// neither does the pixel.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/jitter_table.h"
#include "techniques/shared/maps/normal_offset.h"
#include "techniques/shared/maps/single_map.h"
#include "techniques/shared/maps/stored_depth.h"

#include <memory>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr int sectors = 8; // of each ring: the outermost holds the taps that are tried first

gl::Defines definesFor(const JitterGrid& grid, Bias bias) {
    gl::Defines defines = JitterTable::defines();
    for (auto& define : normalOffsetDefines(bias)) defines.push_back(std::move(define));
    defines.emplace_back("FIRST_TAPS", std::to_string(grid.sectors));
    defines.emplace_back("TAPS", std::to_string(grid.taps()));
    return defines;
}

class PcfJitter final : public Technique {
public:
    explicit PcfJitter(const Parameters& p)
        : grid_{sectors, p.integer("taps") / sectors}, radius_(static_cast<float>(p.real("radius"))),
          followPlane_(followsPlane(p)), bias_(biasFrom(p)), table_(grid_), map_(storedDepthMap(p, Lookup::Compare)),
          resolve_(gl::Program::screen("filtered/pcf-jitter/pcf-jitter.frag", definesFor(grid_, bias_))) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        map_->draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_->texture())
            .set("followPlane", followPlane_ ? 1.0F : 0.0F)
            .set("jitter", table_.texture())
            .set("jitterOrigin", JitterTable::origin(frame.seed))
            .set("radius", radius_);
        setNormalOffset(resolve_, frame, bias_, map_->texture().size());
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, map_->texture().size());
    }

private:
    JitterGrid grid_;
    float radius_;
    bool followPlane_;
    Bias bias_;
    JitterTable table_;
    LightView light_;
    std::unique_ptr<ShadowMap> map_;
    gl::Program resolve_;
};

} // namespace

Entry pcfJitter() {
    std::vector<Parameter> parameters = withNormalOffset(withDepthMapParameters({
        {"taps", "64", OneOf{{"16", "32", "48", "64"}}, "taps of the disk, 8 of which are tried first", "Zápotocký 3.4"},
        {"radius", "3.5", RealRange{0.5, 32}, "of the disk in texels; 3.5 reaches as far as pcf:kernel=7", ""},
        storedDepthParameter(),
    }));
    return {.id = "pcf-jitter",
            .title = "Jittered percentage-closer filtering",
            .source = {Document::Zapotocky, "3.4, eq. 3.1–3.2"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<PcfJitter>(p); }};
}

} // namespace shadowbench::techniques
