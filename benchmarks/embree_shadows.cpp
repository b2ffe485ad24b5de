#include "benchmarks/embree_shadows.h"

#include "base/error.h"
#include "base/parallel.h"
#include "groundtruth/cgal/geometry/triangles.h"

#include <algorithm>
#include <embree3/rtcore.h>
#include <string>

namespace shadowbench::benchmarks {
namespace {

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

void addGeometry(RTCDevice device, RTCScene scene, const Mesh& mesh, const glm::dmat4& world) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                      sizeof(glm::vec3), mesh.positions.size()));
    std::ranges::transform(mesh.positions, positions, [&](const glm::vec3& position) {
        return glm::vec3(groundtruth::geometry::worldVertex(world, position));
    });
    auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                       sizeof(glm::uvec3), mesh.triangles.size()));
    std::ranges::copy(mesh.triangles, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

bool occluded(RTCScene scene, const glm::vec3& from, const glm::vec3& to, float tnear) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = to.x - from.x;
    ray.dir_y = to.y - from.y;
    ray.dir_z = to.z - from.z;
    ray.tnear = tnear;
    ray.tfar = 1;
    ray.mask = ~0U;
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0; // Embree's mark of an occluded ray
}

/// What Embree hands back to the filter.
struct FilteredContext {
    RTCIntersectContext context;
    const EmbreeShadows::Ignored* ignored;
};

void ignoreHits(const RTCFilterFunctionNArguments* hits) {
    const auto& ignored = *reinterpret_cast<const FilteredContext*>(hits->context)->ignored;
    for (unsigned i = 0; i < hits->N; ++i)
        if (hits->valid[i] != 0 && ignored(RTCHitN_geomID(hits->hit, hits->N, i), RTCHitN_primID(hits->hit, hits->N, i)))
            hits->valid[i] = 0;
}

constexpr std::size_t lanes = 8; // rays at a time

/// At most `lanes` rays.
void traceVisible(RTCScene scene, FilteredContext& context, const glm::dvec3& from, std::span<const glm::dvec3> lights,
                  std::span<char> result) {
    alignas(32) int valid[lanes] = {};
    RTCRay8 rays{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3 origin(from), direction(lights[i] - from);
        valid[i] = -1;
        rays.org_x[i] = origin.x;
        rays.org_y[i] = origin.y;
        rays.org_z[i] = origin.z;
        rays.dir_x[i] = direction.x;
        rays.dir_y[i] = direction.y;
        rays.dir_z[i] = direction.z;
        rays.tfar[i] = 1;
        rays.mask[i] = ~0U;
    }
    rtcOccluded8(valid, scene, &context.context, &rays);
    for (std::size_t i = 0; i < lights.size(); ++i) result[i] = rays.tfar[i] < 0 ? 0 : 1;
}

} // namespace

struct EmbreeShadows::Scene {
    Device device;
    SceneHandle scene;
};

EmbreeShadows::EmbreeShadows(const Snapshot& snapshot, int threads, bool filters)
    : scene_(std::make_unique<Scene>()), threads_(threads),
      reach_(glm::length(snapshot.bounds().high - snapshot.bounds().low)) {
    scene_->device.reset(rtcNewDevice(("threads=" + std::to_string(threads)).c_str()));
    if (!scene_->device) throw InternalError("Embree gave no device.");
    const RTCDevice device = scene_->device.get();
    scene_->scene.reset(rtcNewScene(device));
    rtcSetSceneFlags(scene_->scene.get(),
                     filters ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_ROBUST);
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements)
            addGeometry(device, scene_->scene.get(), *batch.mesh, placement.world);
    rtcCommitScene(scene_->scene.get());
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw InternalError("Embree failed with error " + std::to_string(error) + ".");
}

EmbreeShadows::~EmbreeShadows() = default;

Image<float> EmbreeShadows::visibility(const groundtruth::PrimaryHits& primary, const glm::dvec4& light, float tnear) const {
    const auto endOf = [&](const glm::vec3& from) {
        const glm::dvec3 end(light);
        return light.w == 0 ? from + glm::vec3(reach_ * glm::normalize(end)) : glm::vec3(end);
    };
    Image<float> result(primary.id.width(), primary.id.height());
    inParallel(result.height(), threads_, [&](int y) {
        for (int x = 0; x < result.width(); ++x) {
            if (primary.surface(x, y) != groundtruth::Surface::Receiver) continue;
            const glm::vec3 from = primary.position(x, y);
            result(x, y) = occluded(scene_->scene.get(), from, endOf(from), tnear) ? 0.0F : 1.0F;
        }
    });
    return result;
}

void EmbreeShadows::visible(const glm::dvec3& from, std::span<const glm::dvec3> lights, const Ignored& ignored,
                            std::span<char> result) const {
    FilteredContext context{{}, &ignored};
    rtcInitIntersectContext(&context.context);
    context.context.filter = ignoreHits;
    for (std::size_t i = 0; i < lights.size(); i += lanes) {
        const std::size_t count = std::min(lanes, lights.size() - i);
        traceVisible(scene_->scene.get(), context, from, lights.subspan(i, count), result.subspan(i, count));
    }
}

} // namespace shadowbench::benchmarks
