// Layered variance shadow maps (Lauritzen and McCool 2008; Scherzer 2.2.1): the depth range is cut into layers, each with
// moments of its own in which all nearer depths are the same; a receiver is tested in the one layer that it lies in.
// Occluders of nearer layers then have no variance among them, and their edges do not leak. What is left is the leak of
// occluders that share the receiver's layer. Layers overlap: a receiver has room to occluders that its layer clamps to 0,
// and what its kernel holds behind it is not yet clamped to 1. Departures: layers have equal thickness, where the paper also
// places them by Lloyd's algorithm over the depths of the image; 32-bit floats, where the paper's layers need fewer bits,
// and two layers in each texture;
// for the rest see vsm.cpp.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/prefiltered_map.h"
#include "techniques/filtered/vsm/vsm.h"

namespace shadowbench::techniques {

namespace {

class Lvsm final : public Technique {
public:
    explicit Lvsm(const Parameters& p)
        : map_(p, basis(p)), resolve_(gl::Program::screen("filtered/lvsm/lvsm.frag", defines(p))) {
        const auto overlap = static_cast<float>(p.real("overlap"));
        if (map_.basis().uses("overlap")) map_.basis().set("overlap", overlap); // not with one layer
        resolve_.set("overlap", overlap).set("leastVariance", static_cast<float>(p.real("variance")));
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        map_.draw(frame);
        map_.bindTo(resolve_, frame);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override { return map_.pointAt(world); }

private:
    /// Two layers in each texture of four numbers.
    static Basis basis(const Parameters& p) {
        const int layers = p.integer("layers");
        const gl::Format format = layers == 1 ? gl::Format::RG32F : gl::Format::RGBA32F;
        return {"filtered/lvsm/moments.comp", defines(p), format, (layers + 1) / 2};
    }

    static gl::Defines defines(const Parameters& p) { return {{"LAYERS", p.text("layers")}}; }

    PrefilteredMap map_;
    gl::Program resolve_;
};

} // namespace

Entry lvsm() {
    std::vector<Parameter> parameters = prefilteredMapParameters();
    parameters.push_back({"layers", "4", IntegerRange{1, 16}, "of equal thickness over the depth range", ""});
    parameters.push_back(
        {"overlap", "0.2", RealRange{0, 1}, "of a thickness, by which layers reach into their neighbours", ""});
    parameters.push_back(leastVarianceParameter());
    return {.id = "lvsm",
            .title = "Layered variance shadow map",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {"", "kernel=3"},
            .make = [](const Parameters& p) { return std::make_unique<Lvsm>(p); }};
}

} // namespace shadowbench::techniques
