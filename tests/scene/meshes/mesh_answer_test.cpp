// Meshes from a child that says what it likes: finite, with indices in range, or refused in one line.
#include "base/limits.h"
#include "scene/masked_mesh.h"
#include "scene/meshes/foreign_mesh.h"
#include "tests/support/hostile_answer.h"

#include <limits>
#include <map>

namespace shadowbench {
namespace {

using test::numbers;

template <typename T>
std::string bytesOf(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
}

std::string triangle(float z = 0, std::uint32_t last = 2) {
    return numbers({3, 1}) + bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, z}) + bytesOf<std::uint32_t>({0, 1, last});
}

/// One of two texels, behind the number of masks.
std::string mask(float alpha = 0.75F) {
    return numbers({1, 2, 1}) + bytesOf<float>({0.25F, alpha}) + bytesOf<double>({0.5}) + numbers({1, 0, 2});
}

/// A mesh, the number of its mask, and its cards.
std::string masked(float v = 1) { return triangle() + numbers({1}) + triangle(0.25F) + bytesOf<float>({0, 0, 1, 0, 0, v}); }

std::string refusal(const std::string& bytes, Mesh* mesh = nullptr) {
    return test::refusalOf(bytes, [&](ReaderChild& child) {
        Mesh received = receivedMesh(child);
        if (mesh != nullptr) *mesh = std::move(received);
    });
}

std::string refusalOfParts(const std::string& bytes, std::map<std::string, Mesh>* parts = nullptr) {
    return test::refusalOf(bytes, [&](ReaderChild& child) {
        auto received = receivedParts(child);
        if (parts != nullptr) *parts = std::move(received);
    });
}

TEST(MeshAnswer, IsTakenAsItIs) {
    Mesh mesh;
    EXPECT_EQ(refusal(numbers({1}) + triangle(0.5F), &mesh), "");
    EXPECT_EQ(mesh.positions.back(), glm::vec3(0, 1, 0.5F));
    EXPECT_EQ(mesh.triangles, std::vector<glm::uvec3>{glm::uvec3(0, 1, 2)});
    EXPECT_FALSE(mesh.closed);
    std::map<std::string, Mesh> parts;
    EXPECT_EQ(refusalOfParts(numbers({1}) + mask() + numbers({2, 1}) + "a" + triangle() + numbers({0, 1}) + "b" + masked(),
                             &parts),
              "");
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts["a"].cards, nullptr);
    const MaskedMesh& cards = *parts["b"].cards;
    EXPECT_EQ(cards.mesh.positions.back().z, 0.25F);
    EXPECT_EQ(cards.uv.back(), glm::vec2(0, 1));
    EXPECT_EQ(cards.mask->alpha[1], 0.75F);
    EXPECT_EQ(cards.mask->cutoff, 0.5);
    EXPECT_TRUE(cards.mask->nearest);
    EXPECT_EQ(cards.mask->v, AlphaMask::Wrap::Clamp);
}

TEST(MeshAnswer, ThatEndsAnywhereIsRefused) {
    const std::string whole = numbers({1}) + triangle(), parts = numbers({1}) + mask() + numbers({1, 1}) + "b" + masked();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_EQ(refusal(whole.substr(0, length)), "cannot read a.png: its answer ends too early") << length;
    for (std::size_t length = 0; length < parts.size(); ++length)
        EXPECT_EQ(refusalOfParts(parts.substr(0, length)), "cannot read a.png: its answer ends too early") << length;
}

TEST(MeshAnswer, WithAnIndexOutOfRangeOrANumberThatIsNoneIsRefused) {
    EXPECT_EQ(refusal(numbers({1}) + triangle(0, 3)), "cannot read a.png: a triangle uses position 3 of 3");
    EXPECT_EQ(refusal(numbers({1}) + triangle(0, ~0U)), "cannot read a.png: a triangle uses position 4294967295 of 3");
    for (const float z : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        EXPECT_EQ(refusal(numbers({1}) + triangle(z)), "cannot read a.png: position 2 is not finite");
    const float none = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [x, y] : {std::pair{none, 0.0F}, std::pair{0.0F, none}})
        EXPECT_EQ(refusal(numbers({1, 1, 0}) + bytesOf<float>({x, y, 0})), "cannot read a.png: position 0 is not finite");
    EXPECT_EQ(refusalOfParts(numbers({1}) + mask(none)), "cannot read a.png: a mask's number is not finite");
    EXPECT_EQ(refusalOfParts(numbers({1}) + mask() + numbers({1, 1}) + "b" + masked(none)),
              "cannot read a.png: a place in a texture is not finite");
}

TEST(MeshAnswer, BeyondABoundIsRefusedBeforeAnythingIsAllocated) {
    const std::uint64_t most = ~std::uint64_t{0};
    const std::uint64_t vertices = limitOf(Limit::Vertices), triangles = limitOf(Limit::Triangles),
                        pixels = limitOf(Limit::Pixels);
    for (const std::string& bytes : {numbers({1, most}), numbers({1, 0, most}), numbers({1, vertices + 1, 0}),
                                     numbers({1, 0, triangles + 1}), numbers({0, most}), numbers({7})})
        EXPECT_TRUE(refusal(bytes).starts_with("cannot read a.png: its reader's answer is malformed")) << refusal(bytes);
    for (const std::string& bytes :
         {numbers({1, most}), numbers({1, 0, most}), numbers({1, 0, 1, most}), numbers({1, 1, most, 1}),
          numbers({1, 1, 2, pixels}), numbers({1, 0, 1, 1}) + "a" + triangle() + numbers({1}), // there is no mask
          numbers({1, 2}) + mask().substr(sizeof(std::uint64_t)) + numbers({pixels - 1, 1}),
          numbers({1, 0, 2, 1}) + "a" + triangle() + numbers({0, 1}) + "b" +
              numbers({vertices - 2, 0})}) // together too many
        EXPECT_TRUE(refusalOfParts(bytes).starts_with("cannot read a.png: its reader's answer is malformed"));
}

} // namespace
} // namespace shadowbench
