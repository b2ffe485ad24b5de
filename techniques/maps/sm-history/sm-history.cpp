// Pixel-correct shadow maps (Scherzer, Jeschke, Wimmer 2007): a history buffer per pixel, reprojected each frame (eq. 3.4)
// where depths agree (eq. 3.5), takes in the test result of a newly jittered shadow map with a weight that grows with the
// confidence of the sample (eq. 3.6, 3.7). EGSR paper; dissertation chapter 3 and listing 6.1. Departures: the reprojected
// position comes from the world position in the G-buffer (and, for moving receivers, last frame's), which is the same point
// as eq. 3.4's product of matrices; the depth tolerance is the listing's 0.001 in window depth.
#include "techniques/maps/sm-history/sm-history.h"

#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/shared/maps/normal_offset.h"
#include "techniques/shared/maps/single_map.h"
#include "techniques/shared/sampling/sampling.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <optional>

namespace shadowbench::techniques {

double MSchedule::next(bool moved) {
    if (moved)
        m_ = start_;
    else if (!first_)
        m_ += step_;
    first_ = false;
    return m_;
}

namespace {

FitView viewOf(const std::string& base) {
    if (base == "uniform") return uniformView;
    return base == "focused" ? focusedView : lispsmView;
}

gl::Defines definesOf(Bias bias, bool filtered) {
    gl::Defines defines = normalOffsetDefines(bias);
    defines.emplace_back("KERNEL", filtered ? "3" : "1");
    return defines;
}

class History final : public Technique {
public:
    explicit History(const Parameters& p)
        : fit_(viewOf(p.text("base"))), jitter_(p.text("jitter")), filtered_(p.text("filter") == "pcf"),
          followPlane_(followsPlane(p)), bias_(biasFrom(p)), map_(p.integer("map"), bias_, Lookup::Compare),
          schedule_(p.real("m"), p.real("step")),
          resolve_(gl::Program::screen("maps/sm-history/sm-history.frag", definesOf(bias_, filtered_))) {}

    void reset() override {
        history_.reset();
        schedule_.reset();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        const bool fresh = !history_ || history_->read.size() != frame.size;
        if (fresh) history_.emplace(frame.size);

        light_ = rasterisedAnew(fit_(frame), frame);
        map_.draw(light_, frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("previousPositions", frame.gbuffer.previousPosition())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("depthMap", map_.texture())
            .set("history", history_->read)
            .set("clipFromWorld", glm::mat4(frame.clipFromWorld))
            .set("previousClipFromWorld", glm::mat4(frame.previousClipFromWorld))
            .set("m", static_cast<float>(schedule_.next(frame.cameraMoved())))
            .set("hasHistory", fresh ? 0 : 1);
        setNormalOffset(resolve_, frame, bias_, map_.texture().size());
        if (filtered_) resolve_.set("normals", frame.gbuffer.normal()).set("followPlane", followPlane_ ? 1.0F : 0.0F);
        resolve(frame, {&visibility, &history_->write}, resolve_, "temporal resolve");
        std::swap(history_->read, history_->write);
    }

    [[nodiscard]] std::map<std::string, double> figures(const Frame& frame) const override {
        const double pixels = static_cast<double>(frame.size.x) * frame.size.y;
        return {{"history_bytes", static_cast<double>(history_->read.bytes() + history_->write.bytes()) / pixels}};
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, glm::dvec2(map_.side()));
    }

private:
    /// Smoothed visibility and window depth, 16-bit floats, double-buffered.
    struct Buffers {
        explicit Buffers(glm::ivec2 size)
            : read(gl::Format::RG16F, size, gl::Filter::Linear), write(gl::Format::RG16F, size, gl::Filter::Linear) {}
        gl::Texture read, write;
    };

    /// Section 3.3: a new rasterisation each frame by Halton translation within a texel and rotation of the projection
    /// window.
    [[nodiscard]] LightView rasterisedAnew(const LightView& view, const Frame& frame) const {
        if (jitter_ == "none") return view;
        const auto number = [&](std::uint32_t base) { return haltonOf(frame.index, frame.seed, base); };
        const double angle = jitter_ == "translation" ? 0 : glm::two_pi<double>() * number(5);
        return jittered(view, angle, {number(2) - 0.5, number(3) - 0.5}, map_.side());
    }

    FitView fit_;
    std::string jitter_;
    bool filtered_, followPlane_;
    Bias bias_;
    LightView light_;
    DepthMap map_;
    MSchedule schedule_;
    gl::Program resolve_;
    std::optional<Buffers> history_;
};

} // namespace

Entry smHistory() {
    std::vector<Parameter> parameters = withNormalOffset(withDepthMapParameters({
        {"base", "lispsm", OneOf{{"uniform", "focused", "lispsm"}}, "how the map under the history is fitted",
         "EGSR paper, 4"},
        {"filter", "none", OneOf{{"none", "pcf"}}, "of each frame's test: none or PCF 3×3", "EGSR paper, Fig. 6"},
        {"m", "3", RealRange{0, 64}, "exponent of the confidence while the camera moves", "EGSR paper, 3.3"},
        {"step", "0.1", RealRange{0, 16}, "added to m for each frame that the camera stands still", "EGSR paper, 4"},
        {"jitter", "rotation", OneOf{{"none", "translation", "rotation"}}, "none, Halton translation, or with rotation too",
         "EGSR paper, 3.3"},
    }));
    return {.id = "sm-history",
            .title = "Pixel-correct shadow map with history",
            .source = {Document::PixelCorrectPaper, "3, listing 6.1 of the dissertation"},
            .answer = Answer::Hard,
            .temporal = true,
            .lacks = {Need::MovingLight, Need::MovingCasters},
            .parameters = std::move(parameters),
            .figures = {{"history_bytes", "bytes of history and depth for a pixel of the image, both buffers"}},
            .variants = {"", "m=15,step=0", "base=uniform", "base=focused", "filter=pcf"},
            .costBase = [](const Parameters& p) { return "sm-" + p.text("base") + ":map=" + p.text("map"); },
            .make = [](const Parameters& p) { return std::make_unique<History>(p); }};
}

} // namespace shadowbench::techniques
