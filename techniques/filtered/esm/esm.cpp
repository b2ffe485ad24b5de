// Exponential shadow maps (Annen, Mertens, Seidel, Flerackers, Kautz 2008; Scherzer 2.2.1): the test is exp(−c (d − z)), a
// product of one factor of the receiver and one of the occluder, which is stored and filtered in one channel. Right where
// nothing of the kernel is farther from the light than the receiver. Two failures are its authors': where an occluder is
// close before the receiver, by a few 1/c of the depth range, it is too transparent (contact), and where some of the kernel
// lies behind the receiver, the exponential of that depth outweighs all nearer ones. Departures: the second case is clamped
// to fully lit, where the paper falls back on percentage-closer filtering; for the rest (footprint, box, linear depth) see
// vsm.cpp.
#include "techniques/filtered/esm/esm.h"

#include "techniques/entries.h"
#include "techniques/filtered/prefiltered_map.h"
#include "techniques/resolve.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::techniques {

double exponentialTest(double depth, double meanExponential, double c) {
    return std::min(std::exp(-c * depth) * meanExponential, 1.0);
}

double exponentialReach(double visibility, double c) { return -std::log(visibility) / c; }

namespace {

class Esm final : public Technique {
public:
    explicit Esm(const Parameters& p)
        : map_(p, {"filtered/esm/exponential.frag", {}, gl::Format::R32F, 1}),
          resolve_(gl::Program::screen("filtered/esm/esm.frag")) {
        const auto c = static_cast<float>(p.real("c"));
        map_.basis().set("c", c);
        resolve_.set("c", c);
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        map_.draw(frame);
        map_.bindTo(resolve_, frame);
        resolveInto({&visibility}, resolve_);
    }

private:
    PrefilteredMap map_;
    gl::Program resolve_;
};

} // namespace

Entry esm() {
    std::vector<Parameter> parameters = prefilteredMapParameters();
    // exp(88) is the largest that 32-bit floats hold.
    parameters.push_back(
        {"c", "80", RealRange{1, 88}, "steepness of the exponential, per depth range", "Annen et al. 2008"});
    return {.id = "esm",
            .title = "Exponential shadow map",
            .source = {Seed::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<Esm>(p); }};
}

} // namespace shadowbench::techniques
