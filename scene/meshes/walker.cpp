#include "scene/meshes/walker.h"

#include "scene/meshes/solids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench {
namespace {

enum Bone {
    Pelvis,
    Chest,
    LeftUpperArm,
    RightUpperArm,
    LeftForearm,
    RightForearm,
    LeftThigh,
    RightThigh,
    LeftShin,
    RightShin
};
constexpr std::size_t boneCount = 10;

// Joints at rest, metres; x of the left side.
constexpr glm::dvec3 waist{0, 1.07, 0}, shoulder{0.215, 1.41, 0}, elbow{0.245, 1.13, -0.01}, wrist{0.26, 0.84, 0.01},
    hip{0.095, 0.93, 0}, knee{0.1, 0.5, 0.012}, ankle{0.103, 0.085, -0.01};

/// A capsule from joint to joint whose upper half follows one bone and whose lower half another one.
struct Limb {
    glm::dvec3 from, to;
    double radiusFrom, radiusTo;
    int upper, lower;
    double joint = 0.5; // share of the way at which the one bone takes over from the other
    double blend = 0.2; // share of the way over which it does
};

glm::dvec3 mirrored(const glm::dvec3& p) { return {-p.x, p.y, p.z}; }

Limb mirrored(Limb limb) {
    limb.from = mirrored(limb.from);
    limb.to = mirrored(limb.to);
    ++limb.upper; // the right bone follows the left one
    ++limb.lower;
    return limb;
}

/// `rings` ≥ 3 rings: the first and the last close the round ends.
SkinnedMesh capsule(const Limb& limb, int sides, int rings) {
    const double length = glm::distance(limb.from, limb.to), round = std::sqrt(0.5);
    std::vector<glm::dvec2> profile{{round * limb.radiusFrom, -round * limb.radiusFrom}};
    for (int i = 0; i < rings - 2; ++i) {
        const double share = rings == 3 ? 0.5 : static_cast<double>(i) / (rings - 3);
        profile.emplace_back(std::lerp(limb.radiusFrom, limb.radiusTo, share), share * length);
    }
    profile.emplace_back(round * limb.radiusTo, length + round * limb.radiusTo);
    const Mesh along = revolved(-limb.radiusFrom, profile, length + limb.radiusTo, sides);

    const glm::dvec3 y = (limb.to - limb.from) / length;
    const glm::dvec3 x = glm::normalize(glm::cross(y, std::abs(y.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
    SkinnedMesh result;
    result.mesh.closed = true;
    append(result.mesh, along,
           {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(glm::cross(x, y), 0), glm::dvec4(limb.from, 1)});
    for (const glm::vec3& position : along.positions) {
        const double lower = std::clamp((position.y / length - limb.joint) / limb.blend + 0.5, 0.0, 1.0);
        result.weights.push_back({{limb.upper, limb.lower}, {1 - lower, lower}});
    }
    return result;
}

void append(SkinnedMesh& whole, const SkinnedMesh& part) {
    append(whole.mesh, part.mesh);
    whole.weights.insert(whole.weights.end(), part.weights.begin(), part.weights.end());
}

SkinnedMesh withSides(int sides) {
    const Limb torso{{0, 0.93, 0}, {0, 1.37, 0}, 0.145, 0.165, Pelvis, Chest, 0.35, 0.5},
        neck{{0, 1.41, 0.005}, {0, 1.645, 0.02}, 0.055, 0.1, Chest, Chest},
        arm{shoulder, wrist, 0.058, 0.036, LeftUpperArm, LeftForearm}, leg{hip, ankle, 0.088, 0.05, LeftThigh, LeftShin},
        foot{{0.103, 0.036, -0.04}, {0.108, 0.03, 0.14}, 0.046, 0.04, LeftShin, LeftShin};
    const int few = std::max(3, sides / 2);
    SkinnedMesh whole;
    whole.mesh.closed = true;
    append(whole, capsule(torso, 2 * sides, sides));
    append(whole, capsule(neck, sides, few));
    for (const Limb& left : {arm, leg, foot}) {
        const int rings = left.upper == left.lower ? few : sides + 2;
        append(whole, capsule(left, sides, rings));
        append(whole, capsule(mirrored(left), sides, rings));
    }
    return whole;
}

/// A turn of `degrees` about an axis through `joint` along x: forwards where above 0, of what hangs down.
glm::dmat4 swung(const glm::dvec3& joint, double degrees) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(-degrees), glm::dvec3(1, 0, 0));
    return glm::translate(glm::dmat4(1), joint) * turn * glm::translate(glm::dmat4(1), -joint);
}

glm::dmat4 twisted(double degrees) { return glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0)); }

/// One side's leg: thigh and shin, at a phase (radians) at 0 of which the thigh passes the other one forwards.
std::array<glm::dmat4, 2> legBones(double phase, const glm::dvec3& hipJoint, const glm::dvec3& kneeJoint) {
    const glm::dmat4 thigh = swung(hipJoint, 28 * std::sin(phase) + 6);
    const double bent = std::max(0.0, std::cos(phase + 0.3)); // while it swings forwards
    return {thigh, thigh * swung(kneeJoint, -8 - 52 * bent * bent)};
}

std::array<glm::dmat4, 2> armBones(double phase, const glm::dvec3& shoulderJoint, const glm::dvec3& elbowJoint) {
    const glm::dmat4 upper = swung(shoulderJoint, 26 * std::sin(phase));
    return {upper, upper * swung(elbowJoint, 28 + 16 * std::sin(phase))};
}

} // namespace

SkinnedMesh walkerAtRest(int triangles) {
    constexpr int least = 4;
    SkinnedMesh result = withSides(least);
    for (int sides = least + 1;; ++sides) {
        SkinnedMesh finer = withSides(sides);
        if (finer.mesh.triangles.size() > static_cast<std::size_t>(std::max(0, triangles))) return result;
        result = std::move(finer);
    }
}

std::vector<glm::dmat4> walkerBones(double share) {
    const double phase = glm::two_pi<double>() * share, other = phase + glm::pi<double>();
    std::vector<glm::dmat4> bones(boneCount, glm::dmat4(1));
    bones[Pelvis] = twisted(-5 * std::sin(phase));
    bones[Chest] = glm::translate(glm::dmat4(1), waist) * twisted(9 * std::sin(phase)) * swung({0, 0, 0}, -3) *
                   glm::translate(glm::dmat4(1), -waist);
    const auto set = [&](int first, int second, const glm::dmat4& parent, const std::array<glm::dmat4, 2>& limb) {
        bones[static_cast<std::size_t>(first)] = parent * limb[0];
        bones[static_cast<std::size_t>(second)] = parent * limb[1];
    };
    set(LeftThigh, LeftShin, bones[Pelvis], legBones(phase, hip, knee));
    set(RightThigh, RightShin, bones[Pelvis], legBones(other, mirrored(hip), mirrored(knee)));
    set(LeftUpperArm, LeftForearm, bones[Chest], armBones(other, shoulder, elbow));
    set(RightUpperArm, RightForearm, bones[Chest], armBones(phase, mirrored(shoulder), mirrored(elbow)));

    double lowest = 1;
    for (const auto& [shin, side] : {std::pair(LeftShin, 1.0), std::pair(RightShin, -1.0)})
        for (const double z : {-0.04, 0.14}) {
            const glm::dvec4 sole(side * 0.105, -0.01, z, 1);
            lowest = std::min(lowest, (bones[static_cast<std::size_t>(shin)] * sole).y);
        }
    const glm::dmat4 stand = glm::translate(glm::dmat4(1), glm::dvec3(0, -0.01 - lowest, 0));
    for (glm::dmat4& bone : bones) bone = stand * bone;
    return bones;
}

Mesh walker(int triangles, int pose, int poses) {
    return posed(walkerAtRest(triangles), walkerBones(static_cast<double>(pose) / poses));
}

} // namespace shadowbench
