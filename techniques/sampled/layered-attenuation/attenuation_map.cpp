#include "techniques/sampled/layered-attenuation/attenuation_map.h"

#include "techniques/gl/read_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

namespace shadowbench::techniques {
namespace {

constexpr std::size_t word = sizeof(std::uint32_t);

int wordsFor(int samples) { return (samples + 31) / 32; }

/// Of a layer: the next one, its key, its bits.
std::size_t fields(int samples) { return 2 + static_cast<std::size_t>(wordsFor(samples)); }

std::size_t texels(int side) { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); }

/// All depths into [−1, 0]: what rounds to the far plane is seen, too, and has layers.
const glm::dmat4 nearHalf =
    glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -0.5)) * glm::scale(glm::dmat4(1), glm::dvec3(1, 1, 0.5));

} // namespace

gl::Defines attenuationDefines(int samples) {
    return {{"SAMPLES", std::to_string(samples)}, {"WORDS", std::to_string(wordsFor(samples))}};
}

AttenuationMap::AttenuationMap(int side, int oversampling, int samples, double thickness)
    : side_(side), samples_(samples), thickness_(thickness), capacity_(3 * texels(side)), map_(side * oversampling, Bias{}),
      warp_(gl::Program::compute("sampled/layered-attenuation/warp.comp", attenuationDefines(samples))) {}

void AttenuationMap::build(const Frame& frame, const std::vector<glm::dvec3>& points) {
    view_ = fitToScene(frame.snapshot.light, frame.snapshot);
    warp(frame, points);
    while (layersAskedFor() > capacity_) {
        capacity_ = 2 * layersAskedFor();
        warp(frame, points);
    }
}

void AttenuationMap::clear() {
    heads_.clear(texels(side_) * word);
    layers_.clear((1 + capacity_ * fields(samples_)) * word);
}

void AttenuationMap::warp(const Frame& frame, const std::vector<glm::dvec3>& points) {
    clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
        LightView sample = fitFromSample(frame.snapshot.light, points[i], frame.snapshot);
        sample.clipFromWorld = nearHalf * sample.clipFromWorld;
        map_.draw(sample, frame);
        const auto pass = frame.pass("warped layers");
        bindTo(warp_);
        warp_.set("linearDepth", map_.texture())
            .set("mapFromTexel", glm::mat4(mapFromClip() * view_.clipFromWorld * worldFromTexel(sample)))
            .set("lightSample", static_cast<int>(i))
            .set("capacity", static_cast<int>(capacity_));
        warp_.dispatch(texels(map_.side()));
    }
}

void AttenuationMap::bindTo(gl::Program& program) const {
    const double texel = std::max(view_.span.x, view_.span.y) / side_; // at unit depth
    heads_.bindStorage(3);                                             // layers.glsl
    layers_.bindStorage(4);
    program.set("layerSide", side_).set("keysPerOctave", static_cast<float>(1 / std::log2(1 + thickness_ * texel)));
}

/// Those that there was no room for are counted too, and as often as they were asked for.
std::size_t AttenuationMap::layersAskedFor() const { return gl::readWords(layers_, 1).front(); }

std::vector<int> AttenuationMap::depths() const {
    const std::vector<std::uint32_t> heads = gl::readWords(heads_, texels(side_));
    const std::vector<std::uint32_t> layers = gl::readWords(layers_, 1 + capacity_ * fields(samples_));
    std::vector<int> result;
    for (std::uint32_t layer : heads) {
        int depth = 0;
        for (; layer != 0; layer = layers[1 + (layer - 1) * fields(samples_)]) ++depth;
        result.push_back(depth);
    }
    return result;
}

} // namespace shadowbench::techniques
