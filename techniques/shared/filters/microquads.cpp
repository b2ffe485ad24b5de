#include "techniques/shared/filters/microquads.h"

#include "techniques/contract/resolve.h"
#include "techniques/shared/sampling/light_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

int samplesPerSide(const Parameters& p) { return static_cast<int>(std::lround(std::sqrt(std::stoi(p.text("samples"))))); }

} // namespace

std::vector<Parameter> microquadParameters() {
    return {
        {"window", "8", OneOf{{"8", "12", "all"}},
         "microquads per side of the search area, at most, of squares of texels if need be; all: every texel's, of an area "
         "wider than 192 every second texel's, or every fourth, …",
         "dissertation, Fig. 4.3"},
        {"samples", "64", OneOf{{"16", "64", "256"}}, "points of the light", "dissertation, 2.3.4"},
        {"bits", "64", OneOf{{"64", "256"}}, "of the field that holds the samples, one each", "dissertation, 2.3.4"},
        flatParameter()};
}

std::optional<std::string> moreSamplesThanBits(const Parameters& p) {
    const int samples = std::stoi(p.text("samples")), bits = std::stoi(p.text("bits"));
    if (samples <= bits) return std::nullopt;
    return fmt::format("{} samples do not fit into {} bits, one each: choose bits={}", samples, bits, samples);
}

NodeEnds nodeEnds(const Parameters& p) { return p.text("window") == "all" ? NodeEnds::Shared : NodeEnds::Apart; }

std::optional<std::string> lightWithoutSurface(const Scene& scene) {
    if (scene.light.kind != LightKind::Line) return std::nullopt;
    return fmt::format("samples the surface of a light; the light of {} is a line", scene.id);
}

Microquads::Microquads(const Parameters& p, int layers)
    : window_(p.text("window")), side_(samplesPerSide(p)), bits_(std::stoi(p.text("bits"))), layers_(layers),
      followPlane_(p.text("bias") == "slope"), flatness_(static_cast<float>(p.real("flat"))), resolve_(program({})) {}

gl::Program Microquads::program(gl::Defines defines) const {
    defines.emplace_back("SAMPLES", std::to_string(side_));
    defines.emplace_back("WORDS", std::to_string(bits_ / 32));
    defines.emplace_back("LAYERS", std::to_string(layers_));
    if (window_ != "all") defines.emplace_back("WINDOW", window_);
    return gl::Program::screen("shared/filters/microquads.frag", defines);
}

std::vector<std::uint32_t> Microquads::hiddenAtFirst(const Light& light) const {
    std::vector<std::uint32_t> words(static_cast<std::size_t>(bits_) / 32, 0);
    if (light.kind == LightKind::Disk) std::ranges::copy(samplesOutsideDisk(side_), words.begin());
    for (int bit = side_ * side_; bit < bits_; ++bit) words[static_cast<std::size_t>(bit) / 32] |= 1U << (bit % 32);
    return words;
}

void Microquads::set(gl::Program& program, const Frame& frame, const LightView& view, const gl::Texture& depths,
                     const MinMaxPyramid& pyramid) const {
    setBackProjection(program, frame, view, pyramid, followPlane_);
    program.set("linearDepth", depths);
    if (window_ == "all") program.set("flatness", flatness_);
    outside_.bindStorage(5); // shared/filters/microquads.frag
}

void Microquads::resolve(const Frame& frame, const LightView& view, const gl::Texture& depths, const MinMaxPyramid& pyramid,
                         const gl::Texture& visibility) {
    const std::vector<std::uint32_t> hidden = hiddenAtFirst(frame.snapshot.light);
    int samples = bits_;
    for (const std::uint32_t word : hidden) samples -= std::popcount(word);
    outside_.upload(hidden.data(), hidden.size() * sizeof(std::uint32_t));
    set(resolve_, frame, view, depths, pyramid);
    resolve_.set("sampleCount", static_cast<float>(samples));
    techniques::resolve(frame, {&visibility}, resolve_);
}

double Microquads::quadsOf(const Frame& frame, const LightView& view, const gl::Texture& depths,
                           const MinMaxPyramid& pyramid) const {
    gl::Program counting = program({{"COUNT_QUADS", "1"}});
    set(counting, frame, view, depths, pyramid);
    return meanOverReceivers(frame, counting);
}

} // namespace shadowbench::techniques
