#include "techniques/environment/occlusion_rays.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

namespace shadowbench::techniques {
namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

constexpr std::size_t packet = 8;
constexpr float infinity = std::numeric_limits<float>::infinity();

void addGeometry(RTCDevice device, RTCScene scene, const Mesh& mesh, const glm::dmat4& world) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                      sizeof(glm::vec3), mesh.positions.size()));
    std::ranges::transform(mesh.positions, positions, [&](const glm::vec3& position) {
        return glm::vec3(world * glm::dvec4(glm::dvec3(position), 1));
    });
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                       sizeof(glm::uvec3), mesh.triangles.size()));
    std::ranges::copy(mesh.triangles, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

/// Which way a geometry's triangles look: 1 outward, −1 inward (mirrored), 0 neither (open).
float outwardOf(const Mesh& mesh, const glm::dmat4& world) {
    if (!mesh.closed) return 0;
    return glm::determinant(glm::dmat3(world)) < 0 ? -1.0F : 1.0F;
}

/// Eight rays from one point.
struct alignas(32) Packet {
    RTCRay8 rays{};
    std::array<int, packet> valid{}; // −1: to be traced

    void begin(const glm::vec3& from) {
        for (std::size_t lane = 0; lane < packet; ++lane) {
            rays.org_x[lane] = from.x;
            rays.org_y[lane] = from.y;
            rays.org_z[lane] = from.z;
            rays.mask[lane] = ~0U;
        }
    }

    void aim(std::size_t lane, const glm::vec3& direction, bool traced) {
        rays.dir_x[lane] = direction.x;
        rays.dir_y[lane] = direction.y;
        rays.dir_z[lane] = direction.z;
        rays.tnear[lane] = 0;
        rays.tfar[lane] = infinity;
        valid.at(lane) = traced ? -1 : 0;
    }
};

} // namespace

struct OcclusionRays::Scene {
    Device device;
    SceneHandle scene;
    std::vector<float> outward; // by geometry
    double lift = 0;            // metres that rays begin above their surface

    [[nodiscard]] glm::vec3 above(const SurfacePoint& point) const { return glm::vec3(point.at + lift * point.normal); }
};

OcclusionRays::OcclusionRays(const Snapshot& snapshot) : scene_(std::make_unique<Scene>()) {
    // One instruction set on all machines: the same rays meet the same triangles. One without fused multiply-adds, which
    // Valgrind takes many times as long for: it runs the precomputation, too, before it counts a steady frame.
    scene_->device.reset(rtcNewDevice("threads=1,max_isa=avx"));
    if (!scene_->device) throw InternalError("Embree gave no device for the precomputation of radiance transfer");
    const RTCDevice device = scene_->device.get();
    scene_->scene.reset(rtcNewScene(device));
    rtcSetSceneFlags(scene_->scene.get(), RTC_SCENE_FLAG_ROBUST); // no ray slips through an edge
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) {
            addGeometry(device, scene_->scene.get(), *batch.mesh, placement.world);
            scene_->outward.push_back(outwardOf(*batch.mesh, placement.world));
        }
    rtcCommitScene(scene_->scene.get());
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw InternalError("Embree failed with error " + std::to_string(error) + " on the scene of a radiance transfer");
    // Far above the rounding of 32-bit positions, far below the distance between points.
    const Bounds bounds = snapshot.bounds();
    scene_->lift = 1e-5 * glm::distance(bounds.low, bounds.high);
}

OcclusionRays::~OcclusionRays() = default;

void OcclusionRays::trace(const SurfacePoint& point, std::span<const DirectionSample> samples,
                          std::span<std::uint8_t> blocked) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const glm::vec3 normal(point.normal);
    Packet eight;
    eight.begin(scene_->above(point));
    for (std::size_t first = 0; first < samples.size(); first += packet) {
        bool any = false;
        for (std::size_t lane = 0; lane < packet; ++lane) {
            const bool exists = first + lane < samples.size();
            const glm::vec3 direction = exists ? samples[first + lane].direction : normal;
            const bool traced = exists && glm::dot(direction, normal) > 0;
            eight.aim(lane, direction, traced);
            any = any || traced;
        }
        if (any) rtcOccluded8(eight.valid.data(), scene_->scene.get(), &context, &eight.rays);
        for (std::size_t lane = 0; lane < packet && first + lane < samples.size(); ++lane)
            blocked[first + lane] = eight.valid.at(lane) != 0 && eight.rays.tfar[lane] < 0 ? 1 : 0; // Embree's mark
    }
}

bool OcclusionRays::isInside(const SurfacePoint& point) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const glm::vec3 from = scene_->above(point), direction(point.normal);
    RTCRayHit hit{};
    hit.ray = {from.x, from.y, from.z, 0, direction.x, direction.y, direction.z, 0, infinity, ~0U, 0, 0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_->scene.get(), &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const glm::vec3 towards(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
    return scene_->outward.at(hit.hit.geomID) * glm::dot(towards, direction) > 0;
}

} // namespace shadowbench::techniques
