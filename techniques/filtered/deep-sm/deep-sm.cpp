// Deep shadow maps (Lokovic and Veach 2000; Scherzer 2.2.1): every texel holds the share of light that passes each depth, a
// piecewise linear function averaged over many samples of the texel's area and compressed within an error bound. Geometry
// much thinner than a texel is filtered as it is drawn, and at every depth on its own: good for fences and foliage. The
// price is the build: samples² the fragments of a shadow map, and a function to sort and compress for each texel on the CPU,
// as in the paper. Departures: all surfaces are opaque, so that a sample's own function is a single step; the samples are
// the centres of a regular grid (a finer depth map), where the paper jitters them; a texel's filter is its own area, and the
// lookup interpolates four texels, where the paper also offers wider filters and mipmaps; with bias=slope samples are offset
// by slopes of whole texels and texels are read at the depth of the receiver's plane, else a texel's samples shade the
// surface they lie on; in the compression the last segment ends as close to the true function as its error window allows,
// where the paper takes the middle of the window for all: what is fully shadowed stays dark.
#include "techniques/contract/entry.h"
#include "techniques/contract/resolve.h"
#include "techniques/filtered/deep-sm/deep_texture.h"
#include "techniques/gl/api.h"
#include "techniques/shared/maps/single_map.h"

namespace shadowbench::techniques {
namespace {

/// A slope per texel is as many slopes per texel of the sampled map as a texel has samples.
Bias textureBias(const Parameters& p) {
    Bias bias = biasFrom(p);
    bias.factor *= static_cast<float>(p.integer("samples"));
    return bias;
}

class DeepSm final : public Technique {
public:
    explicit DeepSm(const Parameters& p)
        : side_(p.integer("map")), samples_(p.integer("samples")), error_(static_cast<float>(p.real("error"))),
          followPlane_(p.text("bias") == "slope"),
          depths_(side_ * samples_, textureBias(p), Lookup::Raw), readBack_{&depths_.texture()},
          resolve_(gl::Program::screen("filtered/deep-sm/deep-sm.frag")) {}

    void render(const Frame& frame, const gl::Texture& visibility) override {
        light_ = uniformView(frame);
        depths_.draw(light_, frame);
        build(frame);
        resolve_.set("positions", frame.gbuffer.position())
            .set("normals", frame.gbuffer.normal())
            .set("mapFromWorld", mapFromWorld(light_))
            .set("side", side_)
            .set("followPlane", followPlane_ ? 1.0F : 0.0F);
        resolve(frame, {&visibility}, resolve_);
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        return texelAt(light_, world, glm::dvec2(side_));
    }

private:
    void build(const Frame& frame) {
        const auto pass = frame.pass("deep texture");
        buildDeepTexture(readBack_.readDepth(), samples_, error_, deep_);
        upload();
    }

    void upload() {
        if (deep_.nodes.empty()) deep_.nodes.push_back({1, 1}); // a buffer must not be empty; no texel refers to it
        firsts_.upload(deep_.first.data(), deep_.first.size() * sizeof(deep_.first.front()));
        nodes_.upload(deep_.nodes.data(), deep_.nodes.size() * sizeof(deep_.nodes.front()));
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, firsts_.id());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, nodes_.id());
    }

    int side_, samples_;
    float error_;
    bool followPlane_;
    LightView light_;
    DepthMap depths_;
    gl::RenderTarget readBack_;
    DeepTexture deep_;
    gl::Buffer firsts_, nodes_;
    gl::Program resolve_;
};

} // namespace

Entry deepSm() {
    std::vector<Parameter> parameters = depthMapParameters();
    parameters.front().domain = IntegerRange{16, 1024}; // eight times as many depths per side are drawn at most
    parameters.insert(parameters.begin() + 1,
                      {{"samples", "4", OneOf{{"1", "2", "4", "8"}}, "per side of a texel", ""},
                       {"error", "0.04", RealRange{0, 0.5}, "of the compressed transmittance", "Lokovic and Veach 2000"}});
    return {.id = "deep-sm",
            .title = "Deep shadow map",
            .source = {Document::Dissertation, "2.2.1"},
            .answer = Answer::Filtered,
            .parameters = std::move(parameters),
            .variants = {""},
            .make = [](const Parameters& p) { return std::make_unique<DeepSm>(p); }};
}

} // namespace shadowbench::techniques
