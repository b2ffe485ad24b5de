// The content hash of a request: XXH3-128 over a canonical binary form.
#include "groundtruth/contract/reference_key.h"

#include "base/hash.h"
#include "scene/sky.h"

#include <algorithm>
#include <bit>
#include <map>
#include <variant>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

static_assert(std::endian::native == std::endian::little, "keys are defined over little-endian numbers");

/// One hash of numbers and strings, given one after the other. −0 and 0 are one number.
class FieldHash {
public:
    void add(std::uint64_t value) { hasher_.add(&value, sizeof value); }
    void add(double value) {
        const double canonical = value + 0.0;
        hasher_.add(&canonical, sizeof canonical);
    }
    void add(const glm::dvec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        hasher_.add(text.data(), text.size());
    }
    void add(const Hash128& hash) {
        add(hash.low);
        add(hash.high);
    }
    [[nodiscard]] Hash128 digest() const { return hasher_.digest(); }

private:
    Hasher128 hasher_;
};

void add(FieldHash& hash, const Camera& camera) {
    for (const glm::dvec3& v : {camera.eye, camera.target, camera.up}) hash.add(v);
    for (const double value : {camera.fovy, camera.near, camera.far}) hash.add(value);
}

struct AddSky {
    FieldHash& hash;
    void operator()(const ConstantSky& sky) const {
        hash.add("constant");
        hash.add(sky.radiance);
    }
    void operator()(const HarmonicSky& sky) const {
        hash.add("harmonics");
        hash.add(std::uint64_t{sky.coefficients.size()});
        for (const double coefficient : sky.coefficients) hash.add(coefficient);
    }
    void operator()(const ImageSky& sky) const {
        hash.add("image");
        for (const int side : {sky.radiance.width(), sky.radiance.height()}) hash.add(static_cast<std::uint64_t>(side));
        for (const float radiance : sky.radiance) hash.add(static_cast<double>(radiance));
    }
};

void add(FieldHash& hash, const EnvironmentLight& light) {
    std::visit(AddSky{hash}, light.sky);
    hash.add(std::uint64_t{light.suns.size()});
    for (const Sun& sun : light.suns) {
        hash.add(sun.direction);
        hash.add(sun.diameter);
        hash.add(sun.radiance);
    }
}

/// Only what its kind uses.
void add(FieldHash& hash, const Light& light) {
    hash.add(name(light.kind));
    if (light.isEnvironment()) return add(hash, *light.environment);
    hash.add(light.kind == LightKind::Directional ? light.direction : light.centre);
    if (!light.isArea()) return;
    hash.add(light.u);
    if (light.kind != LightKind::Line) hash.add(light.v);
}

Hash128 hashOf(const Mesh& mesh) {
    FieldHash hash;
    hash.add(std::uint64_t{mesh.closed});
    hash.add(std::uint64_t{mesh.positions.size()});
    for (const glm::vec3& p : mesh.positions) hash.add(glm::dvec3(p));
    hash.add(std::uint64_t{mesh.triangles.size()});
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) hash.add(std::uint64_t{t[i]});
    return hash.digest();
}

struct PlacedMesh {
    const Placement* placement;
    Hash128 mesh;
};

/// Every placement in the order of its id: which batch it came in does not matter.
std::vector<PlacedMesh> placements(const Snapshot& snapshot) {
    std::map<const Mesh*, Hash128> known; // a mesh may be shared by batches
    std::vector<PlacedMesh> result;
    for (const Batch& batch : snapshot.batches) {
        const Mesh* mesh = batch.mesh.get();
        if (!known.contains(mesh)) known.emplace(mesh, hashOf(*mesh));
        for (const Placement& placement : batch.placements) result.push_back({&placement, known.at(mesh)});
    }
    std::ranges::sort(result, {}, [](const PlacedMesh& p) { return p.placement->id; });
    return result;
}

/// As the keys of published records say it.
std::string_view askedAs(const Request& request) {
    if (request.truth == Truth::Hard) return name(request.oracle);
    const bool byOneOf = request.truth == Truth::Soft || request.truth == Truth::PixelArea;
    return byOneOf ? name(Oracle::Auto) : name(request.truth);
}

} // namespace

std::string key(const Request& request, const Tools& tools) {
    const Snapshot& snapshot = request.snapshot;
    FieldHash hash;
    add(hash, snapshot.camera);
    add(hash, request.light());
    for (const PlacedMesh& placed : placements(snapshot)) {
        hash.add(std::uint64_t{placed.placement->id});
        for (int column = 0; column < 4; ++column) hash.add(glm::dvec3(placed.placement->world[column]));
        hash.add(placed.mesh);
    }
    const bool sampled = request.truth == Truth::Soft;
    for (const int value : {request.size.x, request.size.y, sampled ? request.samples : 0})
        hash.add(static_cast<std::uint64_t>(value));
    hash.add(askedAs(request));
    if (request.truth == Truth::PixelArea) hash.add("pixel areas");
    for (const auto& [tool, version] : tools) {
        hash.add(tool);
        hash.add(version);
    }
    return hash.digest().text();
}

} // namespace shadowbench::groundtruth
