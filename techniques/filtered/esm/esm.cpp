// Exponential shadow maps (Annen, Mertens, Seidel, Flerackers, Kautz 2008; Scherzer 2.2.1): the test is exp(−c (d − z)), a
// product of one factor of the receiver and one of the occluder, which is stored and filtered in one channel. Right where
// nothing of the kernel is farther from the light than the receiver. Two failures are its authors': where an occluder is
// close before the receiver, by a few 1/c of the depth range, it is too transparent (contact), and where some of the kernel
// lies behind the receiver, the exponential of that depth outweighs all nearer ones. `beyond=pcf` is the paper's remedy for
// the second: where the test exceeds 1 by a tolerance, the kernel's depths are compared one by one (its threshold
// classification). Under three stacked casters it leaves 0.35 % leak of 1.21 %, as much as percentage-closer filtering, at
// 1.3 times the cost; the default is the one lookup alone, which is what the technique is known for. Departures of the
// remedy: the comparison follows the receiver's plane, since a slanted kernel exceeds 1 too, and kernels of more than 8
// texels are compared at every second, fourth … texel. For the rest (footprint, box, linear depth) see vsm.cpp.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/prefiltered_map.h"

namespace shadowbench::techniques {

namespace {

class Esm final : public Technique {
public:
    explicit Esm(const Parameters& p)
        : map_(p, {"filtered/esm/exponential.comp", {}, gl::Format::R32F, 1}), fallsBack_(p.text("beyond") == "pcf"),
          resolve_(
              gl::Program::screen("filtered/esm/esm.frag", fallsBack_ ? gl::Defines{{"PCF_BEYOND", "1"}} : gl::Defines{})) {
        const auto c = static_cast<float>(p.real("c"));
        map_.basis().set("c", c);
        resolve_.set("c", c);
        if (fallsBack_) resolve_.set("tolerance", static_cast<float>(p.real("tolerance")));
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        map_.draw(frame);
        map_.bindTo(resolve_, frame);
        if (fallsBack_) map_.bindDepthsTo(resolve_);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return map_.pointAt(world); }

private:
    PrefilteredMap map_;
    bool fallsBack_;
    gl::Program resolve_;
};

} // namespace

Entry esm() {
    std::vector<Parameter> parameters = prefilteredMapParameters();
    // exp(88) is the largest that 32-bit floats hold.
    parameters.push_back(
        {"c", "80", RealRange{1, 88}, "steepness of the exponential, per depth range", "Annen et al. 2008"});
    parameters.push_back({"beyond", "clamp", OneOf{{"clamp", "pcf"}},
                          "where the test exceeds 1: fully lit, or the kernel's depths compared one by one",
                          "Annen et al. 2008"});
    parameters.push_back(
        {"tolerance", "0.02", RealRange{0, 1}, "by which the test exceeds 1 (beyond=pcf)", "Annen et al. 2008"});
    return {.id = "esm",
            .title = "Exponential shadow map",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {"", "kernel=3"},
            .make = [](const Parameters& p) { return std::make_unique<Esm>(p); }};
}

} // namespace shadowbench::techniques
