#include "scene/exchange/gltf_objects.h"

#include "base/error.h"
#include "scene/gltf_file.h"
#include "scene/similarity.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

namespace shadowbench::exchange {
namespace {

template <int Size>
toml::array listOfColumns(const glm::mat<Size, Size, double>& matrix) {
    toml::array list;
    for (int i = 0; i < Size * Size; ++i) list.push_back(matrix[i / Size][i % Size]);
    return list;
}

/// Points and lines cast no shadow.
bool isOfTriangles(const Json& primitive) {
    constexpr std::size_t list = 4; // the first of glTF's modes of triangles
    return !primitive.contains("mode") || whole(primitive["mode"]) >= list;
}

/// What a modelling program calls an object is its node.
std::string nameOfPrimitive(const std::string& node, std::size_t primitive) {
    return primitive == 0 ? node : fmt::format("{}_{}", node, primitive + 1);
}

} // namespace

GltfObjects::GltfObjects(const GltfDocument& gltf, const GltfUse& use) : gltf_(gltf), use_(use) {
    PartNames names;
    for (const Json& mesh : listIn(gltf.json(), "meshes")) {
        std::vector<std::string> parts;
        for (std::size_t i = 0; i < listIn(mesh, "primitives").size(); ++i)
            parts.push_back(names.next(nameOf(mesh), names_.size()));
        names_.push_back(std::move(parts));
    }
}

void GltfObjects::add(const Json& mesh, const glm::dmat4& world, const std::string& node) {
    const glm::dmat3 axes(world);
    if (axes == glm::dmat3(0)) return; // programs hide a node so
    const Json& primitives = listIn(gltf_.entry("meshes", mesh), "primitives");
    const std::size_t number = whole(mesh);
    const bool isEven = scalesEvenly(axes) && glm::determinant(axes) > 0;
    const std::optional<glm::dmat3> stretch = isEven ? std::nullopt : std::optional(axes);
    if (objects_.empty() || number != lastMesh_ || stretch != lastStretch_) {
        first_ = objects_.size();
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (isOfTriangles(primitives[i])) objects_.push_back(objectOf(number, i, stretch, node));
    }
    lastMesh_ = number;
    lastStretch_ = stretch;
    const toml::table place =
        isEven ? toml::table{{"matrix", listOfColumns(world)}} : toml::table{{"at", tomlOf(glm::dvec3(world[3]))}};
    for (std::size_t i = first_; i < objects_.size(); ++i) objects_[i]["place"].as_array()->push_back(place);
    for (const Json& primitive : primitives)
        if (isOfTriangles(primitive)) addBounds(primitive, world);
}

toml::table GltfObjects::objectOf(std::size_t mesh, std::size_t primitive, const std::optional<glm::dmat3>& stretch,
                                  const std::string& node) const {
    const Json& entry = gltf_.json()["meshes"][mesh];
    const Json& drawn = entry["primitives"][primitive];
    Json material = Json::object();
    if (drawn.contains("material")) material = gltf_.entry("materials", drawn["material"]);
    const std::string& part = names_[mesh][primitive];
    // Only our exporter promises that what is seen from outside alone is closed.
    const bool closed = gltf_.isExported() && !material.value("doubleSided", false);
    const glm::dvec3 colour = vectorOr(member(material, "pbrMetallicRoughness"), "baseColorFactor", glm::dvec3(0.8));
    toml::table from{{"file", use_.file}, {"part", part}, {"closed", closed}};
    if (use_.maskTexels > 0) from.insert("mask_texels", use_.maskTexels); // of all, so that the file is read once
    if (stretch) from.insert("matrix", listOfColumns(*stretch));
    return toml::table{{"name", gltf_.isExported() || node.empty() ? part : nameOfPrimitive(node, primitive)},
                       {"colour", tomlOf(colour)},
                       {"mesh", std::move(from)},
                       {"place", toml::array()}};
}

void GltfObjects::addBounds(const Json& primitive, const glm::dmat4& world) {
    const Json& positions = gltf_.entry("accessors", member(primitive, "attributes").at("POSITION"));
    if (listIn(positions, "min").size() != 3 || listIn(positions, "max").size() != 3) bounds_.reset();
    if (!bounds_) return;
    Bounds box;
    for (const char* corner : {"min", "max"}) box.add(vectorOr(positions, corner, glm::dvec3(0)));
    bounds_->add(transformed(box, world));
}

toml::array GltfObjects::take() {
    toml::array list;
    for (toml::table& object : objects_) list.push_back(std::move(object));
    return list;
}

} // namespace shadowbench::exchange
