#include "techniques/shared/maps/receiver_bounds.h"

#include "techniques/gl/read_buffer.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <string>

namespace shadowbench::techniques {
namespace {

constexpr int rowsEach = 64;            // pixels of an invocation
constexpr std::size_t wordsOfRange = 6; // shared/maps/receiver_bounds.comp

constexpr DepthRange allDepths{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};

gl::Program reduction(int ranges) {
    return gl::Program::compute("shared/maps/receiver_bounds.comp", {{"RANGES", std::to_string(ranges)}});
}

/// The float of which the shader's ordered() gives `code`.
double decoded(std::uint32_t code) {
    return std::bit_cast<float>(code ^ ((code & 0x80000000U) != 0 ? 0x80000000U : 0xffffffffU));
}

std::optional<Bounds> boxOf(std::span<const std::uint32_t> words) {
    if (words[0] == 0) return std::nullopt;
    Bounds box;
    box.add({decoded(words[0]), decoded(words[1]), decoded(words[2])});
    box.add({-decoded(words[3]), -decoded(words[4]), -decoded(words[5])});
    return box;
}

} // namespace

ReceiverBounds::ReceiverBounds(int ranges) : depthReduction_(reduction(1)), boxReduction_(reduction(ranges)) {}

std::optional<DepthRange> ReceiverBounds::depths(const Frame& frame, const glm::dvec4& eyeDepthFromWorld) {
    const glm::dmat4 depthAsZ =
        glm::transpose(glm::dmat4(glm::dvec4(0), glm::dvec4(0), eyeDepthFromWorld, glm::dvec4(0, 0, 0, 1)));
    const std::optional<Bounds> box = reduce(depthReduction_, frame, eyeDepthFromWorld, {allDepths}, depthAsZ).front();
    if (!box) return std::nullopt;
    return DepthRange{box->low.z, box->high.z};
}

std::vector<std::optional<Bounds>> ReceiverBounds::boxes(const Frame& frame, const glm::dvec4& eyeDepthFromWorld,
                                                         std::vector<DepthRange> ranges, const glm::dmat4& clipFromWorld) {
    ranges.front().near = allDepths.near;
    ranges.back().far = allDepths.far;
    return reduce(boxReduction_, frame, eyeDepthFromWorld, ranges, clipFromWorld);
}

std::vector<std::optional<Bounds>> ReceiverBounds::reduce(gl::Program& program, const Frame& frame,
                                                          const glm::dvec4& eyeDepthFromWorld,
                                                          const std::vector<DepthRange>& ranges,
                                                          const glm::dmat4& clipFromWorld) {
    const auto pass = frame.pass("receiver bounds");
    const int invocations = frame.size.x * ((frame.size.y + rowsEach - 1) / rowsEach);
    std::vector<glm::vec4> depths;
    for (const DepthRange& range : ranges) depths.emplace_back(range.near, range.far, 0, 0);
    extremes_.clear(ranges.size() * wordsOfRange * sizeof(std::uint32_t));
    extremes_.bindStorage(3); // shared/maps/receiver_bounds.comp
    program.set("positions", frame.gbuffer.position())
        .set("rowsEach", rowsEach)
        .set("eyeDepthFromWorld", glm::vec4(eyeDepthFromWorld))
        .set("ranges", depths)
        .set("clipFromWorld", glm::mat4(clipFromWorld));
    program.dispatch(static_cast<std::size_t>(invocations));

    const std::vector<std::uint32_t> words = gl::readWords(extremes_, ranges.size() * wordsOfRange);
    std::vector<std::optional<Bounds>> boxes;
    for (std::size_t i = 0; i < ranges.size(); ++i)
        boxes.push_back(boxOf(std::span(words).subspan(i * wordsOfRange, wordsOfRange)));
    return boxes;
}

} // namespace shadowbench::techniques
